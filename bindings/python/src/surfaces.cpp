// SPDX-License-Identifier: Apache-2.0
#include "arrays.h"
#include "core.h"
#include "task.h"

#include <asperity/core/error.h>
#include <asperity/formats/heights/surface_files.h>
#include <asperity/gonio/experiment_params.h>
#include <asperity/gonio/experiment_text.h>
#include <asperity/pictures/pictures.h>
#include <asperity/surface/statistics.h>
#include <asperity/surface/surface_figures.h>
#include <asperity/surface/surface_text.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include <cmath>

namespace asperity::python {

void apply_settings(Experiment& experiment, const SettingTexts& texts) {
    const ParamTable<Experiment> table = experiment_params();
    for (const auto& [key, value] : texts) {
        if (const Param<Experiment>* param = find(table, key))
            param->apply(experiment, value);
        else
            apply_setting(experiment, key, value);  // says which was meant
    }
    for (const auto& [key, value] : texts) {
        const Param<Experiment>* param = find(table, key);
        if (!param->used(experiment)) throw Error(ErrorCode::Usage, param->unused(experiment), key);
    }
}

SurfaceSettings surface_settings(const SettingTexts& texts) {
    Experiment experiment;
    apply_settings(experiment, texts);
    return experiment.surface;
}

namespace {

SurfaceHandle handle_of(Heightfield&& surface, const SurfaceSettings& settings) {
    return {std::make_shared<const Heightfield>(std::move(surface)), settings};
}

SurfaceHandle load(const SettingTexts& texts, int threads, const Callbacks& callbacks) {
    const SurfaceSettings settings = surface_settings(texts);
    Run run(threads);
    auto outcome = run_task(run, callbacks, [&] { return io::load_surface(settings, run); });
    if (outcome.interrupted) {
        PyErr_SetNone(PyExc_KeyboardInterrupt);
        throw nb::python_error();
    }
    return handle_of(std::move(outcome.value), settings);
}

using HeightsArray = nb::ndarray<const double, nb::ndim<2>, nb::c_contig, nb::device::cpu>;

/// `where` names the array in messages. NaN stands for a missing point.
SurfaceHandle from_array(const HeightsArray& z, std::pair<double, double> spacing,
                         const std::string& unit, const std::string& name,
                         const SettingTexts& texts, bool isotropic, const std::string& found) {
    SurfaceSettings settings = surface_settings(texts);
    const std::size_t ny = z.shape(0), nx = z.shape(1);
    Topography topography = io::empty_topography(nx, ny, name);
    topography.dx = spacing.first;
    topography.dy = spacing.second;
    topography.unit = unit;
    topography.name = name;
    topography.isotropic = isotropic;
    if (!found.empty()) topography.note(found);
    topography.ours = true;  // an array is taken as it is
    topography.heights.assign(z.data(), z.data() + nx * ny);
    for (std::size_t k = 0; k < nx * ny; ++k)
        if (std::isnan(topography.heights[k])) topography.mark_missing(k);
    const nb::gil_scoped_release free;
    return handle_of(io::surface_of(std::move(topography), settings), settings);
}

/// Everything a Heightfield is, to be pickled.
using State = std::tuple<nb::bytes, int, int, double, double, int, int, bool,
                         std::vector<std::string>, SettingTexts>;

State state_of(const SurfaceHandle& s) {
    const Heightfield& h = *s.heights;
    Experiment experiment;
    experiment.surface = s.settings;
    SettingTexts texts;
    for (const Param<Experiment>& param : experiment_params())
        if (param.info.group == "Surface" && param.used(experiment))
            texts.emplace_back(param.info.name, param.text(experiment));
    return {nb::bytes(h.heights.data(), h.heights.size() * sizeof(float)),
            h.nx,
            h.ny,
            h.dx,
            h.dy,
            static_cast<int>(h.diagonal),
            static_cast<int>(h.boundary),
            h.isotropic,
            {h.unit, h.name, h.tiling, h.source, h.prepared},
            texts};
}

void set_state(SurfaceHandle& s, const State& state) {
    const auto& [bytes, nx, ny, dx, dy, diagonal, boundary, isotropic, words, texts] = state;
    Heightfield h;
    h.nx = nx;
    h.ny = ny;
    h.dx = dx;
    h.dy = dy;
    const float* heights = static_cast<const float*>(bytes.data());
    h.heights.assign(heights, heights + bytes.size() / sizeof(float));
    h.diagonal = static_cast<Diagonal>(diagonal);
    h.boundary = static_cast<Boundary>(boundary);
    h.isotropic = isotropic;
    h.unit = words.at(0);
    h.name = words.at(1);
    h.tiling = words.at(2);
    h.source = words.at(3);
    h.prepared = words.at(4);
    new (&s) SurfaceHandle(handle_of(std::move(h), surface_settings(texts)));
}

}  // namespace

nb::dict statistics_of(const SurfaceStatistics& s) {
    nb::dict d;
    for (const auto& [name, value] : surface_figures()) d[name] = s.*value;
    return d;
}

void add_surfaces(nb::module_& module) {
    nb::class_<Callbacks>(module, "Callbacks", "What a task tells and asks while it runs.")
        .def(
            "__init__",
            [](Callbacks* self, nb::object progress, nb::object stop) {
                new (self) Callbacks{std::move(progress), std::move(stop)};
            },
            nb::arg("progress").none(), nb::arg("stop").none());

    nb::class_<SurfaceHandle>(module, "Surface")
        .def_prop_ro(
            "heights",
            [](const SurfaceHandle& s) {
                const Heightfield& h = *s.heights;
                return to_view<float, Heightfield>(
                    h.heights.data(),
                    {static_cast<std::size_t>(h.ny), static_cast<std::size_t>(h.nx)}, s.heights);
            },
            nb::rv_policy::automatic)
        .def_prop_ro("dx", [](const SurfaceHandle& s) { return s.heights->dx; })
        .def_prop_ro("dy", [](const SurfaceHandle& s) { return s.heights->dy; })
        .def_prop_ro("unit", [](const SurfaceHandle& s) { return s.heights->unit; })
        .def_prop_ro("name", [](const SurfaceHandle& s) { return s.heights->name; })
        .def_prop_ro("tiling", [](const SurfaceHandle& s) { return s.heights->tiling; })
        .def_prop_ro("source", [](const SurfaceHandle& s) { return s.heights->source; })
        .def_prop_ro("isotropic", [](const SurfaceHandle& s) { return s.heights->isotropic; })
        .def_prop_ro(
            "periodic",
            [](const SurfaceHandle& s) { return s.heights->boundary == Boundary::Periodic; })
        .def_prop_ro("cells", [](const SurfaceHandle& s) { return s.heights->cell_count(); })
        .def_prop_ro("text", [](const SurfaceHandle& s) { return surface_text(s.settings); })
        .def(
            "statistics",
            [](const SurfaceHandle& s, int threads) {
                SurfaceStatistics figures;
                {
                    const nb::gil_scoped_release free;
                    figures = statistics(*s.heights, threads);
                }
                return statistics_of(figures);
            },
            nb::arg("threads") = 1)
        .def("save",
             [](const SurfaceHandle& s, const std::string& path) {
                 const nb::gil_scoped_release free;
                 io::write_heights(*s.heights, path);
             })
        .def("save_png",
             [](const SurfaceHandle& s, const std::string& path) {
                 const nb::gil_scoped_release free;
                 io::write_surface_png(*s.heights, path, io::SurfaceLook::Shaded);
             })
        .def("__getstate__", state_of)
        .def("__setstate__", set_state);

    module.def("load_surface", load, nb::arg("settings"), nb::arg("threads"), nb::arg("callbacks"));
    module.def("surface_from_array", from_array, nb::arg("z"), nb::arg("spacing"), nb::arg("unit"),
               nb::arg("name"), nb::arg("settings"), nb::arg("isotropic"), nb::arg("found") = "");
}

}  // namespace asperity::python
