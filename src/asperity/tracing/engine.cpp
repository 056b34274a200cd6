// SPDX-License-Identifier: Apache-2.0
#include <asperity/tracing/engine.h>

#include <asperity/core/error.h>
#include <asperity/tracing/engines/plain/plain_engine.h>
#include <asperity/tracing/engines/wide/wide_engine.h>
#include <fmt/format.h>

#include <string>

namespace asperity {

namespace {

constexpr EngineKind kEngines[] = {
    {"wide", "thousands of paths side by side, in the lanes of the processor: the fast one",
     make_wide_engine},
    {"plain", "one ray at a time, as the theory says: the judge of the others, and slow",
     make_plain_engine},
};

}  // namespace

std::span<const EngineKind> engines() {
    return kEngines;
}

const EngineKind& find_engine(std::string_view name) {
    std::string names;
    for (const EngineKind& kind : kEngines) {
        if (kind.name == name) return kind;
        names += fmt::format("{}{}", names.empty() ? "" : ", ", kind.name);
    }
    throw Error(ErrorCode::Usage, fmt::format("'{}' is none of {}", name, names), "engine");
}

}  // namespace asperity
