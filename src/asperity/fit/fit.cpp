// SPDX-License-Identifier: Apache-2.0
#include <asperity/bsdf/models/plus_lambert.h>
#include <asperity/core/directions.h>
#include <asperity/core/error.h>
#include <asperity/fit/fit.h>
#include <asperity/fit/residuals.h>
#include <asperity/fit/verdict.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

namespace asperity {
namespace {

constexpr int kStarts = 3;
constexpr int kReweighings = 3;
constexpr double kRoughly = 1e-4, kPrecisely = 1e-7;  ///< see detail::solve

/// Digit-reversed k in a prime base, in (0, 1): Halton's points.
double radical_inverse(int k, int base) {
    double value = 0, place = 1;
    for (; k > 0; k /= base) value += (place /= base) * (k % base);
    return value;
}

/// Places all over the ranges where a search may begin, the best first.
std::vector<std::vector<double>> starts_of(const detail::Residuals& residuals) {
    constexpr std::array kPrimes = {2, 3, 5, 7, 11, 13, 17, 19, 23, 29};
    const FreeModel& model = residuals.model();
    const int count = 8 + 16 * static_cast<int>(std::min<std::size_t>(model.free.size(), 6));
    std::vector<std::pair<double, std::vector<double>>> places;
    for (int k = 1; k <= count; ++k) {
        std::vector<double> values;
        for (std::size_t p = 0; p < model.free.size(); ++p) {
            const FreeParam& param = model.free[p];
            const double u = radical_inverse(k, kPrimes[p % kPrimes.size()]);
            values.push_back(
                param.value(param.search_low() + u * (param.search_high() - param.search_low())));
        }
        double sum = 0;
        for (const double r : residuals.at(values)) sum += r * r;
        places.emplace_back(sum, std::move(values));
    }
    std::stable_sort(places.begin(), places.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    std::vector<std::vector<double>> starts;
    for (int k = 0; k < kStarts; ++k) starts.push_back(places[static_cast<std::size_t>(k)].second);
    return starts;
}

/// The best of several fits to a quarter of the data.
std::vector<double> search(const FitData& data, const FreeModel& model, FitMetric metric,
                           int threads) {
    const FitData few = detail::every_fourth(data);
    const detail::Residuals residuals(few, model, metric, threads);
    detail::Solution best;
    best.sum = std::numeric_limits<double>::infinity();
    for (const std::vector<double>& start : starts_of(residuals)) {
        if (residuals.size() <= residuals.params()) return start;
        detail::Solution found = detail::solve(residuals, start, kRoughly);
        if (found.sum < best.sum) best = std::move(found);
    }
    if (best.values.empty())
        throw Error(ErrorCode::InvalidInput, "gives no number for this model", data.name);
    return best.values;
}

/// To six digits.
double rounded(double value) {
    const std::string text = fmt::format("{:.6g}", value);
    double result = value;
    std::from_chars(text.data(), text.data() + text.size(), result);
    return result;
}

void add_layers(Fit& fit, const FitData& data) {
    const auto channels = static_cast<std::size_t>(data.channels);
    for (const FitLayer& layer : data.layers) {
        FitLayerMisfit m{layer.theta_i, layer.phi_i};
        double albedo = 0;
        for (std::size_t k = layer.first_block * channels;
             k < (layer.first_block + layer.blocks) * channels; ++k) {
            albedo += data.energy[k];
            m.l1 += std::abs(fit.energy[k] - data.energy[k]);
            m.albedo_difference += (fit.energy[k] - data.energy[k]) / data.channels;
            if (data.has_errors()) m.noise += std::sqrt(2 / kPi * data.spread[k] * data.energy[k]);
        }
        m.l1 /= albedo;
        m.noise /= albedo;
        fit.mean_l1 += m.l1 / static_cast<double>(data.layers.size());
        fit.mean_noise += m.noise / static_cast<double>(data.layers.size());
        if (std::abs(m.albedo_difference) > std::abs(fit.max_albedo_difference))
            fit.max_albedo_difference = m.albedo_difference;
        fit.layers.push_back(m);
    }
}

}  // namespace

Fit fit_model(const FitData& data, const FreeModel& model, FitMetric metric, int threads) {
    if (metric == FitMetric::Chi2 && !data.has_errors())
        throw Error(ErrorCode::Usage, "chi2 needs error bars, the data have none", "metric");
    detail::Residuals residuals(data, model, metric, threads);
    if (residuals.size() <= residuals.params())
        throw Error(ErrorCode::InvalidInput, "has fewer values than the model has parameters",
                    data.name);
    detail::Solution best =
        detail::solve(residuals, search(data, model, metric, threads), kPrecisely);
    for (int k = 0; metric == FitMetric::Chi2 && k < kReweighings; ++k) {
        residuals.expect(residuals.energy(best.values));
        best = detail::solve(residuals, best.values, kPrecisely);
    }
    detail::set_errors(residuals, best);

    Fit fit;
    std::vector<double> values;
    for (std::size_t k = 0; k < model.free.size(); ++k) {
        const FreeParam& param = model.free[k];
        const double middle = 0.5 * (param.lowest() + param.highest());
        const double end = param.coordinate(best.values[k]) < middle ? param.low : param.high;
        values.push_back(best.at_end[k] ? end : rounded(best.values[k]));
        fit.params.push_back(
            {model.free[k].key, model.free[k].entry, values[k], best.errors[k], best.at_end[k]});
    }
    fit.text = model.model.name;
    fit.spec = model.make(values)->name();
    fit.energy = residuals.energy(values);
    fit.chi2_per_dof = detail::chi2_per_dof(data, fit.energy, residuals.params());
    fit.misfit = metric == FitMetric::Chi2 ? fit.chi2_per_dof : std::sqrt(best.sum);
    add_layers(fit, data);
    return fit;
}

namespace {

std::vector<std::string> keys_of(const std::string& text) {
    return text.empty() ? std::vector<std::string>{} : split_models(text);
}

/// Whether the model of a text, "ggx:alpha=0.3", has a key.
bool has_key(const std::string& text, const std::string& key) {
    const auto model = find_bsdf_model(text.substr(0, text.find(':')));
    return model && std::any_of(model->params.begin(), model->params.end(),
                                [&](const BsdfParam& param) { return param.info.name == key; });
}

/// Throws for a key that none of the models has.
void check_keys(const std::vector<std::string>& keys, const std::vector<std::string>& models) {
    for (const std::string& key : keys) {
        const auto has = [&](const std::string& text) { return has_key(text, key); };
        if (std::none_of(models.begin(), models.end(), has))
            throw Error(ErrorCode::Usage, fmt::format("'{}' is a key of none of the models", key),
                        "free");
    }
}

}  // namespace

FitReport fit_models(const FitData& data, const FitSettings& settings, int threads) {
    Run run(threads);
    return fit_models(data, settings, run);
}

FitReport fit_models(const FitData& data, const FitSettings& settings, Run& run) {
    FitReport report;
    report.metric = settings.metric;
    if (report.metric == FitMetric::Auto)
        report.metric = data.has_errors() ? FitMetric::Chi2 : FitMetric::CubeRoot;
    FitReflectance reflectance = settings.reflectance;
    if (reflectance == FitReflectance::Auto)
        reflectance = data.knows_optics ? FitReflectance::Run : FitReflectance::F0;
    std::vector<std::string> also = keys_of(settings.free);
    const bool all = settings.models == "all";
    const std::vector<std::string> texts = split_models(all ? bsdf_model_names() : settings.models);
    check_keys(also, texts);
    if (texts.empty()) throw Error(ErrorCode::Usage, "names no model", "model");
    const auto with_lambert = [&](const std::string& text) {
        return settings.lambert && has_key(text, kLambertKey);
    };
    if (settings.lambert) {
        if (std::none_of(texts.begin(), texts.end(), with_lambert))
            throw Error(ErrorCode::Usage, "none of the models takes a diffuse part", "lambert");
        also.emplace_back(kLambertKey);
    }
    run.begin("fitting models", texts.size());
    for (const std::string& text : texts) {
        if (!run.keep_going()) throw Error(ErrorCode::Stopped, "stopped while fitting");
        try {
            const FreeModel model = free_model(text, data, reflectance, also);
            report.fits.push_back(fit_model(data, model, report.metric, run.threads()));
            report.fits.back().text = text + (with_lambert(text) ? " plus lambert" : "");
        } catch (const Error& error) {
            if (!all || error.code() != ErrorCode::Usage || error.where() == "metric" ||
                error.where() == "free" || error.where() == "reflectance")
                throw;
        }
        run.advance(1);
    }
    run.end();
    std::stable_sort(report.fits.begin(), report.fits.end(),
                     [](const Fit& a, const Fit& b) { return a.misfit < b.misfit; });
    report.verdict = verdict_of(report.fits);
    report.note = data.errors_lack;
    return report;
}

}  // namespace asperity
