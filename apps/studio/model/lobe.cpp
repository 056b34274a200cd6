// SPDX-License-Identifier: Apache-2.0
#include "lobe.h"

#include "dome.h"
#include "surface_frame.h"

#include <asperity/core/directions.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace asperity::studio {

/// f and its error, means over neighbouring cells, at corners few enough to be made ten times a
/// second while the layer grows.
struct Lobe::Grid {
    Detector detector;
    std::vector<float> reach, doubt;
    double top = 1;
    io::ColourMap map = io::ColourMap::Viridis;
    std::optional<Pixel> tint;
    TriangleMesh mesh;
};

namespace {

constexpr int kMostColumns = 64;
constexpr double kFarthest = 0.97 * kDomeRadius;
constexpr double kClear = 0.1;  ///< share of what lies behind a solid that shines through

/// Means over the cells of a finer detector that lie in each cell of a coarser one: equal angles
/// on each, so `every` of its rows and columns.
struct Means {
    std::vector<double> value, error;
};

/// Mean over the channels, or one. Errors too: channels share their rays, so errors go together.
template <class OfChannel>
double of_channels(const Measurement& m, int channel, const OfChannel& of) {
    if (channel >= 0) return of(channel);
    double sum = 0;
    for (int c = 0; c < m.channels(); ++c) sum += of(c);
    return sum / std::max(1, m.channels());
}

/// `values` and `error(cell)` are of the fine detector's cells.
template <class Error>
Means means_of(const Detector& fine, const std::vector<double>& values, const Error& error_of,
               const Detector& coarse) {
    const auto cells = static_cast<std::size_t>(coarse.cells());
    Means means{std::vector<double>(cells), std::vector<double>(cells)};
    std::vector<double> weights(cells);
    for (int cell = 0; cell < fine.cells(); ++cell) {
        const auto at = static_cast<std::size_t>(coarse.cell_of(fine.centre(cell)));
        const double weight = fine.projected_solid_angle(cell / fine.columns());
        const double error = error_of(cell);
        means.value[at] += weight * values[static_cast<std::size_t>(cell)];
        means.error[at] += weight * weight * error * error;
        weights[at] += weight;
    }
    for (std::size_t k = 0; k < cells; ++k) {
        if (!(weights[k] > 0)) continue;
        means.value[k] /= weights[k];
        means.error[k] = std::sqrt(means.error[k]) / weights[k];
    }
    return means;
}

Means means_of(const Measurement& m, const Layer& layer, int channel, const Detector& coarse) {
    const bool known = !layer.stderr_energy.empty();
    const auto error_of = [&](int cell) {
        return known ? of_channels(m, channel, [&](int c) { return m.brdf_stderr(layer, c, cell); })
                     : 0.0;
    };
    return means_of(m.detector, io::values_of(m, layer, channel), error_of, coarse);
}

/// f of a model in the light of a layer, in the middle of each cell.
std::vector<double> values_of(const Bsdf& model, const Measurement& m, const Layer& layer,
                              int channel) {
    const Vec3 wi = from_spherical(layer.theta_i, layer.phi_i);
    std::vector<double> f(static_cast<std::size_t>(model.channels())), values;
    const bool has_channel = channel >= 0 && model.channels() == m.channels();
    for (int cell = 0; cell < m.detector.cells(); ++cell) {
        model.eval(wi, m.detector.centre(cell), f);
        double sum = 0;
        for (const double part : f) sum += part;
        values.push_back(has_channel ? f[static_cast<std::size_t>(channel)]
                                     : sum / model.channels());
    }
    return values;
}

/// As fine as the measurement's, but for kMostColumns.
Detector coarse_detector(const Detector& fine) {
    int columns = fine.columns();
    while (columns > kMostColumns && columns % 4 == 0) columns /= 2;
    return Detector({.kind = fine.kind(), .resolution = columns});
}

Vec3f single(Vec3 p) {
    return {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
}

/// A net over the hemisphere with a corner in the middle of each cell, one at the pole, one for
/// each column at the horizon, and the origin below all.
TriangleMesh net_of(const Detector& detector, const std::vector<float>& reach) {
    const int rows = detector.rows(), columns = detector.columns();
    TriangleMesh mesh;
    mesh.name = "lobe";
    const auto corner = [&](double theta, double phi, float r) {
        mesh.positions.push_back(single(
            static_cast<double>(r) * SurfaceFrame::direction_to_world(from_spherical(theta, phi))));
    };
    float pole = 0;
    for (int column = 0; column < columns; ++column)
        pole += reach[static_cast<std::size_t>(column)] / static_cast<float>(columns);
    corner(0, 0, pole);
    for (int row = 0; row <= rows; ++row)
        for (int column = 0; column < columns; ++column)
            corner(row < rows ? detector.theta_centre(row) : 0.5 * kPi, detector.phi_centre(column),
                   reach[static_cast<std::size_t>(std::min(row, rows - 1) * columns + column)]);
    corner(0, 0, 0);

    const auto index = [columns](int row, int column) {
        return static_cast<std::uint32_t>(1 + row * columns + column % columns);
    };
    const auto foot = static_cast<std::uint32_t>(mesh.positions.size() - 1);
    for (int column = 0; column < columns; ++column) {
        mesh.triangles.push_back({0, index(0, column), index(0, column + 1)});
        for (int row = 0; row < rows; ++row) {
            mesh.triangles.push_back(
                {index(row, column), index(row + 1, column), index(row + 1, column + 1)});
            mesh.triangles.push_back(
                {index(row, column), index(row + 1, column + 1), index(row, column + 1)});
        }
        mesh.triangles.push_back({index(rows, column), foot, index(rows, column + 1)});
    }
    drop_undrawable(mesh);
    set_normals(mesh, NormalStyle::Smooth);
    return mesh;
}

Model model_of(TriangleMesh mesh) {
    Model model;
    model.name = mesh.name;
    model.meshes.push_back(std::move(mesh));
    model.instances.push_back({});
    return model;
}

std::optional<TracedModel> traced(const TriangleMesh& mesh) {
    if (mesh.triangles.empty()) return std::nullopt;
    Run run;
    return TracedModel(model_of(mesh), run);
}

Lobe::Pixel pixel_of(const io::Colour& c, double light, double gloss) {
    const auto level = [&](double part) {
        return static_cast<float>(255 * std::clamp(part * light + gloss, 0.0, 1.0));
    };
    return {level(c.r), level(c.g), level(c.b)};
}

}  // namespace

struct Lobe::Maker {
    /// Where on the colour bar the layer's own lobe reaches kLobeRadius.
    static double top_of(const Means& means, const io::ValueScale& scale) {
        const double most = *std::max_element(means.value.begin(), means.value.end());
        return most > 0 ? std::max(0.05, scale.position(most)) : 1;
    }

