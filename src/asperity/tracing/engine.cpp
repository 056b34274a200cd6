// SPDX-License-Identifier: Apache-2.0
#include <asperity/tracing/engine.h>

#include <asperity/core/error.h>
#include <asperity/tracing/engines/plain/plain_engine.h>
#include <asperity/tracing/engines/wide/wide_engine.h>
#include <fmt/format.h>

#include <algorithm>
#include <mutex>
#include <utility>

namespace asperity {

namespace {

struct Registry {
    std::mutex mutex;
    std::vector<EngineKind> kinds = {
        {"wide", "thousands of paths side by side, in the lanes of the processor: the fast one",
         make_wide_engine},
        {"plain", "one ray at a time, as the theory says: the judge of the others, and slow",
         make_plain_engine},
    };
};

Registry& registry() {
    static Registry registry;
    return registry;
}

}  // namespace

std::vector<EngineKind> engines() {
    const std::lock_guard lock(registry().mutex);
    return registry().kinds;
}

EngineKind find_engine(std::string_view name) {
    std::string names;
    for (EngineKind& kind : engines()) {
        if (kind.name == name) return std::move(kind);
        names += fmt::format("{}{}", names.empty() ? "" : ", ", kind.name);
    }
    throw Error(ErrorCode::Usage, fmt::format("'{}' is none of {}", name, names), "engine");
}

void add_engine(EngineKind kind) {
    if (kind.name.empty()) throw Error(ErrorCode::Usage, "an engine needs a name", "engine");
    if (!kind.make)
        throw Error(ErrorCode::Usage, "an engine needs a function that makes it", kind.name);
    const std::lock_guard lock(registry().mutex);
    std::vector<EngineKind>& all = registry().kinds;
    if (std::any_of(all.begin(), all.end(),
                    [&](const EngineKind& other) { return other.name == kind.name; }))
        throw Error(ErrorCode::Usage, "there is an engine of that name", kind.name);
    all.push_back(std::move(kind));
}

}  // namespace asperity
