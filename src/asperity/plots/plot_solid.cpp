// SPDX-License-Identifier: Apache-2.0
#include <asperity/plots/plot_solid.h>

#include <asperity/core/directions.h>
#include <asperity/core/index.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace asperity::plots {

namespace {

constexpr double kPalest = 0.75;         ///< share of grey where nothing is known
constexpr double kWhollyUnsure = 0.5;    ///< relative standard error that is as pale as can be
constexpr double kOpacityBefore = 0.68;  ///< of a solid before another

/// Points of a solid: rows of the detector, a pole above and a rim at the horizon.
class Grid {
  public:
    Grid(const HemisphereValues& of, const io::ValueScale& scale) : of_(of), scale_(scale) {}

    int rows() const { return of_.detector.rows() + 1; }  ///< with the rim, without the pole
    int columns() const { return of_.detector.columns(); }
    double value(int row, int column) const { return of_.values[cell(row, column)]; }
    double error(int row, int column) const {
        return of_.errors.empty() ? 0 : of_.errors[cell(row, column)];
    }
    Vec3 place(int row, int column) const {
        const Detector& detector = of_.detector;
        const double theta =
            row < detector.rows() ? detector.theta_centre(row) : detector.theta_edge(row);
        return scale_.position(value(row, column)) *
               from_spherical(theta, detector.phi_centre(column));
    }
    double pole_value() const {
        double sum = 0;
        for (int column = 0; column < columns(); ++column) sum += value(0, column);
        return sum / columns();
    }
    double pole_error() const {
        double sum = 0;
        for (int column = 0; column < columns(); ++column) sum += error(0, column);
        return sum / columns();
    }
    Vec3 pole() const { return {0, 0, scale_.position(pole_value())}; }

  private:
    std::size_t cell(int row, int column) const {
        return index(std::min(row, of_.detector.rows() - 1) * columns() + column);
    }

    const HemisphereValues& of_;
    const io::ValueScale& scale_;
};

/// Normals: means of those of the triangles about each vertex, by their areas.
void find_normals(SolidMesh& mesh) {
    for (std::size_t t = 0; t + 2 < mesh.triangles.size(); t += 3) {
        std::array<SolidVertex*, 3> v{};
        for (std::size_t k = 0; k < 3; ++k) v[k] = &mesh.vertices[index(mesh.triangles[t + k])];
        const Vec3 normal = cross(v[1]->place - v[0]->place, v[2]->place - v[0]->place);
        for (SolidVertex* vertex : v) vertex->normal = vertex->normal + normal;
    }
    for (SolidVertex& vertex : mesh.vertices)
        if (dot(vertex.normal, vertex.normal) > 0) vertex.normal = normalize(vertex.normal);
}

}  // namespace

/// What the parts of a picture need.
struct SolidPlot::Scene {
    Canvas& canvas;
    const PlotStyle& style;
    const SolidCamera& camera;
    const SolidRaster& solids;

    /// A line in space. Pieces behind solids are left out; those of a solid's own line behind
    /// others are drawn in `behind`.
    void line(const std::vector<Vec3>& points, const Stroke& stroke, int own = -1,
              const Stroke* behind = nullptr) const {
        using Before = SolidRaster::Before;
        std::vector<Place> path;
        Before state = Before::Nothing;
        const auto finish = [&] {
            if (path.size() > 1 && state == Before::Nothing) canvas.polyline(path, stroke);
            if (path.size() > 1 && state == Before::Others && behind != nullptr)
                canvas.polyline(path, *behind);
            path.clear();
        };
        for (std::size_t k = 0; k + 1 < points.size(); ++k) {
            const Vec3 middle = 0.5 * (points[k] + points[k + 1]);
            const Before now = solids.before(camera.place(middle), camera.nearness(middle), own);
            if (now != state) finish();
            state = now;
            if (path.empty()) path.push_back(camera.place(points[k]));
            path.push_back(camera.place(points[k + 1]));
        }
        finish();
    }
    void straight(Vec3 from, Vec3 to, const Stroke& stroke) const {
        constexpr int kPieces = 200;
        std::vector<Vec3> points;
        for (int k = 0; k <= kPieces; ++k)
            points.push_back(from + (1.0 * k / kPieces) * (to - from));
        line(points, stroke);
    }
    /// A circle on the ground.
    void ring(double radius, const Stroke& stroke) const {
        constexpr int kPieces = 240;
        std::vector<Vec3> points;
        for (int k = 0; k <= kPieces; ++k)
            points.push_back(radius * from_spherical(kPi / 2, 2 * kPi * k / kPieces));
        line(points, stroke);
    }
};

