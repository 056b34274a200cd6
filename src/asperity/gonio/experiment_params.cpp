// SPDX-License-Identifier: Apache-2.0
#include <asperity/gonio/experiment_params.h>

#include <asperity/core/energy.h>
#include <asperity/optics/optics_params.h>
#include <asperity/params/fields.h>
#include <asperity/surface/surface_params.h>
#include <asperity/tracing/engine.h>
#include <fmt/format.h>

namespace asperity {

namespace {

constexpr Names<DetectorKind, 2> kDetectors = {{
    {"latlong", DetectorKind::LatLong},
    {"equal-area", DetectorKind::EqualArea},
}};
constexpr Names<LaunchPattern, 3> kLaunches = {{
    {"low-discrepancy", LaunchPattern::LowDiscrepancy},
    {"stratified", LaunchPattern::Stratified},
    {"random", LaunchPattern::Random},
}};
constexpr double kMostSurfaces = 32768;
constexpr Range kRays = {2, static_cast<double>(kMaxRaysPerLayer)};

/// The relative errors to reach, of the albedo and of the cells.
Param<RunSettings> until_row() {
    Param<RunSettings> row;
    row.info = {.name = "until",
                .metavar = "P[,Q]",
                .range = {0, 1, true, true},
                .absent = "none",
                .doc =
                    "go on until the relative standard error of the albedo is below P, and that "
                    "of the cells with 90 % of the energy below Q (P if not given): 1% or 0.01",
                .otherwise = "one pass",
                .percent = true,
                .most = 2,
                .type = ParamType::List};
    row.get = [](const RunSettings& s) {
        std::vector<double> errors;
        if (s.until != 0) errors.push_back(s.until);
        if (s.until != 0 && s.until_cells > 0) errors.push_back(s.until_cells);
        return errors;
    };
    row.set = [](RunSettings& s, const ParamValue& v) {
        const auto& errors = std::get<std::vector<double>>(v);
        s.until = errors.empty() ? 0 : errors.front();
        s.until_cells = errors.size() < 2 ? 0 : errors.back();
    };
    return row;
}

/// Written where it is not the default, as files of older versions do not have it.
Param<RunSettings> surfaces_row() {
    using S = RunSettings;
    return field(&S::surfaces,
                 {.name = "surfaces",
                  .label = "Surfaces",
                  .metavar = "K",
                  .range = {1, kMostSurfaces},
                  .absent = "auto",
                  .doc = "measure the class, not one surface: the mean over K surfaces of seeds S, "
                         "S + 1 ..., which share the rays; errors hold the chance of both; auto: "
                         "as many as the rays are best shared out to",
                  .written_unless_default = true});
}

Param<RunSettings> batches_row() {
    using S = RunSettings;
    Param<S> row = field(&S::batches, {.name = "batches",
                                       .range = {2, 4096},
                                       .doc = "independent batches per layer, from which errors "
                                              "are estimated"});
    row.unused = [](const S& s) {
        return std::string(s.surfaces == 1 ? ""
                                           : "each of the --surfaces is a batch: their number says "
                                             "how many there are");
    };
    return row;
}

/// Written where it is not the default, as files of older versions do not have it.
Param<RunSettings> engine_row() {
    Param<RunSettings> row;
    row.info.name = "engine";
    row.info.doc = "how rays are followed:";
    row.info.written_unless_default = true;
    row.info.type = ParamType::Choice;
    for (const EngineKind& kind : engines()) {
        row.info.choices.emplace_back(kind.name);
        row.info.doc += fmt::format("{} {}, {}", row.info.choices.size() > 1 ? ";" : "", kind.name,
                                    kind.sentence);
    }
    row.get = [](const RunSettings& s) { return ParamValue(s.engine); };
    row.set = [](RunSettings& s, const ParamValue& v) { s.engine = std::get<std::string>(v); };
    return row;
}

/// A row of its own, as the word stands for no number.
Param<IlluminationSettings> layers_row() {
    using S = IlluminationSettings;
    Param<S> row = field(
        &S::layers, {.name = "layers",
                     .range = {1, 9000},
                     .absent = "auto",
                     .doc = "thesis layers: layer k of N stands at elevation 90 k / N degrees, the "
                            "last is normal incidence; auto: incident angles as the surface's "
                            "lobes ask, closer towards the horizon, for BRDFs read between them"});
    row.get = [](const S& s) {
        return s.layers == 0 ? ParamValue() : ParamValue(static_cast<std::int64_t>(s.layers));
    };
    return row;
}

template <typename Settings>
ParamTable<Settings> grouped(const char* group, ParamTable<Settings> table) {
    for (Param<Settings>& row : table) row.info.group = group;
    return table;
}

}  // namespace

ParamTable<IlluminationSettings> illumination_params() {
    using S = IlluminationSettings;
    return grouped<S>(
        "Light",
        {
            field(&S::theta_deg, {.name = "theta",
                                  .metavar = "D[,D...]",
                                  .unit = "degrees",
                                  .range = kBelowHorizon,
                                  .absent = "none",
                                  .doc = "incident polar angles: 0,30,60 or, from 0 to 80 in "
                                         "steps of 10, 0:80:10",
                                  .otherwise = "the layers' angles"}),
            field(&S::phi_deg, {.name = "phi",
                                .metavar = "D[,D...]",
                                .unit = "degrees",
                                .range = {-360, 360},
                                .absent = "none",
                                .doc = "azimuths the light comes from; every theta x every phi"}),
            layers_row(),
            field(&S::isotropic,
                  {.name = "isotropic",
                   .label = "Light from all azimuths",
                   .doc = "averaged over the azimuth of the light, from which that of what "
                          "leaves is counted: for surfaces "
                          "that are the same from all sides"}),
        });
}

ParamTable<DetectorSettings> detector_params() {
    using S = DetectorSettings;
    return grouped<S>("Detector",
                      {
                          field(&S::resolution, {.name = "resolution",
                                                 .label = "Texture Resolution",
                                                 .metavar = "R",
                                                 .range = {2, 8192},
                                                 .doc = "R columns x R/2 rows of outgoing "
                                                        "directions"}),
                          field(&S::kind, kDetectors,
                                {.name = "detector",
                                 .doc = "latlong (rows equal in angle, the thesis' sky-map) or "
                                        "equal-area (cells of equal projected solid angle)"}),
                          field(&S::orders, {.name = "orders",
                                             .range = {1, 256},
                                             .doc = "bounce orders kept apart per cell; the last "
                                                    "one holds all higher ones"}),
                      });
}

namespace {

Param<RunSettings> max_rays_row() {
    using S = RunSettings;
    Param<S> row = field(&S::max_rays, {.name = "max-rays",
                                        .range = kRays,
                                        .absent = "auto",
                                        .doc = "with --until: no more rays per layer than this",
                                        .otherwise = "256 x the first estimate"});
    row.unused = [](const S& s) {
        return std::string(s.until > 0 ? ""
                                       : "limits a run with --until, which is not given; the rays "
                                         "of others are those of --jitter or --rays");
    };
    return row;
}

}  // namespace

ParamTable<RunSettings> run_params() {
    using S = RunSettings;
    ParamTable<S> table = {
        field(&S::bounces,
              {.name = "bounces",
               .label = "Ray Bounces",
               .metavar = "B",
               .range = {1, 10000},
               .doc = "reflections a ray may make; what still travels then is truncated"}),
        surfaces_row(),
        field(&S::jitter, {.name = "jitter",
                           .label = "Camera Jitter",
                           .metavar = "J",
                           .range = {0, 1e9, true},
                           .absent = "auto",
                           .doc = "rays per surface cell and layer (the thesis' Camera Jitter)",
                           .otherwise = "16, or fewer on more than 4 million cells"}),
        field(&S::rays, {.name = "rays",
                         .range = kRays,
                         .absent = "auto",
                         .doc = "rays per layer, in place of --jitter",
                         .otherwise = "jitter x cells"}),
        until_row(),
        max_rays_row(),
        batches_row(),
        field(&S::launch, kLaunches,
              {.name = "launch", .doc = "launch points: low-discrepancy, stratified or random"}),
        field(&S::seed, {.name = "seed",
                         .metavar = "K",
                         .doc = "seed of the rays; same settings, same seed: same result"}),
        engine_row(),
    };
    return grouped<S>("Rays", std::move(table));
}

ParamTable<Experiment> experiment_params() {
    ParamTable<Experiment> table;
    append(table, surface_params(), &Experiment::surface);
    append(table, illumination_params(), &Experiment::illumination);
    append(table, optics_params(), &Experiment::optics);
    append(table, run_params(), &Experiment::run);
    append(table, detector_params(), &Experiment::detector);
    return table;
}

}  // namespace asperity
