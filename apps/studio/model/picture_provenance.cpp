// SPDX-License-Identifier: Apache-2.0
#include "picture_provenance.h"

#include <fmt/format.h>

namespace asperity::studio {

namespace {

std::string text(Vec3 v) {
    return fmt::format("{},{},{}", v.x, v.y, v.z);
}

std::string text(Rgb c) {
    return fmt::format("{}/{}/{}", c.r, c.g, c.b);
}

std::string brdf_text(const BrdfSettings& worn, const WornBrdfs& brdfs) {
    if (worn.type == BrdfType::Simulated && !worn.result.empty()) return worn.result;
    const auto material = brdfs.material(worn);
    return material ? material->brdf().name() : "none";
}

void tell_brdfs(const ModelView& view, const WornBrdfs& brdfs, io::Provenance& told) {
    told.emplace_back("brdf", brdf_text(view.brdf, brdfs));
    const auto simulated = [](const BrdfSettings& s) { return s.type == BrdfType::Simulated; };
    const auto factor = [&](const BrdfSettings& s) {
        return simulated(s) ? s.normalize_factor : 1;
    };
    const auto albedo = [&](const BrdfSettings& s) { return simulated(s) ? s.diffuse : Rgb{}; };
    std::string factors = fmt::format("{}", factor(view.brdf)), albedos = text(albedo(view.brdf));
    if (view.compare) {
        told.emplace_back("brdf", brdf_text(view.second, brdfs));
        told.emplace_back("split", fmt::format("{}", view.split));
        factors += fmt::format(",{}", factor(view.second));
        albedos += "," + text(albedo(view.second));
    }
    told.emplace_back("normalize-factor", factors);
    told.emplace_back("albedo", albedos);
}

void tell_lights(const ModelView& view, io::Provenance& told) {
    switch (view.light) {
        case LightKind::Point:
            told.emplace_back("light", "point");
            told.emplace_back("light-position", text(view.light_position));
            told.emplace_back("light-intensity", fmt::format("{}", view.light_intensity));
            break;
        case LightKind::Sky:
            told.emplace_back("light", "sky");
            told.emplace_back("sun-elevation", fmt::format("{}", view.sun_elevation_deg));
            told.emplace_back("sun-azimuth", fmt::format("{}", view.sun_azimuth_deg));
            break;
        case LightKind::Soft:
            told.emplace_back("light", "soft sky of the studio");
            break;
        case LightKind::Environment:
            told.emplace_back("light", "env:" + view.environment);
            told.emplace_back("light-rotation", fmt::format("{}", view.environment_rotation_deg));
            break;
    }
}

const char* curve_name(const ToneMapping& tone) {
    switch (tone.curve) {
        case ToneCurve::Reinhard:
            return "reinhard";
        case ToneCurve::Aces:
            return "aces";
        case ToneCurve::None:
            break;
    }
    return "none";
}

const char* transfer_name(const ToneMapping& tone) {
    switch (tone.transfer) {
        case Transfer::Gamma22:
            return "gamma22";
        case Transfer::Linear:
            return "linear";
        case Transfer::Srgb:
            break;
    }
    return "srgb";
}

}  // namespace

io::Provenance picture_provenance(const ModelView& view, const std::string& model,
                                  const Camera& camera, const WornBrdfs& brdfs) {
    io::Provenance told{{"model", model}};
    if (view.brdf_runs) {
        if (view.floor) told.emplace_back("floor", "true");
        tell_brdfs(view, brdfs, told);
        tell_lights(view, told);
        if (view.light == LightKind::Point) told.emplace_back("scene", "before a grey backdrop");
    } else {
        told.emplace_back("scene", "the BRDF does not run: a black shape before a grey backdrop");
    }
    told.emplace_back("depth", std::to_string(view.depth));
    told.emplace_back("camera-position", text(camera.position));
    told.emplace_back("camera-target", text(camera.position + camera.forward));
    told.emplace_back("camera-up", text(camera.up));
    told.emplace_back("camera-fov", fmt::format("{}", camera.fov_deg));
    told.emplace_back("tonemap", curve_name(view.tone));
    told.emplace_back("transfer", transfer_name(view.tone));
    told.emplace_back("exposure", fmt::format("{}", view.tone.exposure));
    const io::Provenance origin = brdfs.origin();
    told.insert(told.end(), origin.begin(), origin.end());
    return told;
}

}  // namespace asperity::studio
