// SPDX-License-Identifier: Apache-2.0
#include <asperity/core/error.h>
#include <asperity/optics/scattering_law.h>

#include <deque>
#include <mutex>
#include <string>
#include <utility>

namespace asperity {

// Each stands in the file of its name in laws/.
ScatteringLaw mirror_law();
ScatteringLaw schlick_law();
ScatteringLaw dielectric_law();
ScatteringLaw conductor_law();

namespace {

struct Registry {
    std::mutex mutex;
    std::deque<ScatteringLaw> laws = {
        // rows stay where they are
        mirror_law(),
        schlick_law(),
        dielectric_law(),
        conductor_law(),
    };
};

Registry& registry() {
    static Registry registry;
    return registry;
}

}  // namespace

std::vector<ScatteringLaw> scattering_laws() {
    const std::lock_guard lock(registry().mutex);
    return {registry().laws.begin(), registry().laws.end()};
}

const ScatteringLaw& scattering_law(FresnelKind kind) {
    const std::lock_guard lock(registry().mutex);
    std::string names;
    for (const ScatteringLaw& law : registry().laws) {
        if (law.kind == kind) return law;
        names += (names.empty() ? "" : ", ") + law.name;
    }
    throw Error(ErrorCode::Usage, "is not one of " + names, "fresnel");
}

FresnelKind add_scattering_law(ScatteringLaw law) {
    const auto refuse_law = [&](const char* why) { throw Error(ErrorCode::Usage, why, law.name); };
    if (law.name.empty()) refuse_law("a law needs a name");
    if (law.channels == nullptr || law.reflectance == nullptr)
        refuse_law("a law needs functions for its channels and its reflectance");
    const std::lock_guard lock(registry().mutex);
    std::deque<ScatteringLaw>& all = registry().laws;
    for (const ScatteringLaw& known : all)
        if (known.name == law.name) refuse_law("there is a law of that name");
    law.kind = static_cast<FresnelKind>(all.size());
    all.push_back(std::move(law));
    return all.back().kind;
}

}  // namespace asperity
