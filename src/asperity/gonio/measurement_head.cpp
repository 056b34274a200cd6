// SPDX-License-Identifier: Apache-2.0
#include <asperity/gonio/measurement_head.h>

#include <asperity/core/error.h>
#include <asperity/core/version.h>
#include <asperity/gonio/experiment_text.h>
#include <asperity/optics/fresnel.h>
#include <asperity/surface/digest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace asperity {

Measurement head_of(const Heightfield& surface, const Experiment& experiment, const Run& run) {
    Measurement m;
    m.experiment = experiment;
    m.experiment.run.jitter = jitter_of(experiment.run, surface.cell_count());
    m.experiment.run.surfaces = surfaces_of(experiment.run, surface.cell_count());
    m.detector = Detector(experiment.detector);
    m.channel_names = Fresnel(experiment.optics).channel_names();
    m.surface_name = surface.name;
    if (!surface.tiling.empty()) m.surface_name += ", " + surface.tiling;
    m.surface_nx = surface.nx;
    m.surface_ny = surface.ny;
    m.surface_dx = surface.dx;
    m.surface_dy = surface.dy;
    m.surface_isotropic = surface.isotropic;
    m.surface_digest = digest(surface);
    m.surface_cells = surface.cell_count();
    m.threads = run.threads();
    m.version = kVersion;
    if (m.experiment.run.surfaces > 1)
        m.notes.push_back(fmt::format(
            "the surface stands for its class: rays are shared by {}, surface-seeds {} and on{}; "
            "name and figures are those of the first",
            m.experiment.run.surfaces, experiment.surface.seed,
            experiment.run.until > 0 ? ", and by more where layers are refined" : ""));
    if (!surface.source.empty()) m.notes.push_back("the surface's file: " + surface.source);
    if (!surface.prepared.empty())
        m.notes.push_back("the surface was made ready: " + surface.prepared);
    if (experiment.illumination.isotropic && !surface.isotropic)
        m.notes.push_back(
            "the surface does not declare itself isotropic: layers are averages over the "
            "azimuth of the light");
    if (experiment.optics.fresnel == FresnelKind::Dielectric && experiment.run.bounces > 1)
        m.notes.emplace_back(
            "facets average both polarisations: what a dielectric reflects twice may be up to 41 % "
            "too dark");
    return m;
}

std::string narrow_lobes(const Measurement& head, const std::vector<double>& theta_i) {
    constexpr double kFewCells = 8;
    // A facet tilted by a turns light from above by 2 a, and sideways by 2 a cos(theta_i)
    const double width = 2 * head.surface.rms_gradient;
    const double cells = width * head.detector.rows() / (0.5 * kPi);
    if (!(width > 0) || cells >= kFewCells || theta_i.empty()) return {};
    const double column = 2 * kPi / head.detector.columns();
    const double most = *std::max_element(theta_i.begin(), theta_i.end());
    if (width * std::cos(most) >= column) return {};
    const double from = degrees(std::acos(std::min(1.0, column / width)));
    constexpr double kStep = 32;
    const double enough = kStep * std::ceil(head.detector.columns() * kFewCells / (cells * kStep));
    return fmt::format(
        "lobes of alpha {:.2g} are {:.2g} cells wide in light from above, and from {:.0f} degrees "
        "on narrower than a cell: read between cells and layers they are rough; --resolution {} "
        "resolves them, or a rougher surface",
        head.surface.rms_gradient, cells, from, enough);
}

std::string narrow_lobes(const Measurement& measurement) {
    std::vector<double> theta_i;
    for (const Layer& layer : measurement.layers) theta_i.push_back(layer.theta_i);
    return narrow_lobes(measurement, theta_i);
}

void check(const MeasureScope& scope) {
    if (scope.parts < 1 || scope.part < 1 || scope.part > scope.parts)
        throw Error(ErrorCode::Usage, "a part is one of 1/N to N/N", "part");
}

void note_scope(Measurement& head, const MeasureScope& scope) {
    head.part = scope.part;
    head.parts = scope.parts;
    if (scope.parts > 1)
        head.notes.push_back(
            fmt::format("part {} of {}: a share of the rays, to be merged with the others",
                        scope.part, scope.parts));
    if (!scope.so_far) return;
    require_same_experiment(*scope.so_far, head, "result");
    head.trace_seconds = scope.so_far->trace_seconds;
}

void require_same_experiment(const Measurement& so_far, const Measurement& head,
                             const std::string& where) {
    const auto differ = [&](const std::string& what) {
        throw Error(ErrorCode::InvalidInput, "it is of another experiment: " + what, where);
    };
    Experiment was = so_far.experiment;
    was.run.until = head.experiment.run.until;
    was.run.until_cells = head.experiment.run.until_cells;
    was.run.max_rays = head.experiment.run.max_rays;
    const std::vector<Setting> a = settings_of(was), b = settings_of(head.experiment);
    for (std::size_t k = 0; k < std::min(a.size(), b.size()); ++k)
        if (a[k].key != b[k].key)
            differ(fmt::format("it has {} where this one has {}", a[k].key, b[k].key));
        else if (a[k].value != b[k].value)
            differ(fmt::format("{} is {} there and {} here", a[k].key, a[k].value, b[k].value));
    if (so_far.shape() != head.shape()) differ("its sums have other sizes");
    if (so_far.surface_digest != head.surface_digest)
        differ("its surface has other heights, though its settings are the same");
}

}  // namespace asperity
