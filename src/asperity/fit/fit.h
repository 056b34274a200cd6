// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/core/run.h>
#include <asperity/fit/fit_data.h>
#include <asperity/fit/free_params.h>
#include <asperity/params/param.h>

#include <limits>
#include <string>
#include <vector>

namespace asperity {

/// What a fit makes small. v is the mean of f cos(theta_o) over a block [1/sr], v^ the model's.
enum class FitMetric {
    Auto,      ///< Chi2 where there are errors, else CubeRoot
    Chi2,      ///< sum of (v - v^)^2 / variance, over the degrees of freedom
    L2,        ///< root mean square of v - v^ over the hemisphere (Ngan et al. 2005) [1/sr]
    Log,       ///< of ln(1 + v) - ln(1 + v^) (Löw et al. 2012)
    CubeRoot,  ///< of cbrt(v) - cbrt(v^) (Fores et al. 2012)
};

struct FitSettings {
    std::string models = "all";  ///< as split_models() takes them, or "all" of the registry
    FitMetric metric = FitMetric::Auto;
    FitReflectance reflectance = FitReflectance::Auto;
    std::string free;      ///< keys between commas that are free, too
    bool lambert = false;  ///< a diffuse part, free, is added to each model that has none
    FitLight light = FitLight::All;
    double last_theta_deg = 85;  ///< no incidence and no outgoing direction beyond
};

/// A row for each: "model", "metric", "reflectance", "free", "lambert", "light", "max-theta".
ParamTable<FitSettings> fit_params();

struct FittedParam {
    std::string key;
    int entry = -1;  ///< of a list, from 0; -1: no list
    double value = 0;
    double error = 0;  ///< standard error; NaN: at an end of its range, or the data do not tell
    bool at_end = false;
};

/// How near a model comes to the data of one incidence.
struct FitLayerMisfit {
    double theta_i = 0, phi_i = 0;
    double l1 = 0;     ///< sum over blocks of |energy - model's|, as a share of the albedo
    double noise = 0;  ///< what l1 the errors alone would give
    double albedo_difference = 0;  ///< model - data, absolute, over the blocks; channels averaged
};

/// A model fitted.
struct Fit {
    std::string
        text;  ///< the model as it was asked for; "ggx plus lambert" by FitSettings::lambert
    std::string spec;  ///< the specification that parse_brdf_spec reads, numbers to six digits
    std::vector<FittedParam> params;
    double misfit = 0;  ///< by the metric
    /// Chi-square over degrees of freedom, whatever the metric; NaN where errors are not known.
    double chi2_per_dof = std::numeric_limits<double>::quiet_NaN();
    double mean_l1 = 0, mean_noise = 0;  ///< over the layers
    double max_albedo_difference = 0;    ///< the one farthest from 0, with its sign
    std::vector<FitLayerMisfit> layers;
    std::vector<double> energy;  ///< as predict() gives it
};

/// Fits one model: a search over its ranges and Levenberg and Marquardt's method from the three
/// best places on a quarter of the blocks, then on all of them. For Chi2 the variances are those
/// that the model expects (FitData::spread), found anew three times: weights by the rays that were
/// counted would draw everything down.
///
/// Errors of parameters are those of the light: how the fit would spread with other rays on the
/// same surfaces, whether the model describes them or not. They come from batches, which tell what
/// all blocks of a layer do together (CellErrors); data without batches count blocks as independent
/// and the channels of a ray as one, data without errors take the residuals for noise. They are
/// intervals of a class only for measurements of many of its surfaces (`surfaces`), 48 and more;
/// from 16 they are too small by a sixth. Variances of blocks of several cells are those of
/// batches, so chi^2/dof is 1 in the mean for a true model. Same result for any number of threads.
/// Throws Error(Usage, ...) for a model that the data do not go with.
Fit fit_model(const FitData& data, const FreeModel& model, FitMetric metric, int threads);

/// All that `settings` ask for; see fit_models().
struct FitReport {
    FitMetric metric = FitMetric::Chi2;
    std::vector<Fit> fits;  ///< best first
    std::string verdict;    ///< in words, one sentence or two
    std::string note;       ///< FitData::errors_lack
};

/// Fits all that `settings` ask for. Throws Error(Usage, "name of the setting"); of "all"
/// models those that the data do not go with are left out.
FitReport fit_models(const FitData& data, const FitSettings& settings, int threads);
/// The same with progress, a step a model, and a stop between two of them: Error(Stopped).
FitReport fit_models(const FitData& data, const FitSettings& settings, Run& run);

/// "chi2", "l2", "log", "cube-root".
std::string fit_metric_name(FitMetric metric);

}  // namespace asperity