SolidPlot::SolidPlot(Data data) : data_(std::move(data)) {
    while (data_.inks.size() < data_.lobes.size())
        data_.inks.push_back(series_ink(static_cast<int>(data_.inks.size())));
}

Heading SolidPlot::heading() const {
    Heading heading{data_.title, data_.note};
    for (std::size_t k = 0; k < data_.lobes.size() && data_.lobes.size() > 1; ++k)
        heading.legend.push_back({data_.lobes[k].name, data_.inks[k], CurveLook::Line});
    return heading;
}

Box SolidPlot::room(const Box& area, const PlotStyle& style) const {
    const double line = style.line_height();
    const Box rest = below_heading(area, style, heading());
    const double for_bar = data_.lobes.size() == 1 ? 7 * line : 2.4 * line;
    return {rest.left + 2.4 * line, rest.top + 1.2 * line, rest.width - 2.4 * line - for_bar,
            rest.height - 4.4 * line};
}

Box SolidPlot::bar(const Box& area, const PlotStyle& style) const {
    const double line = style.line_height();
    const Box room = this->room(area, style);
    const double height = std::min(0.75 * room.height, 16 * line);
    return {area.right() - 6 * line, room.centre().y - height / 2 + 0.6 * line, line, height};
}

SolidCamera SolidPlot::camera(const Box& area, const PlotStyle& style) const {
    return {data_.azimuth, data_.elevation, room(area, style)};
}

double SolidPlot::height_for(double width, const PlotStyle& style) const {
    const Box tall{0, 0, width, 10 * width};
    const Box room = this->room(tall, style);
    const Place size = SolidCamera::extent(data_.elevation);
    return room.top + room.width * size.y / size.x + 3.2 * style.line_height();
}

SolidMesh SolidPlot::mesh_of(std::size_t k, const PlotStyle& style) const {
    const Grid grid(data_.lobes[k], data_.scale);
    const Colour ink = style.ink(data_.inks[k]), grey = mix(style.faint, style.paper, 0.45);
    const auto colour = [&](double value, double error) {
        Colour pure = ink;
        if (data_.lobes.size() == 1) {
            const io::Colour c = io::colour_of(data_.colour_map, data_.scale.position(value));
            pure = {c.r, c.g, c.b};
        }
        if (!(error > 0)) return pure;
        const double unsure = value > 0 ? std::min(1.0, error / value / kWhollyUnsure) : 1;
        return mix(pure, grey, kPalest * unsure * unsure);
    };
    SolidMesh mesh;
    for (int row = 0; row < grid.rows(); ++row)
        for (int column = 0; column < grid.columns(); ++column)
            mesh.vertices.push_back({grid.place(row, column),
                                     {},
                                     colour(grid.value(row, column), grid.error(row, column))});
    const int pole = static_cast<int>(mesh.vertices.size()), columns = grid.columns();
    mesh.vertices.push_back({grid.pole(), {}, colour(grid.pole_value(), grid.pole_error())});
    for (int column = 0; column < columns; ++column) {
        const int next = (column + 1) % columns;
        mesh.triangles.insert(mesh.triangles.end(), {pole, column, next});
        for (int row = 0; row + 1 < grid.rows(); ++row) {
            const int a = row * columns + column, b = row * columns + next;
            mesh.triangles.insert(mesh.triangles.end(),
                                  {a, a + columns, b, b, a + columns, b + columns});
        }
    }
    find_normals(mesh);
    return mesh;
}

