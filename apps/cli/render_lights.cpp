// SPDX-License-Identifier: Apache-2.0
#include "render_lights.h"

#include "file_kind.h"

#include <asperity/core/error.h>
#include <asperity/formats/images/image_reader.h>
#include <asperity/params/suggest.h>
#include <asperity/render/environment_map.h>
#include <asperity/render/sky.h>

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

namespace asperity::cli {

namespace {

constexpr const char* kEnvironment = "env:";

struct LightOption {
    const char* name;
    std::vector<std::string> kinds;  ///< of lights it is for
};

const std::vector<LightOption>& light_options() {
    static const std::vector<LightOption> options = {
        {"light-position", {"point"}},
        {"light-direction", {"directional"}},
        {"light-intensity", {"point", "directional", "constant"}},
        {"light-colour", {"point", "directional", "constant"}},
        {"light-rotation", {"env"}},
        {"light-scale", {"env", "sky"}},
        {"sun-elevation", {"sky"}},
        {"sun-azimuth", {"sky"}},
        {"sun-diameter", {"sky"}},
        {"turbidity", {"sky"}},
    };
    return options;
}

/// The kind of light of a --light, its file left off.
std::string kind_of(const std::string& text) {
    static const std::vector<std::string> kinds = {"point", "directional", "constant", "sky"};
    if (std::find(kinds.begin(), kinds.end(), text) != kinds.end()) return text;
    if (text.rfind(kEnvironment, 0) == 0 && text.size() > std::string(kEnvironment).size())
        return "env";
    std::error_code ignored;
    throw Error(
        ErrorCode::Usage,
        fmt::format("'{}' is none of {}, env:FILE{}", text, fmt::join(kinds, ", "),
                    std::filesystem::exists(text, ignored) ? "; did you mean env:" + text + "?"
                                                           : did_you_mean(text, kinds)),
        "light");
}

double intensity_or(const RenderOptions& options, double otherwise) {
    return options.given("light-intensity") ? options.value("light-intensity").number(kNotNegative)
                                            : otherwise;
}

std::unique_ptr<Light> point_light(const RenderOptions& options) {
    PointLightSettings s;
    s.position = options.vector("light-position");
    s.intensity = intensity_or(options, s.intensity);
    s.colour = options.colour("light-colour", kNotNegative);
    return make_light(s);
}

std::unique_ptr<Light> directional_light(const RenderOptions& options) {
    DirectionalLightSettings s;
    s.direction = options.vector("light-direction");
    s.irradiance = intensity_or(options, s.irradiance);
    s.colour = options.colour("light-colour", kNotNegative);
    return make_light(s);
}

std::unique_ptr<Light> constant_light(const RenderOptions& options) {
    return make_light(ConstantLightSettings{intensity_or(options, 1) *
                                            options.colour("light-colour", kNotNegative)});
}

std::unique_ptr<Light> environment_light(const RenderOptions& options, const std::string& text) {
    EnvironmentMapSettings s;
    s.rotation_deg = options.value("light-rotation").number(kAnyNumber);
    s.scale = options.value("light-scale").number(kAboveZero);
    s.name = text.substr(std::string(kEnvironment).size());
    require_kind(s.name, FileKind::Picture);
    return make_environment_light(io::read_image(s.name), s);
}

SkySettings sky_settings(const RenderOptions& options) {
    SkySettings s;
    s.sun_elevation_deg = options.value("sun-elevation").number(kAnyNumber);
    s.sun_azimuth_deg = options.value("sun-azimuth").number(kAnyNumber);
    s.sun_diameter_deg = options.value("sun-diameter").number(kAnyNumber);
    s.turbidity = options.value("turbidity").number(kAnyNumber);
    s.scale = options.value("light-scale").number(kAboveZero);
    return s;
}

}  // namespace

void check_lights(const RenderOptions& options) {
    std::vector<std::string> kinds;
    for (const std::string& text : options.texts("light")) kinds.push_back(kind_of(text));
    for (const LightOption& option : light_options()) {
        if (!options.given(option.name)) continue;
        const bool wanted = std::any_of(kinds.begin(), kinds.end(), [&](const std::string& kind) {
            return std::find(option.kinds.begin(), option.kinds.end(), kind) != option.kinds.end();
        });
        if (!wanted) {
            throw Error(ErrorCode::Usage,
                        fmt::format("goes with --light {}", fmt::join(option.kinds, " or ")),
                        option.name);
        }
    }
}

std::vector<std::shared_ptr<const Light>> load_lights(const RenderOptions& options) {
    check_lights(options);
    std::vector<std::shared_ptr<const Light>> lights;
    for (const std::string& text : options.texts("light")) {
        const std::string kind = kind_of(text);
        if (kind == "point") {
            lights.push_back(point_light(options));
        } else if (kind == "directional") {
            lights.push_back(directional_light(options));
        } else if (kind == "constant") {
            lights.push_back(constant_light(options));
        } else if (kind == "env") {
            lights.push_back(environment_light(options, text));
        } else {
            for (auto& light : make_sky(sky_settings(options))) lights.push_back(std::move(light));
        }
    }
    return lights;
}

}  // namespace asperity::cli
