// SPDX-License-Identifier: Apache-2.0
// The list of all settings: long because the experiment has that many.
#include <asperity/formats/results/experiment_keys.h>

#include <asperity/core/energy.h>
#include <asperity/formats/results/surface_spec.h>

#include <cmath>
#include <tuple>

namespace asperity::io {
namespace {

using E = Experiment;
using V = SettingValue;

constexpr Names<Autocorrelation, 3> kAutocorrelations = {{
    {"gaussian", Autocorrelation::Gaussian},
    {"exponential", Autocorrelation::Exponential},
    {"self-affine", Autocorrelation::SelfAffine},
}};
constexpr Names<Tiling, 4> kTilings = {{
    {"auto", Tiling::Auto},
    {"mirror", Tiling::Mirrored},
    {"periodic", Tiling::Periodic},
    {"finite", Tiling::Finite},
}};
constexpr Names<Boundary, 2> kBoundaries = {{
    {"periodic", Boundary::Periodic},
    {"finite", Boundary::Finite},
}};
constexpr Names<Diagonal, 2> kDiagonals = {{
    {"anti", Diagonal::Anti},
    {"main", Diagonal::Main},
}};
constexpr Names<FresnelKind, 4> kFresnels = {{
    {"none", FresnelKind::None},
    {"schlick", FresnelKind::Schlick},
    {"dielectric", FresnelKind::Dielectric},
    {"conductor", FresnelKind::Conductor},
}};
constexpr Names<DetectorKind, 2> kDetectors = {{
    {"latlong", DetectorKind::LatLong},
    {"equal-area", DetectorKind::EqualArea},
}};
constexpr Names<LaunchPattern, 3> kLaunches = {{
    {"low-discrepancy", LaunchPattern::LowDiscrepancy},
    {"stratified", LaunchPattern::Stratified},
    {"random", LaunchPattern::Random},
}};

// The largest double below 90: tilts and polar angles stop short of the horizon.
const Range kBelowHorizon = {0, std::nextafter(90.0, 0.0), "must be at least 0 and below 90"};
const Range kAzimuth = {-360, 360, "must be in -360 .. 360"};
const Range kVisible = {400, 700, "must be in 400 .. 700 nm"};
const Range kHurst = {kAboveZero.low, 1, "must be above 0 and at most 1"};
const Range kJitter = {kAboveZero.low, 1e9, "must be above 0 and at most 1e9"};
const Range kUntil = {kAboveZero.low, std::nextafter(1.0, 0.0), "must be above 0 and below 1"};

std::string text_of(bool flag) {
    return flag ? "true" : "false";
}

std::string text_of(int number) {
    return std::to_string(number);
}

std::string text_of(std::uint64_t number) {
    return std::to_string(number);
}

std::string count_or_auto(std::uint64_t count) {
    return count == 0 ? "auto" : std::to_string(count);
}

using io::text_of;

const ExperimentKey kKeys[] = {
    {"surface", kSurfaceGroup, [](E& e, const V& v) { set_surface(e.surface, v); },
     [](const E& e) { return surface_text(e.surface); }},
    {"size", kSurfaceGroup,
     [](E& e, const V& v) { e.surface.size = v.integer(2, kMaxSurfaceSide); },
     [](const E& e) { return text_of(e.surface.size); }},
    {"roughness", kSurfaceGroup,
     [](E& e, const V& v) { e.surface.roughness = v.number(kZeroToOne); },
     [](const E& e) { return shortest(e.surface.roughness); }},
    {"alpha", kSurfaceGroup,
     [](E& e, const V& v) { std::tie(e.surface.alpha_x, e.surface.alpha_y) = v.pair(kAboveZero); },
     [](const E& e) { return text_of(std::pair(e.surface.alpha_x, e.surface.alpha_y)); }},
    {"correlation-length", kSurfaceGroup,
     [](E& e, const V& v) {
         std::tie(e.surface.correlation_x, e.surface.correlation_y) = v.pair(kAboveZero);
     },
     [](const E& e) {
         return text_of(std::pair(e.surface.correlation_x, e.surface.correlation_y));
     }},
    {"autocorrelation", kSurfaceGroup,
     [](E& e, const V& v) { e.surface.autocorrelation = v.choice(kAutocorrelations); },
     [](const E& e) { return text_of(kAutocorrelations, e.surface.autocorrelation); }},
    {"hurst", kSurfaceGroup, [](E& e, const V& v) { e.surface.hurst = v.number(kHurst); },
     [](const E& e) { return shortest(e.surface.hurst); }},
    {"max-slope", kSurfaceGroup,
     [](E& e, const V& v) { e.surface.max_slope = v.number(kAboveZero); },
     [](const E& e) { return shortest(e.surface.max_slope); }},
    {"surface-seed", kSurfaceGroup, [](E& e, const V& v) { e.surface.seed = v.seed(); },
     [](const E& e) { return text_of(e.surface.seed); }},
    {"tilt", kSurfaceGroup, [](E& e, const V& v) { e.surface.tilt_deg = v.number(kBelowHorizon); },
     [](const E& e) { return shortest(e.surface.tilt_deg); }},
    {"period", kSurfaceGroup,
     [](E& e, const V& v) { e.surface.period = v.integer(1, kMaxSurfaceSide); },
     [](const E& e) { return text_of(e.surface.period); }},
    {"amplitude", kSurfaceGroup,
     [](E& e, const V& v) { e.surface.amplitude = v.number(kNotNegative); },
     [](const E& e) { return shortest(e.surface.amplitude); }},
    {"along-y", kSurfaceGroup, [](E& e, const V& v) { e.surface.along_y = v.flag(); },
     [](const E& e) { return text_of(e.surface.along_y); }},
    {"cell-size", kSurfaceGroup,
     [](E& e, const V& v) {
         std::tie(e.surface.cell_x, e.surface.cell_y) = v.optional_pair(kAboveZero);
     },
     [](const E& e) { return text_of(e.surface.cell_x, e.surface.cell_y); }},
    {"height-scale", kSurfaceGroup,
     [](E& e, const V& v) { e.surface.height_scale = v.number(kAnyNumber); },
     [](const E& e) { return shortest(e.surface.height_scale); }},
    {"tiling", kSurfaceGroup, [](E& e, const V& v) { e.surface.tiling = v.choice(kTilings); },
     [](const E& e) { return text_of(kTilings, e.surface.tiling); }},
    {"boundary", kSurfaceGroup,
     [](E& e, const V& v) { e.surface.boundary = v.choice(kBoundaries); },
     [](const E& e) { return text_of(kBoundaries, e.surface.boundary); }},
    {"diagonal", kSurfaceGroup, [](E& e, const V& v) { e.surface.diagonal = v.choice(kDiagonals); },
     [](const E& e) { return text_of(kDiagonals, e.surface.diagonal); }},
    {"theta", "Light", [](E& e, const V& v) { e.illumination.theta_deg = v.list(kBelowHorizon); },
     [](const E& e) { return text_of(e.illumination.theta_deg); }},
    {"phi", "Light", [](E& e, const V& v) { e.illumination.phi_deg = v.list(kAzimuth); },
     [](const E& e) { return text_of(e.illumination.phi_deg); }},
    {"layers", "Light", [](E& e, const V& v) { e.illumination.layers = v.integer(1, 9000); },
     [](const E& e) { return text_of(e.illumination.layers); }},
    {"isotropic", "Light", [](E& e, const V& v) { e.illumination.isotropic = v.flag(); },
     [](const E& e) { return text_of(e.illumination.isotropic); }},
    {"fresnel", "Optics", [](E& e, const V& v) { e.optics.fresnel = v.choice(kFresnels); },
     [](const E& e) { return text_of(kFresnels, e.optics.fresnel); }},
    {"f0", "Optics", [](E& e, const V& v) { e.optics.f0 = v.list(kZeroToOne); },
     [](const E& e) { return text_of(e.optics.f0); }},
    {"ior", "Optics", [](E& e, const V& v) { e.optics.ior = v.list(kAboveZero); },
     [](const E& e) { return text_of(e.optics.ior); }},
    {"k", "Optics", [](E& e, const V& v) { e.optics.k = v.list(kNotNegative); },
     [](const E& e) { return text_of(e.optics.k); }},
    {"material", "Optics",
     [](E& e, const V& v) { e.optics.material = v.text() == "none" ? "" : v.text(); },
     [](const E& e) { return e.optics.material.empty() ? "none" : e.optics.material; }},
    {"wavelengths", "Optics", [](E& e, const V& v) { e.optics.wavelengths = v.list(kVisible); },
     [](const E& e) { return text_of(e.optics.wavelengths); }},
    {"bounces", "Rays", [](E& e, const V& v) { e.run.bounces = v.integer(1, 10000); },
     [](const E& e) { return text_of(e.run.bounces); }},
    {"jitter", "Rays", [](E& e, const V& v) { e.run.jitter = v.number(kJitter); },
     [](const E& e) { return shortest(e.run.jitter); }},
    {"rays", "Rays", [](E& e, const V& v) { e.run.rays = v.count_or_auto(2, kMaxRaysPerLayer); },
     [](const E& e) { return count_or_auto(e.run.rays); }},
    {"until", "Rays",
     [](E& e, const V& v) {
         if (v.text() == "none") {
             e.run.until = e.run.until_cells = 0;
             return;
         }
         const auto shares = v.shares(kUntil, 2);
         e.run.until = shares.front();
         e.run.until_cells = shares.size() == 2 ? shares.back() : 0;
     },
     [](const E& e) {
         if (e.run.until == 0) return std::string("none");
         return e.run.until_cells > 0 ? text_of(std::vector{e.run.until, e.run.until_cells})
                                      : shortest(e.run.until);
     }},
    {"max-rays", "Rays",
     [](E& e, const V& v) { e.run.max_rays = v.count_or_auto(2, kMaxRaysPerLayer); },
     [](const E& e) { return count_or_auto(e.run.max_rays); }},
    {"batches", "Rays", [](E& e, const V& v) { e.run.batches = v.integer(2, 4096); },
     [](const E& e) { return text_of(e.run.batches); }},
    {"launch", "Rays", [](E& e, const V& v) { e.run.launch = v.choice(kLaunches); },
     [](const E& e) { return text_of(kLaunches, e.run.launch); }},
    {"seed", "Rays", [](E& e, const V& v) { e.run.seed = v.seed(); },
     [](const E& e) { return text_of(e.run.seed); }},
    {"resolution", "Detector", [](E& e, const V& v) { e.detector.resolution = v.integer(2, 8192); },
     [](const E& e) { return text_of(e.detector.resolution); }},
    {"detector", "Detector", [](E& e, const V& v) { e.detector.kind = v.choice(kDetectors); },
     [](const E& e) { return text_of(kDetectors, e.detector.kind); }},
    {"orders", "Detector", [](E& e, const V& v) { e.detector.orders = v.integer(1, 256); },
     [](const E& e) { return text_of(e.detector.orders); }},
};

}  // namespace

std::span<const ExperimentKey> experiment_keys() {
    return kKeys;
}

const ExperimentKey* find_experiment_key(std::string_view name) {
    for (const ExperimentKey& key : experiment_keys())
        if (key.name == name) return &key;
    return nullptr;
}

}  // namespace asperity::io
