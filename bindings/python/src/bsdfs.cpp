// SPDX-License-Identifier: Apache-2.0
#include "arrays.h"
#include "core.h"
#include "own_bsdf.h"

#include <asperity/bsdf/spec.h>
#include <asperity/core/error.h>
#include <asperity/core/parallel.h>
#include <asperity/core/run.h>
#include <asperity/formats/bsdfs/bsdf_format.h>
#include <asperity/measured/tabulated.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace asperity::python {
namespace {

/// Refuses a row that is no unit vector; `where` is the name of the argument.
void check_units(const Directions& rows, const char* where) {
    constexpr double kSlack = 1e-5;  // of a length in single precision, with room
    for (std::size_t k = 0; k < rows.shape(0); ++k) {
        const Vec3 w = direction(rows.data(), rows.shape(0), k);
        if (std::abs(dot(w, w) - 1) <= kSlack) continue;
        throw Error(ErrorCode::Usage,
                    "row " + std::to_string(k) + " is no unit vector, its length is " +
                        std::to_string(length(w)),
                    where);
    }
}

std::size_t rows_of(const Directions& wi, const Directions& wo) {
    const std::size_t a = wi.shape(0), b = wo.shape(0);
    if (a != b && a != 1 && b != 1)
        throw Error(ErrorCode::Usage, "wi and wo have different numbers of directions", "wo");
    return std::min(a, b) == 0 ? 0 : std::max(a, b);
}

/// body(begin, end) over all rows, on threads where it is worth it.
void in_parts(std::size_t count, int threads,
              const std::function<void(std::size_t, std::size_t)>& body) {
    constexpr std::size_t kPart = 4096;
    const std::size_t parts = (count + kPart - 1) / kPart;
    if (parts <= 1) return body(0, count);
    parallel_for(parts, Run(threads).threads(), [&](std::size_t part) {
        body(part * kPart, std::min(count, (part + 1) * kPart));
    });
}

nb::ndarray<nb::numpy, double> eval(const BsdfHandle& h, const Directions& wi, const Directions& wo,
                                    int threads) {
    const std::size_t count = rows_of(wi, wo);
    const std::size_t channels = static_cast<std::size_t>(h.bsdf->channels());
    Buffer<double> f(count * channels);
    {
        const nb::gil_scoped_release free;
        check_units(wi, "wi");
        check_units(wo, "wo");
        in_parts(count, threads, [&](std::size_t begin, std::size_t end) {
            for (std::size_t k = begin; k < end; ++k)
                h.bsdf->eval(direction(wi.data(), wi.shape(0), k),
                             direction(wo.data(), wo.shape(0), k),
                             f.span().subspan(k * channels, channels));
        });
    }
    return std::move(f).to_array({count, channels});
}

nb::ndarray<nb::numpy, double> pdf(const BsdfHandle& h, const Directions& wi, const Directions& wo,
                                   int threads) {
    const std::size_t count = rows_of(wi, wo);
    Buffer<double> density(count);
    {
        const nb::gil_scoped_release free;
        check_units(wi, "wi");
        check_units(wo, "wo");
        in_parts(count, threads, [&](std::size_t begin, std::size_t end) {
            for (std::size_t k = begin; k < end; ++k)
                density.values[k] = h.bsdf->pdf(direction(wi.data(), wi.shape(0), k),
                                                direction(wo.data(), wo.shape(0), k));
        });
    }
    return std::move(density).to_array({count});
}

using Uniforms = nb::ndarray<const double, nb::shape<-1, 2>, nb::c_contig, nb::device::cpu>;

nb::tuple sample(const BsdfHandle& h, const Directions& wi, const Uniforms& u, int threads) {
    const std::size_t a = wi.shape(0), b = u.shape(0);
    if (a != b && a != 1 && b != 1)
        throw Error(ErrorCode::Usage, "there are different numbers of directions and of pairs",
                    "u");
    const std::size_t count = std::min(a, b) == 0 ? 0 : std::max(a, b);
    for (std::size_t k = 0; k < 2 * b; ++k)
        if (!(u.data()[k] >= 0 && u.data()[k] < 1))
            throw Error(ErrorCode::Usage, std::to_string(u.data()[k]) + " is outside [0, 1)", "u");
    std::vector<double> wo(3 * count, 0.0), density(count, 0.0);
    {
        const nb::gil_scoped_release free;
        check_units(wi, "wi");
        in_parts(count, threads, [&](std::size_t begin, std::size_t end) {
            for (std::size_t k = begin; k < end; ++k) {
                const double* pair = u.data() + 2 * (b == 1 ? 0 : k);
                const auto drawn = h.bsdf->sample(direction(wi.data(), a, k), pair[0], pair[1]);
                if (!drawn) continue;
                wo[3 * k] = drawn->wo.x;
                wo[3 * k + 1] = drawn->wo.y;
                wo[3 * k + 2] = drawn->wo.z;
                density[k] = drawn->pdf;
            }
        });
    }
    return nb::make_tuple(to_array(std::move(wo), {count, 3}),
                          to_array(std::move(density), {count}));
}

nb::ndarray<nb::numpy, double> albedo(const BsdfHandle& h, const Directions& wi, int threads) {
    const std::size_t count = wi.shape(0);
    const std::size_t channels = static_cast<std::size_t>(h.bsdf->channels());
    std::vector<double> a(count * channels);
    {
        const nb::gil_scoped_release free;
        check_units(wi, "wi");
        parallel_for(count, Run(threads).threads(), [&](std::size_t k) {
            h.bsdf->albedo(direction(wi.data(), count, k),
                           std::span(a).subspan(k * channels, channels));
        });
    }
    return to_array(std::move(a), {count, channels});
}

}  // namespace

void add_bsdfs(nb::module_& module) {
    nb::class_<BsdfHandle>(module, "Bsdf")
        .def_static("of_spec",
                    [](const std::string& spec) {
                        return BsdfHandle{parse_brdf_spec(spec), true};
                    })
        .def_static("is_spec", [](const std::string& text) { return is_brdf_spec(text); })
        .def_static("can_read",
                    [](const std::string& path) { return io::BsdfFormats().can_read(path); })
        .def_static("of_file",
                    [](const std::string& path) {
                        const nb::gil_scoped_release free;
                        return BsdfHandle{io::BsdfFormats().read(path)};
                    })
        .def_static("of_measurement",
                    [](const MeasurementHandle& m) {
                        const nb::gil_scoped_release free;
                        return BsdfHandle{make_tabulated_brdf(*m.measurement)};
                    })
        .def_prop_ro("channels", [](const BsdfHandle& h) { return h.bsdf->channels(); })
        .def_prop_ro("channel_names", [](const BsdfHandle& h) { return h.bsdf->channel_names(); })
        .def_prop_ro("name", [](const BsdfHandle& h) { return h.bsdf->name(); })
        .def_prop_ro("isotropic", [](const BsdfHandle& h) { return h.bsdf->isotropic(); })
        .def("eval", eval, nb::arg("wi"), nb::arg("wo"), nb::arg("threads"))
        .def("pdf", pdf, nb::arg("wi"), nb::arg("wo"), nb::arg("threads"))
        .def("sample", sample, nb::arg("wi"), nb::arg("u"), nb::arg("threads"))
        .def("albedo", albedo, nb::arg("wi"), nb::arg("threads"));
    nb::class_<OwnBsdf>(module, "OwnBsdf")
        .def(nb::init<nb::object, std::string, int, bool>(), nb::arg("eval"), nb::arg("name"),
             nb::arg("channels"), nb::arg("isotropic"));
}

}  // namespace asperity::python
