// SPDX-License-Identifier: Apache-2.0
// Tables and registries, from which the package makes its keywords and functions.
#include "core.h"

#include <asperity/bsdf/bsdf_models.h>
#include <asperity/formats/bsdfs/bsdf_format.h>
#include <asperity/formats/heights/heights_format.h>
#include <asperity/gonio/experiment_params.h>
#include <asperity/gonio/experiment_text.h>
#include <asperity/optics/materials.h>
#include <asperity/render/builtin_models.h>
#include <asperity/surface/surface_kinds.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

namespace asperity::python {
namespace {

const char* type_name(ParamType type) {
    switch (type) {
        case ParamType::Flag:
            return "flag";
        case ParamType::Integer:
            return "integer";
        case ParamType::Natural:
            return "natural";
        case ParamType::Real:
            return "real";
        case ParamType::Choice:
            return "choice";
        case ParamType::Text:
            return "text";
        case ParamType::List:
            return "list";
        case ParamType::Pair:
            return "pair";
    }
    return "text";
}

}  // namespace

nb::dict setting_row(const ParamInfo& info, const std::string& otherwise) {
    nb::dict d;
    d["name"] = info.name;
    d["label"] = label(info);
    d["group"] = info.group;
    d["type"] = type_name(info.type);
    d["unit"] = info.unit;
    d["choices"] = info.choices;
    d["absent"] = info.absent;
    d["doc"] = info.doc;
    d["help"] = help_text(info);
    d["default"] = otherwise;
    d["otherwise"] = info.otherwise;
    return d;
}

namespace {

nb::list settings() {
    nb::list rows;
    for (const Param<Experiment>& param : experiment_params())
        rows.append(setting_row(param.info, param.default_text()));
    return rows;
}

nb::list kinds() {
    nb::list rows;
    std::vector<SurfaceKind> all = surface_kinds();
    for (const SurfaceKind& kind : all) {
        nb::list params;
        for (const Param<Experiment>& param : experiment_params())
            if (param.info.group == "Surface" && param.info.name != "surface" &&
                surface_uses(kind.name, param.info.name))
                params.append(param.info.name);
        nb::dict d;
        d["name"] = kind.name;
        d["label"] = kind.label;
        d["doc"] = kind.doc;
        d["params"] = params;
        rows.append(d);
    }
    return rows;
}

nb::list file_settings() {
    nb::list names;
    for (const Param<Experiment>& param : experiment_params())
        if (param.info.group == "Surface" && param.info.name != "surface" &&
            surface_uses(kSurfaceFile, param.info.name))
            names.append(param.info.name);
    return names;
}

nb::list models() {
    nb::list rows;
    for (const BsdfModel& model : bsdf_models()) {
        nb::list params;
        for (const BsdfParam& param : model.params)
            params.append(setting_row(param.info, param.otherwise));
        nb::dict d;
        d["name"] = model.name;
        d["label"] = model.label;
        d["doc"] = model.doc;
        d["params"] = params;
        rows.append(d);
    }
    return rows;
}

template <typename Format>
nb::dict format_row(const Format& format, bool reads) {
    nb::dict d;
    d["name"] = format.name;
    d["endings"] = format.endings;
    d["doc"] = format.doc;
    d["reads"] = reads;
    d["writes"] = static_cast<bool>(format.write);
    return d;
}

nb::list formats() {
    nb::list rows;
    const io::BsdfFormats known;
    for (const io::BsdfFormat& format : known.rows()) {
        nb::dict d = format_row(format, static_cast<bool>(format.read));
        nb::list options;
        for (const io::FormatOption& option : format.options)
            options.append(nb::make_tuple(option.name, option.otherwise, option.doc));
        d["options"] = options;
        rows.append(d);
    }
    return rows;
}

nb::list heights_formats() {
    nb::list rows;
    const io::HeightsFormats known;
    for (const io::HeightsFormat& format : known.rows())
        rows.append(format_row(format, static_cast<bool>(format.open)));
    return rows;
}

nb::dict metals() {
    nb::dict all;
    for (const TabulatedMaterial& m : materials())
        all[std::string(m.symbol).c_str()] = std::string(m.name);
    return all;
}

nb::dict scenes() {
    nb::dict all;
    for (const BuiltinModel& model : builtin_models()) all[model.name.c_str()] = model.description;
    return all;
}

}  // namespace

void add_settings(nb::module_& module) {
    module.def("settings", settings, "Every setting of an experiment, a row each.");
    module.def("surface_kinds", kinds, "Kinds of surface and the settings that each uses.");
    module.def("file_settings", file_settings, "Settings that a surface from a file uses.");
    module.def("bsdf_models", models, "Analytic models and their parameters.");
    module.def("bsdf_formats", formats, "Formats of BSDFs.");
    module.def("heights_formats", heights_formats, "Formats of heights.");
    module.def("materials", metals, "Symbols of the metals known, and their names.");
    module.def("scene_models", scenes, "Models to render that need no file.");
}

}  // namespace asperity::python