    static void fill(Grid& grid, const Means& means, const io::ValueScale& scale) {
        for (std::size_t k = 0; k < means.value.size(); ++k) {
            const double value = means.value[k];
            const double t = value > 0 ? scale.position(value) : 0;
            grid.reach.push_back(
                static_cast<float>(std::min(kFarthest, kLobeRadius * t / grid.top)));
            grid.doubt.push_back(
                static_cast<float>(value > 0 ? std::clamp(means.error[k] / value, 0.0, 1.0) : 0));
        }
        grid.mesh = net_of(grid.detector, grid.reach);
    }

    static Grid of_layer(const Measurement& m, const Layer& layer,
                         const io::SkyMapSettings& settings) {
        Grid grid;
        grid.detector = coarse_detector(m.detector);
        grid.map = settings.colour_map;
        const io::ValueScale scale = io::value_scale(m, {&layer}, settings);
        const Means means = means_of(m, layer, settings.channel, grid.detector);
        grid.top = top_of(means, scale);
        fill(grid, means, scale);
        return grid;
    }

    static Grid of_model(const Bsdf& model, const Measurement& m, const Layer& layer,
                         const io::SkyMapSettings& settings, Pixel tint) {
        Grid grid;
        grid.detector = coarse_detector(m.detector);
        grid.map = settings.colour_map;
        grid.tint = tint;
        const io::ValueScale scale = io::value_scale(m, {&layer}, settings);
        grid.top = top_of(means_of(m, layer, settings.channel, grid.detector), scale);
        fill(grid,
             means_of(
                 m.detector, values_of(model, m, layer, settings.channel), [](int) { return 0.0; },
                 grid.detector),
             scale);
        return grid;
    }
};

Lobe::Lobe(const Measurement& measurement, const Layer& layer, const io::SkyMapSettings& settings)
    : Lobe(Maker::of_layer(measurement, layer, settings)) {}

Lobe::Lobe(const Bsdf& model, const Measurement& measurement, const Layer& layer,
           const io::SkyMapSettings& settings, Pixel tint)
    : Lobe(Maker::of_model(model, measurement, layer, settings, tint)) {}

Lobe::Lobe(const Grid& grid)
    : detector_(grid.detector),
      reach_(grid.reach),
      doubt_(grid.doubt),
      top_(grid.top),
      radius_(static_cast<double>(*std::max_element(grid.reach.begin(), grid.reach.end()))),
      map_(grid.map),
      tint_(grid.tint),
      traced_(traced(grid.mesh)) {}

void Lobe::look(std::span<const WorldRay> rays, std::span<Hit> hits) const {
    if (traced_)
        traced_->intersect(rays, hits);
    else
        std::fill(hits.begin(), hits.end(), Hit{});
}

Vec3 Lobe::direction(const WorldRay& ray, const Hit& hit) {
    const Vec3 at = ray.origin + static_cast<double>(hit.distance) * ray.direction;
    Vec3 d = SurfaceFrame::direction_to_surface(at);
    d.z = std::max(d.z, 0.0);
    return length(d) > 0 ? normalize(d) : Vec3{0, 0, 1};
}

double Lobe::reach(Vec3 direction) const {
    return static_cast<double>(reach_[static_cast<std::size_t>(detector_.cell_of(direction))]);
}

double Lobe::opacity(const WorldRay& ray, const Hit& hit) const {
    if (!tint_) return 1 - kClear;
    // As glass: clear where one looks straight through, less at the rim
    constexpr double kLeast = 0.12, kMost = 0.9;
    const double facing =
        std::abs(dot(traced_->surface(ray, hit).shading_normal, normalize(ray.direction)));
    const double rim = 1 - std::min(facing, 1.0);
    return kLeast + (kMost - kLeast) * rim * rim;
}

Lobe::Pixel Lobe::colour(const WorldRay& ray, const Hit& hit) const {
    const SurfacePoint point = traced_->surface(ray, hit);
    io::Colour c{};
    if (tint_) {
        const auto part = [this](std::size_t k) { return static_cast<double>((*tint_)[k]) / 255; };
        c = {part(0), part(1), part(2)};
    } else {
        c = io::colour_of(map_, top_ * length(point.position) / kLobeRadius);
        // What is not known well has less colour
        const auto cell = static_cast<std::size_t>(detector_.cell_of(direction(ray, hit)));
        const double doubt = static_cast<double>(doubt_[cell]);
        const double grey = 0.3 * c.r + 0.59 * c.g + 0.11 * c.b;
        for (double* part : {&c.r, &c.g, &c.b}) *part += doubt * (grey - *part);
    }

    // A light over the eye's left shoulder, and a sky
    const Vec3 n = point.shading_normal;
    const Vec3 across = normalize(cross(ray.direction, Vec3{1e-6, 1, 0}));
    const Vec3 sun = normalize(-1.0 * ray.direction - 0.5 * across + Vec3{0, 0.7, 0});
    const double facing = std::max(0.0, dot(n, sun));
    const Vec3 halfway = normalize(sun - ray.direction);
    const double gloss = 0.22 * std::pow(std::max(0.0, dot(n, halfway)), 40.0);
    return pixel_of(c, 0.30 + 0.75 * facing + 0.12 * std::max(0.0, n.y), gloss);
}

}  // namespace asperity::studio
