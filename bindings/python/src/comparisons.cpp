// SPDX-License-Identifier: Apache-2.0
#include "arrays.h"
#include "core.h"
#include "own_bsdf.h"

#include <asperity/core/run.h>
#include <asperity/gonio/experiment_text.h>
#include <asperity/measured/compare.h>
#include <asperity/measured/lobe_slice.h>
#include <asperity/measured/normal_profile.h>
#include <asperity/surface/normal_distribution.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

namespace asperity::python {
namespace {

template <typename Get>
nb::ndarray<nb::numpy, double> column(const Comparison& c, Get get) {
    std::vector<double> values;
    for (const LayerComparison& layer : c.layers) values.push_back(get(layer));
    return to_array(std::move(values), {c.layers.size()});
}

nb::dict to_dict(const Comparison& c) {
    nb::dict d;
    using L = LayerComparison;
    d["theta"] = column(c, [](const L& l) { return l.theta_i; });
    d["phi"] = column(c, [](const L& l) { return l.phi_i; });
    d["albedo_a"] = column(c, [](const L& l) { return l.albedo_a; });
    d["albedo_b"] = column(c, [](const L& l) { return l.albedo_b; });
    d["l1"] = column(c, [](const L& l) { return l.l1; });
    d["l1_noise"] = column(c, [](const L& l) { return l.l1_noise; });
    d["l1_stderr"] = column(c, [](const L& l) { return l.l1_error; });
    d["rms"] = column(c, [](const L& l) { return l.rms; });
    d["rms_stderr"] = column(c, [](const L& l) { return l.rms_error; });
    d["mean_l1"] = c.mean_l1;
    d["mean_l1_stderr"] = c.mean_l1_error;
    d["mean_rms"] = c.mean_rms;
    d["mean_rms_stderr"] = c.mean_rms_error;
    d["max_albedo_difference"] = c.max_albedo_difference;
    return d;
}

Experiment cells_of(const SettingTexts& texts) {
    Experiment experiment;
    for (const auto& [key, value] : texts) apply_setting(experiment, key, value);
    validate(experiment);
    return experiment;
}

int all(int threads) {
    return Run(threads).threads();
}

nb::dict lobe_dict(const LobeSlice& slice) {
    std::vector<double> theta, f, error, f_cos, f_cos_error;
    for (const LobeSample& s : slice.samples) {
        theta.push_back(s.theta_o);
        f.push_back(s.f);
        error.push_back(s.f_stderr);
        f_cos.push_back(s.f_cos);
        f_cos_error.push_back(s.f_cos_stderr);
    }
    const std::size_t count = theta.size();
    nb::dict d;
    d["theta"] = to_array(std::move(theta), {count});
    d["f"] = to_array(std::move(f), {count});
    d["f_stderr"] = to_array(std::move(error), {count});
    d["f_cos"] = to_array(std::move(f_cos), {count});
    d["f_cos_stderr"] = to_array(std::move(f_cos_error), {count});
    return d;
}

void add_lobes(nb::module_& module) {
    module.def("lobe", [](const MeasurementHandle& m, std::size_t layer, int channel) {
        return lobe_dict(lobe_slice(*m.measurement, m.measurement->layers.at(layer), channel));
    });
    module.def("lobe",
               [](const BsdfHandle& b, const MeasurementHandle& m, std::size_t layer, int channel) {
                   return lobe_dict(lobe_slice(*b.bsdf, *m.measurement,
                                               m.measurement->layers.at(layer), channel));
               });
    module.def("lobe", [](OwnBsdf& b, const MeasurementHandle& m, std::size_t layer, int channel) {
        return lobe_dict(with_answers(b, [&](const Bsdf& bsdf) {
            return lobe_slice(bsdf, *m.measurement, m.measurement->layers.at(layer), channel);
        }));
    });
    module.def("normal_distribution",
               [](const SurfaceHandle& s, int theta_bins, int phi_bins, int threads) {
                   NormalDistribution d;
                   {
                       const nb::gil_scoped_release free;
                       d = normal_distribution(*s.heights, theta_bins, phi_bins, all(threads));
                   }
                   return to_array(std::move(d.density), {static_cast<std::size_t>(theta_bins),
                                                          static_cast<std::size_t>(phi_bins)});
               });
    module.def("normal_profile_of_law", [](const std::string& family, double alpha, int bins) {
        const SlopeFamily law = family == "ggx" ? SlopeFamily::Ggx : SlopeFamily::Beckmann;
        return to_array(normal_profile(law, alpha, bins).density, {static_cast<std::size_t>(bins)});
    });
}

}  // namespace

void add_comparisons(nb::module_& module) {
    using M = const MeasurementHandle&;
    using B = const BsdfHandle&;
    module.def("compare", [](M a, M b, const SettingTexts&, int) {
        const nb::gil_scoped_release free;
        const Comparison c = compare(*a.measurement, *b.measurement);
        const nb::gil_scoped_acquire held;
        return to_dict(c);
    });
    module.def("compare", [](M a, B b, const SettingTexts&, int threads) {
        const nb::gil_scoped_release free;
        const Comparison c = compare(*a.measurement, *b.bsdf, all(threads));
        const nb::gil_scoped_acquire held;
        return to_dict(c);
    });
    module.def("compare", [](M a, OwnBsdf& b, const SettingTexts&, int threads) {
        return to_dict(with_answers(
            b, [&](const Bsdf& bsdf) { return compare(*a.measurement, bsdf, all(threads)); }));
    });
    module.def("compare", [](B a, B b, const SettingTexts& texts, int threads) {
        const Experiment experiment = cells_of(texts);
        const nb::gil_scoped_release free;
        const Comparison c = compare(*a.bsdf, *b.bsdf, experiment, all(threads));
        const nb::gil_scoped_acquire held;
        return to_dict(c);
    });
    module.def("compare", [](B a, OwnBsdf& b, const SettingTexts& texts, int threads) {
        const Experiment experiment = cells_of(texts);
        return to_dict(with_answers(
            b, [&](const Bsdf& bsdf) { return compare(*a.bsdf, bsdf, experiment, all(threads)); }));
    });
    add_lobes(module);
}

}  // namespace asperity::python