void SolidPlot::paint_ground(const Scene& scene) const {
    std::vector<Place> rim;
    constexpr int kPieces = 180;
    for (int k = 0; k < kPieces; ++k)
        rim.push_back(scene.camera.place(from_spherical(kPi / 2, 2 * kPi * k / kPieces)));
    scene.canvas.polygon(rim, mix(scene.style.paper, scene.style.grid, 0.35));
}

void SolidPlot::paint_rings(const Scene& scene) const {
    const PlotStyle& style = scene.style;
    const double line = style.line_height();
    const Stroke fine{style.grid, 1}, rim{style.faint, 1};
    const PlotAxis axis{
        {}, data_.scale.low, data_.scale.high, data_.scale.scale == io::Scale::Log, 0};
    // Values along the ground, beside the azimuth that points to the right of the picture
    const double along = data_.azimuth + radians(60);
    double last = 0;
    for (const PlotTick& tick : axis.ticks(4)) {
        const double r = axis.position(tick.value);
        if (tick.label.empty() || r < 0.05) continue;
        scene.ring(r, r > 1 - 1e-6 ? rim : fine);
        const Vec3 foot = r * from_spherical(kPi / 2, along);
        if (scene.camera.scale() * (r - last) < 1.6 * line || r > 1 - 1e-6) continue;
        last = r;
        if (scene.solids.hides(scene.camera.place(foot), scene.camera.nearness(foot))) continue;
        scene.canvas.text(scene.camera.place(foot) + Place{0, 0.65 * line}, tick.label, style.small,
                          style.faint, TextAlign::Centre);
    }
    for (int phi = 0; phi < 360; phi += 30) {
        const Vec3 end = from_spherical(kPi / 2, radians(phi));
        scene.straight({0, 0, 0}, end, fine);
        if (phi % 90 != 0) continue;
        const Place outward = scene.camera.place(end) - scene.camera.place({0, 0, 0});
        const double length = std::max(1e-9, std::hypot(outward.x, outward.y));
        scene.canvas.text(scene.camera.place(end) + (1.1 * line / length) * outward,
                          fmt::format("{}°", phi), style.small, style.faint, TextAlign::Centre);
    }
    const Place front = scene.camera.place({0, 0, 0}) +
                        Place{0, scene.camera.scale() * std::sin(data_.elevation) + 2.3 * line};
    const bool log = data_.scale.scale == io::Scale::Log;
    const std::string rim_value =
        (data_.scale.clipped ? "≥ " : "") + value_text(data_.scale.high) + " sr⁻¹";
    scene.canvas.text(front,
                      fmt::format("distance from the middle: {}BRDF  f, {} at the rim",
                                  log ? "log of the " : "", rim_value),
                      style.small, style.text, TextAlign::Centre);
}

void SolidPlot::paint_arcs(const Scene& scene) const {
    // The dome's outline in the plane of incidence of the first lobe, marks every 30 degrees
    const double phi = data_.lobes.front().phi_i;
    const double tick = 0.02;
    std::vector<Vec3> arc;
    for (int theta = -90; theta <= 90; ++theta)
        arc.push_back(from_spherical(radians(theta), phi + kPi));
    scene.line(arc, {scene.style.faint.with_opacity(0.55), 1, {4, 3}});
    for (int theta = -60; theta <= 60; theta += 30) {
        const Vec3 w = from_spherical(radians(theta), phi + kPi);
        scene.straight(w, (1 + tick) * w, {scene.style.faint, 1});
        const Vec3 beyond = (1 + 3.2 * tick) * w;
        scene.canvas.text(scene.camera.place(beyond), number_label(theta, 30) + "°",
                          scene.style.small, scene.style.faint, TextAlign::Centre);
    }
    scene.straight({0, 0, 0}, {0, 0, 1}, {scene.style.faint.with_opacity(0.7), 1});
}

