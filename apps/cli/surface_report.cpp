// SPDX-License-Identifier: Apache-2.0
#include "surface_report.h"

#include "report.h"

#include <asperity/surface/slope_distribution.h>
#include <asperity/surface/surface_kinds.h>
#include <fmt/format.h>

namespace asperity::cli {

namespace {

bool alpha_was_asked(const SurfaceSettings& settings) {
    return surface_uses(settings.kind, "alpha");
}

std::optional<LawDistances> law_distances(const SurfaceSettings& settings,
                                          const Heightfield& surface,
                                          const SurfaceStatistics& figures, int threads) {
    const bool asked = alpha_was_asked(settings);
    SlopeLaw law;
    law.alpha_x = asked ? settings.alpha_x : figures.alpha_x;
    law.alpha_y = asked ? settings.alpha_y : figures.alpha_y;
    if (law.alpha_x <= 0 || law.alpha_y <= 0) return std::nullopt;
    if (surface_uses(settings.kind, "max-slope")) law.max_slope = settings.max_slope;
    const auto distance = [&](SlopeFamily family) {
        law.family = family;
        return slope_distribution_distance(surface, law, threads);
    };
    return LawDistances{distance(SlopeFamily::Beckmann), distance(SlopeFamily::Ggx)};
}

const char* boundary_name(const Heightfield& surface) {
    return surface.boundary == Boundary::Periodic ? "periodic" : "finite";
}

}  // namespace

SurfaceReport::SurfaceReport(const SurfaceSettings& settings, const Heightfield& patch,
                             const Heightfield& surface, Run& run)
    : settings_(settings),
      surface_(surface),
      statistics_(statistics(surface, run.threads())),
      distances_(law_distances(settings, surface, statistics_, run.threads())),
      texture_(settings, patch, run) {}

std::string SurfaceReport::headline() const {
    std::string text = surface_line(settings_, statistics_, surface_.nx, surface_.ny) + "\n";
    const std::string tiling = tiling_line(settings_, surface_);
    if (!tiling.empty()) text += tiling + "\n";
    if (!surface_.source.empty()) text += surface_.source + "\n";
    if (!surface_.prepared.empty()) text += "made ready: " + surface_.prepared + "\n";
    return text;
}

std::string SurfaceReport::figures() const {
    const SurfaceStatistics& s = statistics_;
    std::string text;
    const auto add = [&](const char* name, const std::string& value) {
        text += fmt::format("  {:<36}{}\n", name, value);
    };
    const auto pair = [](double a, double b) { return fmt::format("{:.6g}  {:.6g}", a, b); };
    const std::string& unit = surface_.unit;
    add("spacing x, y", fmt::format("{:.6g}  {:.6g} {}", surface_.dx, surface_.dy, unit));
    add("boundary", boundary_name(surface_));
    add("RMS height (Sq)", fmt::format("{:.6g} {}", s.rms_height, unit));
    add("lowest, mean, highest height",
        fmt::format("{:.6g}  {:.6g}  {:.6g} {}", s.min_height, s.mean_height, s.max_height, unit));
    add("skewness (Ssk), kurtosis (Sku)", pair(s.skewness, s.kurtosis));
    add("mean slope x, y", pair(s.mean_slope_x, s.mean_slope_y));
    add("RMS slope x, y", pair(s.rms_slope_x, s.rms_slope_y));
    add("RMS gradient (Sdq) = alpha", fmt::format("{:.6g}", s.rms_gradient));
    add("alpha x, y", pair(s.alpha_x, s.alpha_y));
    add("correlation of slope x and y", fmt::format("{:.6g}", s.slope_correlation));
    add("mean, largest facet tilt",
        fmt::format("{:.4g}°  {:.4g}°", s.mean_tilt_deg, s.max_tilt_deg));
    add("true / projected area (1 + Sdr)", fmt::format("{:.6g}", s.area_ratio));
    if (distances_) {
        add("slopes' distance to Beckmann, GGX",
            fmt::format("{:.4f}  {:.4f} (Kolmogorov-Smirnov, at the {} alpha)",
                        distances_->beckmann, distances_->ggx,
                        alpha_was_asked(settings_) ? "asked" : "realised"));
    }
    return text + texture_.text();
}

Json SurfaceReport::json(Run& run) const {
    Json json;
    json["name"] = surface_.name;
    json["kind"] = kind_name(settings_);
    json["nx"] = surface_.nx;
    json["ny"] = surface_.ny;
    json["dx"] = surface_.dx;
    json["dy"] = surface_.dy;
    json["unit"] = surface_.unit;
    json["boundary"] = boundary_name(surface_);
    json["diagonal"] = surface_.diagonal == Diagonal::Anti ? "anti" : "main";
    json["isotropic"] = surface_.isotropic;
    if (settings_.kind == kSurfaceFile) json["tiling"] = tiling_line(settings_, surface_);
    if (!surface_.source.empty()) json["source"] = surface_.source;
    if (!surface_.prepared.empty()) json["prepared"] = surface_.prepared;
    json["asked"] = Json::object();
    if (surface_uses(settings_.kind, "roughness")) json["asked"]["roughness"] = settings_.roughness;
    if (alpha_was_asked(settings_)) {
        json["asked"] = {{"alpha_x", settings_.alpha_x}, {"alpha_y", settings_.alpha_y}};
    }
    json["realised"] = to_json(statistics_);
    json["slope_distance"] = nullptr;
    if (distances_) {
        json["slope_distance"] = {{"beckmann", distances_->beckmann}, {"ggx", distances_->ggx}};
    }
    json["texture"] = texture_.json(run);
    return json;
}

}  // namespace asperity::cli
