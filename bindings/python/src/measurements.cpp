// SPDX-License-Identifier: Apache-2.0
#include "arrays.h"
#include "core.h"
#include "task.h"

#include <asperity/bsdf/bsdf.h>
#include <asperity/core/error.h>
#include <asperity/formats/results/result_file.h>
#include <asperity/gonio/experiment_params.h>
#include <asperity/gonio/experiment_text.h>
#include <asperity/gonio/measure.h>
#include <asperity/gonio/merge.h>
#include <asperity/optics/fresnel.h>
#include <asperity/pictures/pictures.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include <algorithm>
#include <optional>
#include <utility>

namespace asperity::python {

namespace {

bool has(const SettingTexts& texts, const char* key) {
    return std::any_of(texts.begin(), texts.end(),
                       [&](const auto& text) { return text.first == key; });
}

/// The experiment that settings describe, as the command line reads them: one that does not count
/// is refused; who names an index or a metal means the law that has one.
Experiment experiment_of(const SurfaceSettings& surface, const SettingTexts& texts) {
    Experiment experiment;
    experiment.surface = surface;
    apply_settings(experiment, texts);
    if (!has(texts, "fresnel")) experiment.optics.fresnel = implied_fresnel(experiment.optics);
    return experiment;
}

/// `so_far`, `part` of `parts` and `leave_out` as MeasureScope has them. A share, which may be
/// nothing, may also be stopped before it has anything.
nb::tuple run_measurement(const SurfaceHandle& surface, const SettingTexts& texts, int threads,
                          const Callbacks& callbacks,
                          const std::optional<MeasurementHandle>& so_far, int part, int parts,
                          bool leave_out) {
    const Experiment experiment = experiment_of(surface.settings, texts);
    validate(experiment);
    Run run(threads);
    auto outcome = run_task(run, callbacks, [&] {
        MeasureScope scope;
        if (so_far) scope.so_far = *so_far->measurement;
        scope.part = part;
        scope.parts = parts;
        scope.leave_out_so_far = leave_out;
        return std::make_shared<const Measurement>(
            measure(*surface.heights, experiment, run, {}, std::move(scope)));
    });
    if (outcome.value->stopped && outcome.value->layers.empty() && !leave_out) {
        if (!outcome.interrupted)
            throw Error(ErrorCode::Stopped, "stopped before anything was complete");
        PyErr_SetNone(PyExc_KeyboardInterrupt);
        throw nb::python_error();
    }
    return nb::make_tuple(MeasurementHandle{std::move(outcome.value)}, outcome.interrupted);
}

MeasurementHandle merged(const std::vector<MeasurementHandle>& parts) {
    const nb::gil_scoped_release free;
    Merge merge;
    for (std::size_t k = 0; k < parts.size(); ++k)
        merge.add(*parts[k].measurement, "part " + std::to_string(k));
    return {std::make_shared<const Measurement>(merge.finish())};
}

/// What the parts of a round go on from, which may have been asked for less.
void add_so_far(Merge& merge, const MeasurementHandle& so_far, const SurfaceHandle& surface,
                const SettingTexts& texts) {
    const RunSettings run = experiment_of(surface.settings, texts).run;
    Measurement before = *so_far.measurement;
    before.experiment.run.until = run.until;
    before.experiment.run.until_cells = run.until_cells;
    before.experiment.run.max_rays = run.max_rays;
    merge.add(std::move(before), "so_far");
}

/// The sum of all parts of a round; and whether it is all that the experiment asks for.
nb::tuple finished(Merge& merge) {
    bool all = false;
    std::shared_ptr<const Measurement> sum;
    {
        const nb::gil_scoped_release free;
        Measurement whole = merge.finish();
        all = complete(whole);
        sum = std::make_shared<const Measurement>(std::move(whole));
    }
    return nb::make_tuple(MeasurementHandle{std::move(sum)}, all);
}

/// The settings of the measurement, checked; the surface is there.
void check_settings(const SurfaceHandle& surface, const SettingTexts& texts) {
    const Experiment experiment = experiment_of(surface.settings, texts);
    validate(experiment);
    const Fresnel checked(experiment.optics);
}

nb::dict experiment_dict(const Experiment& experiment) {
    nb::dict d;
    for (const Setting& setting : settings_of(experiment)) d[setting.key.c_str()] = setting.value;
    return d;
}

/// The experiment that settings describe, checked, as text: equal experiments, equal texts. The
/// surface is not made: where nobody says the number of rays, the text says so.
std::string experiment_text(const SettingTexts& surface, const SettingTexts& texts) {
    const Experiment experiment = experiment_of(surface_settings(surface), texts);
    validate(experiment);
    const Fresnel checked(experiment.optics);
    return to_text(experiment);
}

template <typename Enum>
Enum choice(const std::string& word, std::initializer_list<std::pair<const char*, Enum>> words,
            const char* where) {
    std::string names;
    for (const auto& [name, value] : words) {
        if (word == name) return value;
        names += (names.empty() ? "" : ", ") + std::string(name);
    }
    throw Error(ErrorCode::Usage, "'" + word + "' is none of " + names, where);
}

io::SkyMapSettings look_of(const std::string& colour_map, const std::string& scale,
                           const std::string& projection, double decades, int channel) {
    io::SkyMapSettings look;
    look.colour_map = choice<io::ColourMap>(colour_map,
                                            {{"viridis", io::ColourMap::Viridis},
                                             {"inferno", io::ColourMap::Inferno},
                                             {"grey", io::ColourMap::Grey},
                                             {"thesis-red", io::ColourMap::ThesisRed}},
                                            "colour_map");
    look.scale =
        choice<io::Scale>(scale, {{"log", io::Scale::Log}, {"linear", io::Scale::Linear}}, "scale");
    look.projection = choice<io::Projection>(
        projection, {{"sky-map", io::Projection::SkyMap}, {"disk", io::Projection::Disk}},
        "projection");
    look.decades = decades;
    look.channel = channel;
    return look;
}

}  // namespace

void add_measurements(nb::module_& module) {
    nb::class_<MeasurementHandle> m(module, "Measurement");
    m.def_static("load",
                 [](const std::string& path) {
                     const nb::gil_scoped_release free;
                     return MeasurementHandle{
                         std::make_shared<const Measurement>(io::load_measurement(path))};
                 })
        .def("save",
             [](const MeasurementHandle& h, const std::string& path) {
                 const nb::gil_scoped_release free;
                 return io::save_measurement(*h.measurement, path);
             })
        .def("checksum",
             [](const MeasurementHandle& h) {
                 const nb::gil_scoped_release free;
                 return io::checksum(*h.measurement);
             })
        .def("save_sheet",
             [](const MeasurementHandle& h, const std::string& path, const std::string& colour_map,
                const std::string& scale, const std::string& projection, double decades,
                int channel) {
                 const io::SkyMapSettings look =
                     look_of(colour_map, scale, projection, decades, channel);
                 const nb::gil_scoped_release free;
                 io::write_layer_sheet(*h.measurement, path, look);
             })
        .def_prop_ro(
            "experiment",
            [](const MeasurementHandle& h) { return experiment_dict(h.measurement->experiment); })
        .def_prop_ro("experiment_text",
                     [](const MeasurementHandle& h) { return to_text(h.measurement->experiment); })
        .def_prop_ro("isotropic",
                     [](const MeasurementHandle& h) {
                         return h.measurement->experiment.illumination.isotropic;
                     })
        .def_prop_ro(
            "surface",
            [](const MeasurementHandle& h) { return statistics_of(h.measurement->surface); })
        .def_prop_ro("surface_name",
                     [](const MeasurementHandle& h) { return h.measurement->surface_name; })
        .def_prop_ro("surface_shape",
                     [](const MeasurementHandle& h) {
                         return nb::make_tuple(h.measurement->surface_ny,
                                               h.measurement->surface_nx);
                     })
        .def_prop_ro("channel_names",
                     [](const MeasurementHandle& h) { return h.measurement->channel_names; })
        .def_prop_ro("stopped", [](const MeasurementHandle& h) { return h.measurement->stopped; })
        .def_prop_ro("notes", [](const MeasurementHandle& h) { return h.measurement->notes; })
        .def_prop_ro("version", [](const MeasurementHandle& h) { return h.measurement->version; })
        .def_prop_ro("threads", [](const MeasurementHandle& h) { return h.measurement->threads; })
        .def_prop_ro("trace_seconds",
                     [](const MeasurementHandle& h) { return h.measurement->trace_seconds; });
    add_layer_arrays(m);
    module.def("is_result", [](const std::string& path) { return io::looks_like_result(path); });
    module.def("measure", run_measurement, nb::arg("surface"), nb::arg("settings"),
               nb::arg("threads"), nb::arg("callbacks"), nb::arg("so_far").none() = nb::none(),
               nb::arg("part") = 1, nb::arg("parts") = 1, nb::arg("leave_out") = false);
    module.def("check_settings", check_settings, nb::arg("surface"), nb::arg("settings"));
    module.def("merge", merged, nb::arg("parts"));
    nb::class_<Merge>(module, "Merge", "Adds up parts that come one by one.")
        .def(nb::init<>())
        .def("add",
             [](Merge& merge, const MeasurementHandle& part, const std::string& name) {
                 const nb::gil_scoped_release free;
                 merge.add(*part.measurement, name);
             })
        .def("add_so_far", add_so_far)
        .def("finish", finished)
        .def("unfinished", [](Merge& merge) {
            const nb::gil_scoped_release free;
            return MeasurementHandle{
                std::make_shared<const Measurement>(std::move(merge).unfinished())};
        });
    module.def("experiment_text", experiment_text, nb::arg("surface"), nb::arg("settings"));
}

}  // namespace asperity::python
