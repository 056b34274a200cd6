// SPDX-License-Identifier: Apache-2.0
#include <asperity/fit/fit.h>
#include <asperity/params/fields.h>

namespace asperity {
namespace {

constexpr Names<FitMetric, 5> kMetrics = {{
    {"auto", FitMetric::Auto},
    {"chi2", FitMetric::Chi2},
    {"l2", FitMetric::L2},
    {"log", FitMetric::Log},
    {"cube-root", FitMetric::CubeRoot},
}};
constexpr Names<FitReflectance, 5> kReflectances = {{
    {"auto", FitReflectance::Auto},
    {"run", FitReflectance::Run},
    {"f0", FitReflectance::F0},
    {"ior", FitReflectance::Ior},
    {"conductor", FitReflectance::Conductor},
}};
constexpr Names<FitLight, 2> kLights = {{
    {"all", FitLight::All},
    {"single", FitLight::Single},
}};

}  // namespace

ParamTable<FitSettings> fit_params() {
    using S = FitSettings;
    ParamTable<S> table = {
        field(&S::models, {.name = "model",
                           .metavar = "NAME[:KEY=VALUE,...][,NAME...]",
                           .doc = "models to fit, all or some; keys that are given are fixed"}),
        field(
            &S::metric, kMetrics,
            {.name = "metric",
             .doc = "what is made small: chi2, by the errors of the data; or of f cos the l2, log "
                    "or cube-root difference; auto: chi2 where there are errors, else cube-root"}),
        field(&S::reflectance, kReflectances,
              {.name = "reflectance",
               .doc = "of the facets: run, fixed as it was; or free: f0 (Schlick), ior "
                      "(dielectric), conductor (n and k); auto: run where it is known, else f0"}),
        field(&S::free, {.name = "free",
                         .metavar = "KEY[,KEY...]",
                         .absent = "none",
                         .doc = "more keys to set free, such as alpha_y"}),
        field(&S::lambert, {.name = "lambert",
                            .label = "Plus Lambert",
                            .doc = "adds a diffuse part to each model, its albedo free: the key "
                                   "lambert of the result"}),
        field(
            &S::light, kLights,
            {.name = "light",
             .doc = "all light, or single: what was reflected once, as microfacet models have it"}),
        field(&S::last_theta_deg, {.name = "max-theta",
                                   .unit = "degrees",
                                   .range = {1, 90},
                                   .doc = "no layer from here on, and no cell"}),
    };
    for (Param<S>& row : table) row.info.group = "Fit";
    return table;
}

std::string fit_metric_name(FitMetric metric) {
    return name_of(kMetrics, metric);
}

}  // namespace asperity
