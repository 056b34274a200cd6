// SPDX-License-Identifier: Apache-2.0
#include <asperity/pictures/layer_view.h>

#include <asperity/core/error.h>
#include <asperity/core/index.h>
#include <asperity/core/parallel.h>
#include <asperity/core/run.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace asperity::io {

namespace {

/// Mean over the channels asked for.
template <typename OfChannel>
double shown_mean(const Measurement& measurement, int channel, OfChannel&& of_channel) {
    if (channel >= 0) return of_channel(channel);
    double sum = 0;
    for (int c = 0; c < measurement.channels(); ++c) sum += of_channel(c);
    return measurement.channels() > 0 ? sum / measurement.channels() : 0.0;
}

/// The largest f, the brightest cells left out that carry `share` of the energy together.
double brightest(const Detector& detector, const std::vector<double>& values, double share) {
    std::vector<int> cells;
    double left_out = 0, total = 0;
    const auto energy = [&](int cell) {
        return values[index(cell)] * detector.projected_solid_angle(cell / detector.columns());
    };
    for (int cell = 0; cell < detector.cells(); ++cell) {
        if (!(values[index(cell)] > 0)) continue;
        cells.push_back(cell);
        total += energy(cell);
    }
    std::sort(cells.begin(), cells.end(),
              [&](int a, int b) { return values[index(a)] > values[index(b)]; });
    for (const int cell : cells) {
        left_out += energy(cell);
        if (left_out > share * total) return values[index(cell)];
    }
    return 0;
}

/// The first of ... 0.1, 0.2, 0.5, 1, 2, 5, 10 ... not below `value` > 0.
double round_up(double value) {
    const double decade = std::pow(10.0, std::floor(std::log10(value)));
    for (const double step : {1.0, 2.0, 5.0})
        if (value <= step * decade * (1 + 1e-9)) return step * decade;
    return 10 * decade;
}

/// Finds the cell of the detector below a point of a picture.
class CellFinder {
  public:
    CellFinder(const Detector& detector, Projection projection)
        : columns_(detector.columns()), projection_(projection) {
        for (int row = 0; row <= detector.rows(); ++row) edges_.push_back(down(row, detector));
    }

    struct Found {
        int cell = 0;
        double weight = 0;  ///< of the surroundings in a cosine-weighted mean; 0: no direction
    };

    /// At (u, v) in [0, 1] x [0, 1] of the picture, v down. `row` is the row found last: near
    /// points have near rows.
    Found find(double u, double v, int& row) const {
        if (projection_ == Projection::SkyMap) {
            const double theta = 0.5 * kPi * v;
            return {cell_at(theta, u, row), std::sin(theta) * std::cos(theta)};
        }
        // Seen from above, equal areas of the disk are equal projected solid angles.
        const double x = 2 * u - 1, y = 1 - 2 * v, r2 = x * x + y * y;
        if (r2 >= 1) return {};
        const double turns = std::atan2(y, x) / (2 * kPi);
        return {cell_at(r2, turns < 0 ? turns + 1 : turns, row), 1.0};
    }

  private:
    /// Edge of a row in the coordinate that runs down the rows: theta, or sin^2 theta on a disk.
    double down(int row, const Detector& detector) const {
        const double theta = detector.theta_edge(row);
        return projection_ == Projection::SkyMap ? theta : std::sin(theta) * std::sin(theta);
    }
    int cell_at(double place, double turns, int& row) const {
        while (row > 0 && place < edges_[index(row)]) --row;
        while (index(row) + 2 < edges_.size() && place >= edges_[index(row + 1)]) ++row;
        return row * columns_ + std::min(static_cast<int>(turns * columns_), columns_ - 1);
    }

    int columns_;
    Projection projection_;
    std::vector<double> edges_;
};

/// Samples a pixel takes along x and y: one when cells are larger than pixels.
std::array<int, 2> samples_per_pixel(const Detector& detector, Rect area, Projection projection) {
    if (projection == Projection::Disk) return {3, 3};
    const auto needed = [](int cells, int pixels) {
        return std::clamp((2 * cells + pixels - 1) / pixels, 1, 8);
    };
    const bool fits = detector.columns() <= area.width && detector.kind() == DetectorKind::LatLong;
    if (fits) return {1, 1};
    return {needed(detector.columns(), area.width), needed(detector.rows(), area.height)};
}

}  // namespace

