// SPDX-License-Identifier: Apache-2.0
#include <asperity/core/error.h>
#include <asperity/optics/scattering_law.h>

#include <array>
#include <string>

namespace asperity {

// Each stands in the file of its name in laws/.
ScatteringLaw mirror_law();
ScatteringLaw schlick_law();
ScatteringLaw dielectric_law();
ScatteringLaw conductor_law();

std::span<const ScatteringLaw> scattering_laws() {
    static const std::array laws = {
        mirror_law(),
        schlick_law(),
        dielectric_law(),
        conductor_law(),
    };
    return laws;
}

const ScatteringLaw& scattering_law(FresnelKind kind) {
    std::string names;
    for (const ScatteringLaw& law : scattering_laws()) {
        if (law.kind == kind) return law;
        names += (names.empty() ? "" : ", ") + std::string(law.name);
    }
    throw Error(ErrorCode::Usage, "is not one of " + names, "fresnel");
}

}  // namespace asperity
