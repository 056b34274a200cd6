// SPDX-License-Identifier: Apache-2.0
// The kinds of plots that files are made of. A new one is a file and a row.
#pragma once

#include <asperity/bsdf/bsdf.h>
#include <asperity/core/run.h>
#include <asperity/gonio/measurement.h>
#include <asperity/plots/plot.h>
#include <asperity/plots/plot_settings.h>
#include <asperity/surface/heightfield.h>

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace asperity::plots {

/// What is plotted: exactly one of the three is set.
struct PlotSubject {
    std::string name;  ///< in legends and the headers of tables
    std::shared_ptr<const Measurement> measurement = {};
    std::shared_ptr<const Bsdf> model = {};
    std::shared_ptr<const Heightfield> surface = {};
};

struct PlotKind {
    std::string name;
    std::string doc;           ///< what it shows, without a capital and without its full stop
    bool of_surfaces = false;  ///< subjects are surfaces; else results and models
    bool usually_log = false;  ///< of values, where the settings leave the scale open
    std::vector<std::string> settings = {};  ///< those that count, beside kind, scale and title
    std::function<std::shared_ptr<const Plot>(const std::vector<PlotSubject>&, const PlotSettings&,
                                              Run&)>
        make = {};
};

const std::vector<PlotKind>& plot_kinds();
const PlotKind* find_plot_kind(std::string_view name);  ///< null: there is none
bool uses(const PlotKind& kind, std::string_view setting);

/// The plot of the settings' kind. Throws what check() throws; Error(Usage) for no subject, a
/// surface where a result is needed or the other way round, a layer or channel that is not there;
/// Error(Stopped).
std::shared_ptr<const Plot> make_plot(const std::vector<PlotSubject>& subjects,
                                      const PlotSettings& settings, Run& run);

}  // namespace asperity::plots