std::vector<double> values_of(const Measurement& measurement, const Layer& layer, int channel) {
    std::vector<double> values(index(measurement.detector.cells()));
    for (int cell = 0; cell < measurement.detector.cells(); ++cell)
        values[index(cell)] = shown_mean(measurement, channel,
                                         [&](int c) { return measurement.brdf(layer, c, cell); });
    return values;
}

double shown_albedo(const Measurement& measurement, const Layer& layer, int channel) {
    return shown_mean(measurement, channel, [&](int c) { return measurement.albedo(layer, c); });
}

double ValueScale::position(double value) const {
    const double t =
        scale == Scale::Linear ? value / high : std::log(value / low) / std::log(high / low);
    return std::clamp(t, 0.0, 1.0);
}

ValueScale value_scale(const Measurement& measurement, const std::vector<const Layer*>& layers,
                       const SkyMapSettings& settings) {
    constexpr double kShareLeftOut = 1e-3;
    double top = 0, largest = 0;
    for (const Layer* layer : layers) {
        const std::vector<double> values = values_of(measurement, *layer, settings.channel);
        top = std::max(top, brightest(measurement.detector, values, kShareLeftOut));
        largest = std::accumulate(values.begin(), values.end(), largest,
                                  [](double a, double b) { return std::max(a, b); });
    }
    ValueScale scale;
    scale.scale = settings.scale;
    scale.high = top > 0 ? round_up(top) : 1.0;
    scale.low = settings.scale == Scale::Log ? scale.high * std::pow(10.0, -settings.decades) : 0.0;
    scale.clipped = largest > scale.high;
    return scale;
}

Colour colour_of_value(double value, const ValueScale& scale, ColourMap map) {
    return value > 0 ? colour_of(map, scale.position(value)) : kZeroColour;
}

void check_settings(const Measurement& measurement, const SkyMapSettings& settings) {
    if (!(settings.decades > 0 && settings.decades <= 30))
        throw Error(ErrorCode::Usage,
                    fmt::format("{} is outside 0 < decades <= 30", settings.decades), "decades");
    if (settings.channel < -1 || settings.channel >= measurement.channels())
        throw Error(ErrorCode::Usage,
                    fmt::format("there is no channel {}; channels are 0 .. {}, -1 is their mean",
                                settings.channel, measurement.channels() - 1),
                    "channel");
}

void paint_layer(Canvas& canvas, Rect area, const Measurement& measurement, const Layer& layer,
                 const ValueScale& scale, const SkyMapSettings& settings) {
    const Detector& detector = measurement.detector;
    const std::vector<double> values = values_of(measurement, layer, settings.channel);
    const auto [across, down] = samples_per_pixel(detector, area, settings.projection);
    const CellFinder finder(detector, settings.projection);
    const auto paint_pixel = [&, across = across, down = down](int i, int j, int& row) {
        double sum = 0, weight = 0;
        int inside = 0;
        for (int b = 0; b < down; ++b) {
            for (int a = 0; a < across; ++a) {
                const double u = (i + (a + 0.5) / across) / area.width;
                const double v = (j + (b + 0.5) / down) / area.height;
                const CellFinder::Found found = finder.find(u, v, row);
                if (!(found.weight > 0)) continue;
                sum += found.weight * values[index(found.cell)];
                weight += found.weight;
                ++inside;
            }
        }
        if (inside == 0) return;
        const Colour colour = colour_of_value(sum / weight, scale, settings.colour_map);
        canvas.blend(area.x + i, area.y + j, colour, static_cast<double>(inside) / (across * down));
    };
    parallel_for(index(area.height), Run().threads(), [&](std::size_t j) {
        int row = 0;
        for (int i = 0; i < area.width; ++i) paint_pixel(i, static_cast<int>(j), row);
    });
}

Point place_of(double theta, double phi, Rect area, Projection projection) {
    if (projection == Projection::SkyMap) {
        const double turns = phi / (2 * kPi);
        return {area.x + area.width * (turns - std::floor(turns)),
                area.y + area.height * theta / (0.5 * kPi)};
    }
    const double r = 0.5 * area.width * std::sin(theta);
    return {area.centre().x + r * std::cos(phi), area.centre().y - r * std::sin(phi)};
}

std::string degree_text(double angle) {
    return fmt::format("{:g}°", std::round(degrees(angle) * 100) / 100 + 0.0);
}

}  // namespace asperity::io
