// SPDX-License-Identifier: Apache-2.0
#include <asperity/optics/laws/law_checks.h>
#include <asperity/optics/scattering_law.h>

#include <algorithm>

namespace asperity {

ScatteringLaw mirror_law() {
    return {FresnelKind::None,
            "none",
            "Perfect mirrors",
            "all light is reflected, as in the thesis",
            [](const OpticsSettings& s) {
                detail::require_absent("fresnel none", {{"f0", s.f0}, {"ior", s.ior}, {"k", s.k}});
                detail::require_no_material("fresnel none", s);
                return std::vector{FacetChannel{}};
            },
            [](double, const FacetChannel&) { return 1.0; },
            [](std::span<const float> cos_theta, const FacetChannel&, float* f) {
                std::fill_n(f, cos_theta.size(), 1.0f);
            }};
}

}  // namespace asperity
