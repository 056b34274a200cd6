// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/bsdf/bsdf.h>
#include <asperity/detector/detector.h>
#include <asperity/gonio/measurement.h>
#include <asperity/pictures/layer_view.h>
#include <asperity/render/traced_model.h>

#include <array>
#include <optional>
#include <span>
#include <vector>

namespace asperity::studio {

/// The goniometric solid of a layer, or of a model in its light, in the world of the surface scene:
/// over the middle of the tile it reaches as far into each direction as f stands high on the scale
/// of the dome's colours, and kLobeRadius where f is largest. It has their colours, grey where the
/// standard error is large beside f. Where the detector is finer than it, means over neighbouring
/// cells.
class Lobe {
  public:
    using Pixel = std::array<float, 3>;  ///< as on the screen, 0 .. 255

    static constexpr double kLobeRadius = 2.7;

    Lobe(const Measurement& measurement, const Layer& layer, const io::SkyMapSettings& settings);
    /// That of a model in the light of the layer, on the scale of the layer's own lobe: beyond the
    /// end of the colour bar, or the dome, it is cut off. A shell of one colour to be seen through.
    /// A model without the channels of the measurement is shown as the mean of its own.
    Lobe(const Bsdf& model, const Measurement& measurement, const Layer& layer,
         const io::SkyMapSettings& settings, Pixel tint);

    /// Where rays of the world meet it; hits.size() == rays.size().
    void look(std::span<const WorldRay> rays, std::span<Hit> hits) const;
    /// Of what such a ray sees.
    Pixel colour(const WorldRay& ray, const Hit& hit) const;
    /// How much it hides of what lies behind, 0 .. 1.
    double opacity(const WorldRay& ray, const Hit& hit) const;
    /// No part of it lies farther from the origin.
    double radius() const { return radius_; }
    /// The direction on the surface, z >= 0, that a place on it stands for.
    static Vec3 direction(const WorldRay& ray, const Hit& hit);

    /// How far it reaches along a direction on the surface, 0 .. kLobeRadius.
    double reach(Vec3 direction) const;

  private:
    struct Grid;
    struct Maker;
    explicit Lobe(const Grid& grid);

    Detector detector_;         ///< of its corners, one in the middle of each cell
    std::vector<float> reach_;  ///< of each corner
    std::vector<float> doubt_;  ///< 0: sure, 1: the error is as large as the value
    double top_ = 1;            ///< where on the colour bar it reaches kLobeRadius
    double radius_ = kLobeRadius;
    io::ColourMap map_ = io::ColourMap::Viridis;
    std::optional<Pixel> tint_;          ///< of a shell
    std::optional<TracedModel> traced_;  ///< none of a lobe of nothing
};

}  // namespace asperity::studio
