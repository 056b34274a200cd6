// SPDX-License-Identifier: Apache-2.0
#include <asperity/gonio/experiment.h>

#include <asperity/core/energy.h>
#include <asperity/core/error.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace asperity {

namespace {

void require(bool holds, const char* setting, std::string message) {
    if (!holds) throw Error(ErrorCode::Usage, std::move(message), setting);
}

void validate(const IlluminationSettings& s) {
    require(s.layers >= 1 && s.layers <= 9000, "layers",
            fmt::format("{} is outside 1 .. 9000", s.layers));
    for (const double theta : s.theta_deg)
        require(theta >= 0 && theta < 90, "theta",
                fmt::format("{} degrees is outside 0 <= theta < 90", theta));
    require(!s.phi_deg.empty(), "phi", "needs at least one azimuth");
    for (const double phi : s.phi_deg)
        require(std::abs(phi) <= 360, "phi", fmt::format("{} degrees is outside -360 .. 360", phi));
    require(!s.isotropic || s.phi_deg.size() == 1, "phi",
            "an isotropic measurement has no incident azimuths");
}

void validate(const DetectorSettings& s) {
    require(s.resolution >= 2 && s.resolution <= 8192, "resolution",
            fmt::format("{} is outside 2 .. 8192", s.resolution));
    require(s.orders >= 1 && s.orders <= 256, "orders",
            fmt::format("{} is outside 1 .. 256", s.orders));
}

void validate(const RunSettings& s) {
    require(std::isfinite(s.jitter) && s.jitter > 0 && s.jitter <= 1e9, "jitter",
            fmt::format("{} must be above 0 and at most 1e9", s.jitter));
    require(s.rays <= kMaxRaysPerLayer, "rays",
            fmt::format("{} is more than {} per layer", s.rays, kMaxRaysPerLayer));
    require(s.max_rays <= kMaxRaysPerLayer, "max-rays",
            fmt::format("{} is more than {} per layer", s.max_rays, kMaxRaysPerLayer));
    require(s.until >= 0 && s.until < 1, "until",
            fmt::format("a relative error of {} is outside 0 <= until < 1", s.until));
    require(s.until_cells >= 0 && s.until_cells < 1, "until",
            fmt::format("a relative error of {} is outside 0 <= until < 1", s.until_cells));
    require(s.rays == 0 || s.rays >= 2, "rays", "needs at least 2 rays per layer");
    require(s.bounces >= 1 && s.bounces <= 10000, "bounces",
            fmt::format("{} is outside 1 .. 10000", s.bounces));
    require(s.batches >= 2 && s.batches <= 4096, "batches",
            fmt::format("{} is outside 2 .. 4096", s.batches));
}

}  // namespace

double default_jitter(std::uint64_t cells) {
    constexpr double kEnoughRays = 1 << 26;
    return std::clamp(kEnoughRays / static_cast<double>(cells), 1.0, RunSettings{}.jitter);
}

void validate(const Experiment& experiment) {
    validate(experiment.illumination);
    validate(experiment.detector);
    validate(experiment.run);
}

}  // namespace asperity
