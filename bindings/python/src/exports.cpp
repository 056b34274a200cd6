// SPDX-License-Identifier: Apache-2.0
#include "core.h"
#include "task.h"

#include <asperity/core/error.h>
#include <asperity/core/run.h>
#include <asperity/formats/bsdfs/bsdf_format.h>
#include <asperity/formats/bsdfs/fidelity.h>
#include <asperity/gonio/experiment_text.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <optional>

namespace asperity::python {
namespace {

nb::dict to_dict(const io::Fidelity& f) {
    nb::dict d;
    std::vector<double> theta, phi, l1;
    for (const auto& layer : f.layers) {
        theta.push_back(layer.theta_i);
        phi.push_back(layer.phi_i);
        l1.push_back(layer.l1);
    }
    d["theta"] = theta;
    d["phi"] = phi;
    d["l1"] = l1;
    d["mean_l1"] = f.mean_l1;
    d["worst_l1"] = f.worst_l1;
    d["worst_theta"] = f.worst_theta_i;
    d["mean_noise"] = f.mean_noise;
    d["mean_l1_isotropic"] =
        f.mean_isotropy < 0 ? nb::object(nb::none()) : nb::object(nb::float_(f.mean_isotropy));
    d["max_albedo_difference"] = f.max_albedo_difference;
    d["text"] = io::to_text(f);
    return d;
}

struct Written {
    std::vector<std::string> remarks;
    std::optional<io::Fidelity> fidelity;
    std::string format;
};

/// Writes the file and reads it back where its format can be read.
nb::dict write(io::ExportSource source, const std::string& path, const std::string& name,
               const std::string& options, const Callbacks& callbacks) {
    const io::BsdfFormats formats;
    Run run(source.threads());
    source.watch(run);
    const auto outcome = run_task(run, callbacks, [&] {
        const io::BsdfFormat& format = formats.for_writing(path, name);
        const io::FormatOptions chosen(format.options, options);
        if (!format.write) throw Error(ErrorCode::Usage, "can be read only", format.name);
        Written written{source.remarks(), {}, format.name};
        for (std::string& remark : format.write(source, chosen, path))
            written.remarks.push_back(std::move(remark));
        if (format.read) written.fidelity = io::fidelity_of(source, format, path);
        return written;
    });
    if (outcome.interrupted) {
        PyErr_SetNone(PyExc_KeyboardInterrupt);
        throw nb::python_error();
    }
    nb::dict d;
    d["format"] = outcome.value.format;
    d["remarks"] = outcome.value.remarks;
    d["fidelity"] = nb::none();
    if (outcome.value.fidelity) d["fidelity"] = to_dict(*outcome.value.fidelity);
    return d;
}

}  // namespace

void add_exports(nb::module_& module) {
    module.def(
        "export_bsdf", [](const MeasurementHandle& m, const SettingTexts&, const std::string& path,
                          const std::string& format, const std::string& options, int threads,
                          const Callbacks& callbacks) {
            return write({m.measurement, Run(threads).threads()}, path, format, options, callbacks);
        });
    module.def("export_bsdf",
               [](const BsdfHandle& b, const SettingTexts& cells, const std::string& path,
                  const std::string& format, const std::string& options, int threads,
                  const Callbacks& callbacks) {
                   Experiment experiment;
                   experiment.detector.resolution = 64;  // of the fidelity
                   for (const auto& [key, value] : cells) apply_setting(experiment, key, value);
                   return write({b.bsdf, experiment, Run(threads).threads()}, path, format, options,
                                callbacks);
               });
}

}  // namespace asperity::python