void SolidPlot::paint_light(const Scene& scene, const HemisphereValues& of) const {
    const double line = scene.style.line_height();
    const Vec3 light = from_spherical(of.theta_i, of.phi_i);
    const Vec3 mirror = from_spherical(of.theta_i, of.phi_i + kPi);
    const Colour colour = scene.style.ink(PlotInk::Light);
    scene.straight(light, {0, 0, 0}, {colour, line / 7});
    scene.straight({0, 0, 0}, mirror, stroke_of(scene.style, PlotInk::Mirror, CurveLook::Dashes));
    // The head of the arrow lies on the rim of the dome, where it is always seen
    const Place tip = scene.camera.place(0.9 * light), tail = scene.camera.place(light);
    const Place along = tail - tip;
    const Place across = 0.3 * Place{-along.y, along.x};
    if (std::hypot(along.x, along.y) > 2)
        scene.canvas.polygon(std::array{tip, tail + across, tail - across}, colour);
}

void SolidPlot::paint_mesh(const Scene& scene, std::size_t k) const {
    constexpr int kStep = 15;  // degrees
    const Grid grid(data_.lobes[k], data_.scale);
    const Colour ink = scene.style.ink(data_.inks[k]);
    const double width = scene.style.line_height() / 16;
    const Stroke seen{mix(ink, scene.style.text, 0.25).with_opacity(0.8), width};
    const Stroke behind{ink.with_opacity(0.75), width};
    const int own = static_cast<int>(k), columns = grid.columns(), rows = grid.rows();
    for (int theta = kStep; theta < 90; theta += kStep) {
        std::vector<Vec3> parallel;
        const int row = std::min(rows - 2, theta * (rows - 1) / 90);
        for (int column = 0; column <= columns; ++column)
            parallel.push_back(grid.place(row, column % columns));
        scene.line(parallel, seen, own, &behind);
    }
    for (int phi = 0; phi < 360; phi += kStep) {
        std::vector<Vec3> meridian = {grid.pole()};
        for (int row = 0; row < rows; ++row)
            meridian.push_back(grid.place(row, phi * columns / 360));
        scene.line(meridian, seen, own, &behind);
    }
}

void SolidPlot::paint(Canvas& canvas, const Box& area, const PlotStyle& style) const {
    paint_heading(canvas, area, style, heading());
    const SolidCamera camera = this->camera(area, style);
    const Place middle = camera.place({0, 0, 0});
    const double reach = 1.02 * camera.scale();
    const double above = 1.02 * camera.scale(),
                 below = 1.02 * camera.scale() * std::sin(data_.elevation);
    const Box box{middle.x - reach, middle.y - above, 2 * reach, above + below + 1};
    SolidRaster solids(box, canvas.pixels_per_unit());
    for (std::size_t k = 0; k < data_.lobes.size(); ++k)
        solids.add(mesh_of(k, style), camera, kOpacityBefore);
    const Scene scene{canvas, style, camera, solids};
    paint_ground(scene);
    paint_rings(scene);
    const Raster picture = solids.picture();
    const double pixels = canvas.pixels_per_unit();
    canvas.picture({box.left, box.top, picture.width / pixels, picture.height / pixels}, picture);
    for (std::size_t k = 0; k < data_.lobes.size() && data_.lobes.size() > 1; ++k)
        paint_mesh(scene, k);
    paint_arcs(scene);
    std::vector<double> drawn;
    for (const HemisphereValues& of : data_.lobes) {
        if (std::find(drawn.begin(), drawn.end(), of.theta_i) != drawn.end()) continue;
        drawn.push_back(of.theta_i);
        paint_light(scene, of);
    }
    if (data_.lobes.size() == 1)
        paint_colour_bar(canvas, bar(area, style), style, data_.scale, data_.colour_map,
                         "f  [sr⁻¹]");
}

PlotTable SolidPlot::table() const {
    HemispherePlot::Data data;
    data.discs = data_.lobes;
    return HemispherePlot(std::move(data)).table();
}

}  // namespace asperity::plots
