// SPDX-License-Identifier: Apache-2.0
// The rows of plot_kinds() and what they share; inside this folder only.
#pragma once

#include <asperity/plots/plot_hemisphere.h>
#include <asperity/plots/plot_kinds.h>

#include <optional>

namespace asperity::plots::detail {

using Subjects = std::vector<PlotSubject>;
using PlotPointer = std::shared_ptr<const Plot>;

PlotPointer lobe_figure(const Subjects& subjects, const PlotSettings& settings, Run& run);
PlotPointer hemisphere_figure(const Subjects& subjects, const PlotSettings& settings, Run& run);
PlotPointer solid_figure(const Subjects& subjects, const PlotSettings& settings, Run& run);
PlotPointer albedo_figure(const Subjects& subjects, const PlotSettings& settings, Run& run);
PlotPointer normals_figure(const Subjects& subjects, const PlotSettings& settings, Run& run);
PlotPointer profile_figure(const Subjects& subjects, const PlotSettings& settings, Run& run);
PlotPointer psd_figure(const Subjects& subjects, const PlotSettings& settings, Run& run);

/// A subject under light from one direction.
struct LitSubject {
    const PlotSubject* subject = nullptr;
    Layer light;                   ///< its number and angles; no data
    const Layer* layer = nullptr;  ///< of a measurement
    std::string name;              ///< with the angle where subjects have several
    int index = 0;                 ///< of the subject
};

/// All subjects under all incidences that the settings choose. A model is lit as the first
/// measurement is, if there is one. Throws Error(Usage, "layer" | "theta").
std::vector<LitSubject> lit_subjects(const Subjects& subjects, const PlotSettings& settings);
/// The first measurement among the lit, with the layer; null: models only.
const LitSubject* first_measured(const std::vector<LitSubject>& lit);

/// "Layer 8, θᵢ = 45°" of one result, the angle alone of several things; the settings' own title
/// wins.
std::string title_of(const std::vector<LitSubject>& lit, const PlotSettings& settings);

/// The channel that the settings name. Throws Error(Usage, "channel").
int channel_of(const Measurement& measurement, const PlotSettings& settings);
/// A model that has no such channel is shown as the mean of its own.
int channel_of(const Bsdf& model, const Subjects& subjects, const PlotSettings& settings);

/// Whether values are shown on a log scale.
bool is_log(const PlotSettings& settings);

/// The hemispheres of all subjects; of a model over the cells of the first measurement's detector.
/// Where there is one, all are averaged over neighbouring columns, so that cells near the pole are
/// as wide as those at the horizon, and wider where the settings or the noise ask for it.
struct Hemispheres {
    std::vector<HemisphereValues> values;
    std::vector<LitSubject> lit;
    std::string note;  ///< how they were averaged
};
Hemispheres hemispheres_of(const Subjects& subjects, const PlotSettings& settings, Run& run);
/// A scale for all: ends at the first 1, 2 or 5 times a power of ten not below the largest value,
/// the brightest cells left out that carry a thousandth of a lobe's energy together.
io::ValueScale scale_of(const std::vector<HemisphereValues>& values, bool log, double decades);

}  // namespace asperity::plots::detail
