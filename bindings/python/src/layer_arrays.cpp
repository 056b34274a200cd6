// SPDX-License-Identifier: Apache-2.0
// The figures of a measurement as arrays, the layer first.
#include "arrays.h"
#include "core.h"

#include <asperity/core/energy.h>
#include <asperity/gonio/noise_shares.h>
#include <nanobind/stl/vector.h>

#include <functional>

namespace asperity::python {
namespace {

std::size_t size(int n) {
    return static_cast<std::size_t>(n);
}

/// One number a layer.
template <typename T, typename Get>
nb::ndarray<nb::numpy, T> by_layer(const Measurement& m, Get get) {
    std::vector<T> values;
    for (const Layer& layer : m.layers) values.push_back(static_cast<T>(get(layer)));
    return to_array(std::move(values), {m.layers.size()});
}

/// get(layer, channel) for all: [layer, channel].
template <typename Get>
nb::ndarray<nb::numpy, double> by_channel(const Measurement& m, Get get) {
    std::vector<double> values;
    for (const Layer& layer : m.layers)
        for (int c = 0; c < m.channels(); ++c) values.push_back(get(layer, c));
    return to_array(std::move(values), {m.layers.size(), size(m.channels())});
}

/// get(layer, channel, cell) for all: [layer, channel, row, column].
template <typename Get>
nb::ndarray<nb::numpy, double> by_cell(const Measurement& m, Get get) {
    const std::size_t count = m.layers.size() * size(m.channels()) * size(m.detector.cells());
    std::vector<double> values;
    {
        const nb::gil_scoped_release free;
        values.reserve(count);
        for (const Layer& layer : m.layers)
            for (int c = 0; c < m.channels(); ++c)
                for (int cell = 0; cell < m.detector.cells(); ++cell)
                    values.push_back(get(layer, c, cell));
    }
    return to_array(std::move(values), {m.layers.size(), size(m.channels()),
                                        size(m.detector.rows()), size(m.detector.columns())});
}

/// f of each bounce order: [layer, order, channel, row, column].
nb::ndarray<nb::numpy, double> brdf_by_order(const Measurement& m) {
    std::vector<double> values;
    {
        const nb::gil_scoped_release free;
        for (const Layer& layer : m.layers)
            for (int order = 0; order < m.orders(); ++order)
                for (int c = 0; c < m.channels(); ++c)
                    for (int cell = 0; cell < m.detector.cells(); ++cell)
                        values.push_back(
                            m.energy(layer, order, c, cell) /
                            m.detector.projected_solid_angle(cell / m.detector.columns()));
    }
    return to_array(std::move(values), {m.layers.size(), size(m.orders()), size(m.channels()),
                                        size(m.detector.rows()), size(m.detector.columns())});
}

/// [layer, channel, bounce].
template <typename Get>
nb::ndarray<nb::numpy, double> by_bounce(const Measurement& m, Get get) {
    std::vector<double> values;
    for (const Layer& layer : m.layers)
        for (int c = 0; c < m.channels(); ++c)
            for (int k = 0; k < m.bounces(); ++k) values.push_back(get(layer, c, k));
    return to_array(std::move(values), {m.layers.size(), size(m.channels()), size(m.bounces())});
}

/// The library's own counts of a layer, not copied.
nb::ndarray<nb::numpy, const std::uint64_t> energy_view(const MeasurementHandle& h, int layer) {
    const Measurement& m = *h.measurement;
    if (layer < 0 || size(layer) >= m.layers.size())
        throw nb::index_error("there is no such layer");
    return to_view<std::uint64_t, Measurement>(
        m.layers[size(layer)].energy.data(),
        {size(m.orders()), size(m.channels()), size(m.detector.rows()), size(m.detector.columns())},
        h.measurement);
}

nb::ndarray<nb::numpy, double> edges(int count, const std::function<double(int)>& edge) {
    std::vector<double> values;
    for (int k = 0; k < count; ++k) values.push_back(edge(k));
    return to_array(std::move(values), {size(count)});
}

double share(const std::vector<std::uint64_t>& energies, const Layer& layer, int channel) {
    return energy_fraction(energies.at(size(channel)), layer.rays);
}

using Handle = const MeasurementHandle&;

}  // namespace

void add_layer_arrays(nb::class_<MeasurementHandle>& m) {
    m.def_prop_ro(
         "layers", [](Handle h) { return h.measurement->layers.size(); }, "Number of layers.")
        .def_prop_ro("orders", [](Handle h) { return h.measurement->orders(); })
        .def_prop_ro(
            "number",
            [](Handle h) {
                return by_layer<std::int64_t>(*h.measurement,
                                              [](const Layer& l) { return l.number; });
            },
            nb::rv_policy::automatic)
        .def_prop_ro(
            "theta",
            [](Handle h) {
                return by_layer<double>(*h.measurement, [](const Layer& l) { return l.theta_i; });
            },
            nb::rv_policy::automatic)
        .def_prop_ro(
            "phi",
            [](Handle h) {
                return by_layer<double>(*h.measurement, [](const Layer& l) { return l.phi_i; });
            },
            nb::rv_policy::automatic)
        .def_prop_ro(
            "rays",
            [](Handle h) {
                return by_layer<std::uint64_t>(*h.measurement,
                                               [](const Layer& l) { return l.rays; });
            },
            nb::rv_policy::automatic)
        .def_prop_ro(
            "segments",
            [](Handle h) {
                return by_layer<std::uint64_t>(*h.measurement,
                                               [](const Layer& l) { return l.segments; });
            },
            nb::rv_policy::automatic)
        .def_prop_ro(
            "batches",
            [](Handle h) {
                return by_layer<std::int64_t>(*h.measurement,
                                              [](const Layer& l) { return l.batches; });
            },
            nb::rv_policy::automatic)
        .def_prop_ro(
            "albedo",
            [](Handle h) {
                const Measurement& r = *h.measurement;
                return by_channel(r, [&](const Layer& l, int c) { return r.albedo(l, c); });
            },
            nb::rv_policy::automatic)
        .def_prop_ro(
            "albedo_stderr",
            [](Handle h) {
                return by_channel(*h.measurement, [](const Layer& l, int c) {
                    return l.stderr_albedo.at(size(c));
                });
            },
            nb::rv_policy::automatic)
        .def_prop_ro(
            "albedo_stderr_rays",
            [](Handle h) { return by_channel(*h.measurement, albedo_error_of_rays); },
            nb::rv_policy::automatic)
        .def_prop_ro(
            "absorbed",
            [](Handle h) {
                return by_channel(*h.measurement,
                                  [](const Layer& l, int c) { return share(l.absorbed, l, c); });
            },
            nb::rv_policy::automatic)
        .def_prop_ro(
            "truncated",
            [](Handle h) {
                return by_channel(*h.measurement,
                                  [](const Layer& l, int c) { return share(l.truncated, l, c); });
            },
            nb::rv_policy::automatic)
        .def_prop_ro(
            "edge",
            [](Handle h) {
                return by_channel(*h.measurement,
                                  [](const Layer& l, int c) { return share(l.edge, l, c); });
            },
            nb::rv_policy::automatic)
        .def_prop_ro(
            "albedo_by_bounce",
            [](Handle h) {
                const Measurement& r = *h.measurement;
                return by_bounce(r,
                                 [&](const Layer& l, int c, int k) { return r.albedo(l, k, c); });
            },
            nb::rv_policy::automatic)
        .def_prop_ro(
            "albedo_by_bounce_stderr",
            [](Handle h) {
                const Measurement& r = *h.measurement;
                return by_bounce(r, [&](const Layer& l, int c, int k) {
                    return l.stderr_albedo_by_bounce.at(size(c * r.bounces() + k));
                });
            },
            nb::rv_policy::automatic)
        .def_prop_ro(
            "brdf",
            [](Handle h) {
                const Measurement& r = *h.measurement;
                return by_cell(r,
                               [&](const Layer& l, int c, int cell) { return r.brdf(l, c, cell); });
            },
            nb::rv_policy::automatic)
        .def_prop_ro(
            "stderr",
            [](Handle h) {
                const Measurement& r = *h.measurement;
                return by_cell(
                    r, [&](const Layer& l, int c, int cell) { return r.brdf_stderr(l, c, cell); });
            },
            nb::rv_policy::automatic)
        .def_prop_ro(
            "stderr_rays",
            [](Handle h) {
                const Measurement& r = *h.measurement;
                return by_cell(r, [&](const Layer& l, int c, int cell) {
                    return energy_error_of_rays(l, size(c * r.detector.cells() + cell)) /
                           r.detector.projected_solid_angle(cell / r.detector.columns());
                });
            },
            nb::rv_policy::automatic)
        .def_prop_ro(
            "brdf_by_order", [](Handle h) { return brdf_by_order(*h.measurement); },
            nb::rv_policy::automatic)
        .def("energy", energy_view, nb::arg("layer"))
        .def_prop_ro(
            "theta_edges",
            [](Handle h) {
                const Detector& d = h.measurement->detector;
                return edges(d.rows() + 1, [&](int k) { return d.theta_edge(k); });
            },
            nb::rv_policy::automatic)
        .def_prop_ro(
            "phi_edges",
            [](Handle h) {
                const Detector& d = h.measurement->detector;
                return edges(d.columns() + 1, [&](int k) { return d.phi_edge(k); });
            },
            nb::rv_policy::automatic)
        .def_prop_ro(
            "projected_solid_angle",
            [](Handle h) {
                const Detector& d = h.measurement->detector;
                return edges(d.rows(), [&](int k) { return d.projected_solid_angle(k); });
            },
            nb::rv_policy::automatic)
        .def_prop_ro(
            "solid_angle",
            [](Handle h) {
                const Detector& d = h.measurement->detector;
                return edges(d.rows(), [&](int k) { return d.solid_angle(k); });
            },
            nb::rv_policy::automatic);
}

}  // namespace asperity::python
