// SPDX-License-Identifier: Apache-2.0
#include "surfaces.h"

#include <cmath>
#include <numbers>

namespace asperity::bench {

const std::vector<std::string>& surface_names() {
    static const std::vector<std::string> names = {"thesis-0.05",  "thesis-0.2",   "thesis-1",
                                                   "gaussian-0.1", "gaussian-0.3", "gaussian-0.7"};
    return names;
}

bool is_gaussian(const std::string& name) {
    return name.starts_with("gaussian-");
}

SurfaceSettings surface_settings(const std::string& name, int size) {
    SurfaceSettings settings;
    const double value = std::stod(name.substr(name.find('-') + 1));
    if (is_gaussian(name)) {
        settings.kind = "gaussian";
        settings.alpha_x = settings.alpha_y = std::numbers::sqrt2 * value;
        settings.correlation_x = settings.correlation_y = 8;
    } else {
        settings.kind = "thesis";
        settings.roughness = value;
    }
    settings.size = size;
    return settings;
}

}  // namespace asperity::bench
