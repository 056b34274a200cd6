// SPDX-License-Identifier: Apache-2.0
#include <asperity/plots/figures.h>

#include <asperity/core/directions.h>
#include <asperity/plots/plot_solid.h>

namespace asperity::plots::detail {

PlotPointer solid_figure(const Subjects& subjects, const PlotSettings& settings, Run& run) {
    Hemispheres hemispheres = hemispheres_of(subjects, settings, run);
    SolidPlot::Data data;
    data.title = title_of(hemispheres.lit, settings);
    data.note = hemispheres.note;
    data.scale = scale_of(hemispheres.values, is_log(settings), settings.decades);
    data.lobes = std::move(hemispheres.values);
    data.colour_map = settings.colour_map;
    data.azimuth = radians(settings.camera_azimuth);
    data.elevation = radians(settings.camera_elevation);
    return std::make_shared<SolidPlot>(std::move(data));
}

}  // namespace asperity::plots::detail
