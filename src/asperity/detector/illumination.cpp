// SPDX-License-Identifier: Apache-2.0
#include <asperity/detector/illumination.h>

#include <asperity/core/directions.h>
#include <asperity/core/error.h>

namespace asperity {

std::vector<Incidence> incidences(const IlluminationSettings& s) {
    std::vector<Incidence> list;
    const auto add = [&](int number, double theta_deg, double phi_deg) {
        const double theta = radians(theta_deg);
        list.push_back({number, theta < kStraightDown ? 0.0 : theta,
                        s.isotropic ? 0.0 : radians(phi_deg), s.isotropic});
    };
    if (s.theta_deg.empty()) {
        if (s.layers == 0)
            throw Error(ErrorCode::Usage,
                        "only a surface that is measured says what 'auto' is: give a number of "
                        "layers, or the angles",
                        "layers");
        // Thesis layers by elevation: the last one, normal incidence, is filled first
        for (int k = s.layers; k >= 1; --k)
            for (const double phi : s.phi_deg) add(k, 90.0 * (s.layers - k) / s.layers, phi);
    } else {
        int number = 1;
        for (const double theta : s.theta_deg)
            for (const double phi : s.phi_deg) add(number++, theta, phi);
    }
    return list;
}

}  // namespace asperity
