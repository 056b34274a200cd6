// SPDX-License-Identifier: Apache-2.0
#include "arrays.h"
#include "core.h"
#include "own_bsdf.h"
#include "task.h"

#include <asperity/core/directions.h>
#include <asperity/core/error.h>
#include <asperity/core/run.h>
#include <asperity/fit/fit.h>
#include <asperity/gonio/experiment_text.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

namespace asperity::python {
namespace {

FitSettings fit_settings(const SettingTexts& texts) {
    FitSettings settings;
    const ParamTable<FitSettings> table = fit_params();
    for (const auto& [key, value] : texts) {
        const Param<FitSettings>* row = find(table, key);
        if (row == nullptr) throw Error(ErrorCode::Usage, "there is no such setting", key);
        row->apply(settings, value);
    }
    return settings;
}

nb::dict to_dict(const Fit& fit) {
    nb::dict d;
    d["model"] = fit.text;
    d["spec"] = fit.spec;
    d["misfit"] = fit.misfit;
    d["chi2_per_dof"] = fit.chi2_per_dof;
    d["mean_l1"] = fit.mean_l1;
    d["mean_noise"] = fit.mean_noise;
    d["max_albedo_difference"] = fit.max_albedo_difference;
    nb::list params;
    for (const FittedParam& p : fit.params)
        params.append(nb::make_tuple(p.key, p.entry, p.value, p.error, p.at_end));
    d["params"] = params;
    std::vector<double> theta, phi, l1, noise;
    for (const FitLayerMisfit& layer : fit.layers) {
        theta.push_back(layer.theta_i);
        phi.push_back(layer.phi_i);
        l1.push_back(layer.l1);
        noise.push_back(layer.noise);
    }
    const std::size_t count = theta.size();
    d["theta"] = to_array(std::move(theta), {count});
    d["phi"] = to_array(std::move(phi), {count});
    d["l1"] = to_array(std::move(l1), {count});
    d["noise"] = to_array(std::move(noise), {count});
    return d;
}

nb::dict to_dict(const FitReport& report) {
    nb::dict d;
    d["metric"] = fit_metric_name(report.metric);
    d["verdict"] = report.verdict;
    d["note"] = report.note;
    nb::list fits;
    for (const Fit& fit : report.fits) fits.append(to_dict(fit));
    d["fits"] = fits;
    return d;
}

/// Makes the data and fits. A stop between two models is an Error.
template <typename MakeData>
nb::dict run_fit(const FitSettings& settings, int threads, const Callbacks& callbacks,
                 MakeData&& make_data) {
    Run run(threads);
    const auto outcome = run_task(
        run, callbacks, [&] { return fit_models(make_data(run.threads()), settings, run); });
    if (outcome.interrupted) {
        PyErr_SetNone(PyExc_KeyboardInterrupt);
        throw nb::python_error();
    }
    return to_dict(outcome.value);
}

nb::dict fit_measurement(const MeasurementHandle& m, const SettingTexts& texts, const SettingTexts&,
                         int threads, const Callbacks& callbacks) {
    const FitSettings settings = fit_settings(texts);
    return run_fit(settings, threads, callbacks, [&](int) {
        return fit_data(*m.measurement, settings.light, radians(settings.last_theta_deg));
    });
}

/// The cells and incidences that a BSDF without error bars is averaged over.
Experiment cells_of(const Bsdf& bsdf, const FitSettings& settings, const SettingTexts& texts) {
    if (settings.light == FitLight::Single)
        throw Error(ErrorCode::Usage, "a BSDF does not tell how often light was reflected",
                    "light");
    Experiment experiment;
    experiment.detector.resolution = 64;
    for (const auto& [key, value] : texts) apply_setting(experiment, key, value);
    if (bsdf.isotropic()) experiment.illumination.isotropic = true;
    validate(experiment);
    return experiment;
}

nb::dict fit_bsdf(const BsdfHandle& b, const SettingTexts& texts, const SettingTexts& cells,
                  int threads, const Callbacks& callbacks) {
    const FitSettings settings = fit_settings(texts);
    const Experiment experiment = cells_of(*b.bsdf, settings, cells);
    return run_fit(settings, threads, callbacks, [&](int count) {
        return fit_data(*b.bsdf, experiment, radians(settings.last_theta_deg), count);
    });
}

nb::dict fit_own(OwnBsdf& own, const SettingTexts& texts, const SettingTexts& cells, int threads,
                 const Callbacks& callbacks) {
    const FitSettings settings = fit_settings(texts);
    const Experiment experiment = cells_of(own, settings, cells);
    const int count = Run(threads).threads();
    const FitData data = with_answers(own, [&](const Bsdf& bsdf) {
        return fit_data(bsdf, experiment, radians(settings.last_theta_deg), count);
    });
    return run_fit(settings, threads, callbacks, [&](int) { return data; });
}

}  // namespace

void add_fits(nb::module_& module) {
    module.def("fit_settings", [] {
        nb::list rows;
        for (const Param<FitSettings>& param : fit_params())
            rows.append(setting_row(param.info, param.default_text()));
        return rows;
    });
    module.def("fit", fit_measurement);
    module.def("fit", fit_bsdf);
    module.def("fit", fit_own);
}

}  // namespace asperity::python
