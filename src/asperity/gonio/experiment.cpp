// SPDX-License-Identifier: Apache-2.0
#include <asperity/gonio/experiment.h>

#include <asperity/core/error.h>
#include <asperity/gonio/batch_plan.h>
#include <asperity/gonio/experiment_params.h>
#include <asperity/surface/surface_kinds.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace asperity {

namespace {

constexpr double kJitter = 16;

void require(bool holds, const char* setting, std::string message) {
    if (!holds) throw Error(ErrorCode::Usage, std::move(message), setting);
}

void validate(const IlluminationSettings& s) {
    check_all(illumination_params(), s);
    require(!s.phi_deg.empty(), "phi", "needs at least one azimuth");
    const std::size_t angles =
        s.theta_deg.empty() ? static_cast<std::size_t>(std::max(1, s.layers)) : s.theta_deg.size();
    require(s.phi_deg.size() <= kMostLayers / angles, s.phi_deg.size() > 1 ? "phi" : "theta",
            fmt::format("{} polar angles x {} azimuths are more than {} layers", angles,
                        s.phi_deg.size(), kMostLayers));
    require(!s.isotropic || s.phi_deg.size() == 1, "phi",
            "an isotropic measurement has no incident azimuths");
}

void validate(const RunSettings& s) {
    check_all(run_params(), s);
    require(s.until >= 0 && s.until_cells >= 0 && s.until_cells < 1, "until",
            fmt::format("a relative error of {} is outside 0 <= until < 1",
                        s.until >= 0 ? s.until_cells : s.until));
}

}  // namespace

double default_jitter(std::uint64_t cells) {
    constexpr double kEnoughRays = 1 << 26;
    return std::clamp(kEnoughRays / static_cast<double>(cells), 1.0, kJitter);
}

double jitter_of(const RunSettings& run, std::uint64_t cells) {
    if (run.jitter > 0) return run.jitter;
    return run.rays > 0 ? kJitter : default_jitter(cells);
}

double rays_wanted(const RunSettings& run, std::uint64_t cells) {
    return run.rays > 0 ? static_cast<double>(run.rays)
                        : jitter_of(run, cells) * static_cast<double>(cells);
}

std::uint64_t surfaces_of_rays(double rays, std::uint64_t cells) {
    constexpr double kFewest = 16, kMost = 4096;
    const double each = std::min(static_cast<double>(cells), static_cast<double>(kLargestBatch));
    return static_cast<std::uint64_t>(std::ceil(std::clamp(rays / each, kFewest, kMost)));
}

std::uint64_t surfaces_of(const RunSettings& run, std::uint64_t cells) {
    return run.surfaces > 0 ? run.surfaces : surfaces_of_rays(rays_wanted(run, cells), cells);
}

std::string only_surface(const SurfaceSettings& surface) {
    if (surface.kind == kSurfaceFile)
        return "a file holds one surface: of a class of them, measure each and compare";
    if (!surface_uses(surface.kind, "surface-seed"))
        return fmt::format("all surfaces of kind {} are the same: there is no seed to it",
                           surface.kind);
    return {};
}

void validate(const Experiment& experiment) {
    validate(experiment.illumination);
    check_all(detector_params(), experiment.detector);
    validate(experiment.run);
    if (experiment.run.surfaces != 1) {
        const std::string why = only_surface(experiment.surface);
        require(why.empty(), "surfaces", why);
    }
}

}  // namespace asperity
