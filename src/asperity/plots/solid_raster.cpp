// SPDX-License-Identifier: Apache-2.0
#include <asperity/plots/solid_raster.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace asperity::plots {

namespace {

constexpr int kFiner = 2;  ///< places in a pixel, along x and y
constexpr float kNothing = -std::numeric_limits<float>::infinity();

double twice_area(Place a, Place b, Place c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// Light from the upper left, some from everywhere, and a soft gloss.
Colour lit(Colour colour, Vec3 normal, const SolidCamera& camera) {
    const Vec3 light =
        normalize(0.55 * camera.towards() + (-0.5) * camera.right() + 0.75 * camera.up());
    const Vec3 half = normalize(light + camera.towards());
    const double diffuse = 0.58 + 0.46 * std::max(0.0, dot(normal, light));
    const double gloss = 0.16 * std::pow(std::max(0.0, dot(normal, half)), 24);
    const auto part = [&](double c) { return std::min(1.0, c * diffuse + gloss); };
    return {part(colour.r), part(colour.g), part(colour.b)};
}

}  // namespace

SolidCamera::SolidCamera(double azimuth, double elevation, const Box& box)
    : right_{-std::sin(azimuth), std::cos(azimuth), 0},
      up_{-std::cos(azimuth) * std::sin(elevation), -std::sin(azimuth) * std::sin(elevation),
          std::cos(elevation)},
      towards_{std::cos(azimuth) * std::cos(elevation), std::sin(azimuth) * std::cos(elevation),
               std::sin(elevation)} {
    const Place size = extent(elevation);
    scale_ = std::max(1e-3, std::min(box.width / size.x, box.height / size.y));
    // The ground reaches sin(elevation) below the origin, the dome 1 above
    centre_ = {box.centre().x, box.centre().y + scale_ * (size.y / 2 - std::sin(elevation))};
}

Place SolidCamera::extent(double elevation) {
    return {2, 1 + std::sin(elevation)};
}

Place SolidCamera::place(Vec3 p) const {
    return centre_ + scale_ * Place{dot(p, right_), -dot(p, up_)};
}

SolidRaster::SolidRaster(const Box& box, double pixels)
    : box_(box),
      pixels_(kFiner * pixels),
      width_(std::max(1, static_cast<int>(std::ceil(box.width * pixels))) * kFiner),
      height_(std::max(1, static_cast<int>(std::ceil(box.height * pixels))) * kFiner) {}

void SolidRaster::add(const SolidMesh& mesh, const SolidCamera& camera, double opacity) {
    Layer layer;
    layer.opacity = opacity;
    const std::size_t size = static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_);
    layer.nearness.assign(size, kNothing);
    layer.colour.resize(size);
    for (std::size_t t = 0; t + 2 < mesh.triangles.size(); t += 3) {
        std::array<Place, 3> corners;
        std::array<double, 3> nearness{};
        std::array<Colour, 3> colours;
        for (std::size_t k = 0; k < 3; ++k) {
            const SolidVertex& vertex =
                mesh.vertices[static_cast<std::size_t>(mesh.triangles[t + k])];
            const Place place = camera.place(vertex.place);
            corners[k] = {(place.x - box_.left) * pixels_, (place.y - box_.top) * pixels_};
            nearness[k] = camera.nearness(vertex.place);
            colours[k] = lit(vertex.colour, vertex.normal, camera);
        }
        fill(layer, corners, nearness, colours);
    }
    layers_.push_back(std::move(layer));
}

void SolidRaster::fill(Layer& layer, const std::array<Place, 3>& corners,
                       const std::array<double, 3>& nearness,
                       const std::array<Colour, 3>& colours) const {
    const auto [a, b, c] = corners;
    const double area = twice_area(a, b, c);
    if (std::abs(area) < 1e-12) return;
    const int left = std::max(0, static_cast<int>(std::floor(std::min({a.x, b.x, c.x}))));
    const int right = std::min(width_ - 1, static_cast<int>(std::ceil(std::max({a.x, b.x, c.x}))));
    const int top = std::max(0, static_cast<int>(std::floor(std::min({a.y, b.y, c.y}))));
    const int low = std::min(height_ - 1, static_cast<int>(std::ceil(std::max({a.y, b.y, c.y}))));
    for (int y = top; y <= low; ++y)
        for (int x = left; x <= right; ++x) {
            const Place p{x + 0.5, y + 0.5};
            const double u = twice_area(p, b, c) / area, v = twice_area(a, p, c) / area;
            const double w = 1 - u - v;
            // Edges count for both triangles: no gaps, and the same depth on either side
            if (u < -1e-9 || v < -1e-9 || w < -1e-9) continue;
            const float near =
                static_cast<float>(u * nearness[0] + v * nearness[1] + w * nearness[2]);
            const std::size_t at = pixel(x, y);
            if (near <= layer.nearness[at]) continue;
            layer.nearness[at] = near;
            layer.colour[at] = {u * colours[0].r + v * colours[1].r + w * colours[2].r,
                                u * colours[0].g + v * colours[1].g + w * colours[2].g,
                                u * colours[0].b + v * colours[1].b + w * colours[2].b};
        }
}

Raster SolidRaster::picture() const {
    Raster raster(width_ / kFiner, height_ / kFiner);
    std::vector<const Layer*> order;
    const auto blended = [&](std::size_t at) {
        order.clear();
        for (const Layer& layer : layers_)
            if (layer.nearness[at] > kNothing) order.push_back(&layer);
        std::sort(order.begin(), order.end(), [at](const Layer* a, const Layer* b) {
            return a->nearness[at] < b->nearness[at];
        });
        // The farthest is opaque, the nearer ones lie over it
        Colour sum{0, 0, 0, 0};
        for (const Layer* layer : order) {
            const double share = layer == order.front() ? 1 : layer->opacity;
            sum = mix(sum, layer->colour[at], share);
        }
        return sum;
    };
    for (int y = 0; y < raster.height; ++y)
        for (int x = 0; x < raster.width; ++x) {
            Colour sum{0, 0, 0, 0};
            for (int k = 0; k < kFiner * kFiner; ++k) {
                const Colour c = blended(pixel(kFiner * x + k % kFiner, kFiner * y + k / kFiner));
                sum = {sum.r + c.a * c.r, sum.g + c.a * c.g, sum.b + c.a * c.b, sum.a + c.a};
            }
            if (sum.a > 0)
                raster.at(x, y) = packed(
                    {sum.r / sum.a, sum.g / sum.a, sum.b / sum.a, sum.a / (kFiner * kFiner)});
        }
    return raster;
}

SolidRaster::Before SolidRaster::before(Place place, double nearness, int own) const {
    const int x = static_cast<int>(std::floor((place.x - box_.left) * pixels_));
    const int y = static_cast<int>(std::floor((place.y - box_.top) * pixels_));
    if (x < 0 || y < 0 || x >= width_ || y >= height_) return Before::Nothing;
    constexpr double kTouching = 8e-3;  ///< lines on a surface are seen
    Before before = Before::Nothing;
    for (std::size_t k = 0; k < layers_.size(); ++k) {
        if (!(static_cast<double>(layers_[k].nearness[pixel(x, y)]) > nearness + kTouching))
            continue;
        if (static_cast<int>(k) == own) return Before::Own;
        before = Before::Others;
    }
    return before;
}

}  // namespace asperity::plots
