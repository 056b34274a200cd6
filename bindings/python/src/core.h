// SPDX-License-Identifier: Apache-2.0
// The parts of the extension module asperity._core. What they add is the library's own functions
// with Python's types; the package around it gives them their shape.
#pragma once

#include <asperity/bsdf/bsdf.h>
#include <asperity/gonio/measurement.h>
#include <asperity/params/param.h>
#include <asperity/surface/heightfield.h>
#include <asperity/surface/surface_settings.h>
#include <nanobind/nanobind.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace asperity::python {

namespace nb = nanobind;

/// Names of settings and the texts of their values, in the order in which they count.
using SettingTexts = std::vector<std::pair<std::string, std::string>>;

/// A surface and the settings that a result records of it.
struct SurfaceHandle {
    std::shared_ptr<const Heightfield> heights;
    SurfaceSettings settings;
};
struct MeasurementHandle {
    std::shared_ptr<const Measurement> measurement;
};
struct BsdfHandle {
    std::shared_ptr<const Bsdf> bsdf;
    bool analytic = false;  ///< a closed form: quick enough to be rendered as it is
};

/// Reads settings as the command line does, and refuses one that the experiment has no use for.
void apply_settings(Experiment& experiment, const SettingTexts& texts);
SurfaceSettings surface_settings(const SettingTexts& texts);
nb::dict statistics_of(const SurfaceStatistics& statistics);

/// What Python is told of a setting.
nb::dict setting_row(const ParamInfo& info, const std::string& otherwise);

void add_settings(nb::module_& module);
void add_surfaces(nb::module_& module);
void add_measurements(nb::module_& module);
void add_layer_arrays(nb::class_<MeasurementHandle>& measurement);
void add_bsdfs(nb::module_& module);
void add_comparisons(nb::module_& module);
void add_fits(nb::module_& module);
void add_exports(nb::module_& module);
void add_renders(nb::module_& module);

}  // namespace asperity::python
