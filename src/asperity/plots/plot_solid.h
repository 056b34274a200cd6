// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/plots/plot_curves.h>
#include <asperity/plots/plot_hemisphere.h>
#include <asperity/plots/solid_raster.h>

namespace asperity::plots {

/// Lobes as surfaces over the hemisphere of outgoing directions: the goniometric solid. In each
/// direction the surface is as far from the middle as f is large; 1, the rim of the ground, is the
/// upper end of the scale. A solid alone has the colours of its values, paler where the standard
/// error is large; several have inks and lines every 15 degrees. Nearer surfaces hide others; of
/// other solids they let something through.
class SolidPlot final : public Plot {
  public:
    struct Data {
        std::string title, note;
        std::vector<HemisphereValues> lobes;  ///< one or more
        std::vector<PlotInk> inks;            ///< of the lobes
        io::ColourMap colour_map = io::ColourMap::Viridis;
        io::ValueScale scale;
        double azimuth = 1.1, elevation = 0.42;  ///< the solid is seen from [rad]
    };
    explicit SolidPlot(Data data);

    void paint(Canvas& canvas, const Box& area, const PlotStyle& style) const override;
    /// Nothing yet: a place on the picture belongs to many directions.
    std::optional<PlotReading> reading(Place, const Box&, const PlotStyle&) const override {
        return std::nullopt;
    }
    PlotTable table() const override;
    double height_for(double width, const PlotStyle& style) const override;

    /// The camera as paint() has it in `area`.
    SolidCamera camera(const Box& area, const PlotStyle& style) const;
    const Data& data() const { return data_; }

  private:
    struct Scene;
    Heading heading() const;
    Box room(const Box& area, const PlotStyle& style) const;
    Box bar(const Box& area, const PlotStyle& style) const;
    SolidMesh mesh_of(std::size_t k, const PlotStyle& style) const;
    void paint_ground(const Scene& scene) const;
    void paint_rings(const Scene& scene) const;
    void paint_arcs(const Scene& scene) const;
    void paint_light(const Scene& scene, const HemisphereValues& of) const;
    void paint_mesh(const Scene& scene, std::size_t k) const;

    Data data_;
};

}  // namespace asperity::plots
