// SPDX-License-Identifier: Apache-2.0
#include <asperity/core/directions.h>
#include <asperity/core/error.h>
#include <asperity/render/environment_map.h>

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace asperity {

namespace {

/// A part of a whole, and a place in it, 0 .. 1.
struct Choice {
    std::size_t part = 0;
    double place = 0;
};

/// Which of the parts whose cumulated sizes are `sums` holds the share `u` of the whole, and where
/// in it. It is known to be one of `first` .. `last`. A part of no size is never chosen.
Choice choose(std::span<const double> sums, double u, std::size_t first, std::size_t last) {
    const double target = u * sums.back();
    const auto* const begin = sums.data();
    const auto* const found = std::upper_bound(begin + first, begin + last, target);
    const auto part = static_cast<std::size_t>(found - begin);
    const double before = part == 0 ? 0 : sums[part - 1];
    return {part, (target - before) / (sums[part] - before)};
}

/// The parts that hold the shares 0, 1 / n, 2 / n, ... 1 of the whole: between two of them the
/// search for a share is short, and stays within a cache line or two. n = guides.size() - 1 is a
/// power of 2, so that shares and their multiples are exact.
void guide(std::span<const double> sums, std::span<std::uint32_t> guides) {
    const double n = static_cast<double>(guides.size() - 1);
    for (std::size_t k = 0; k < guides.size(); ++k) {
        const double u = static_cast<double>(k) / n;
        guides[k] = static_cast<std::uint32_t>(choose(sums, u, 0, sums.size() - 1).part);
    }
}

/// Whether a place in a part is farther from both its ends than rounding can lead astray: at the
/// poles of the highest maps that is 1e-8 of a row.
bool lies_within(double place) {
    constexpr double kEdge = 1e-6;
    return place > kEdge && place < 1 - kEdge;
}

/// atan2(y, x), to the last bit or two, in less than half its time; 0 for 0, 0.
double angle(double y, double x) {
    if (std::abs(y) > std::abs(x)) return std::copysign(0.5 * kPi, y) - std::atan(x / y);
    if (x == 0) return 0;
    return std::atan(y / x) + (x > 0 ? 0 : std::copysign(kPi, y));
}

class EnvironmentLight final : public Light {
  public:
    EnvironmentLight(const Image& map, const EnvironmentMapSettings& settings);

    std::string name() const override {
        // A whole sphere is twice as wide as high.
        const bool stretched = map_.width != 2 * map_.height;
        return fmt::format("environment {}, {} x {}{}, turned by {} degrees, scale {}",
                           settings_.name, map_.width, map_.height,
                           stretched ? " stretched over the sphere" : "", settings_.rotation_deg,
                           settings_.scale);
    }
    std::optional<LightSample> sample(Vec3 point, double u1, double u2) const override;
    Rgb radiance(Vec3 direction) const override {
        const Texel t = texel_at(direction);
        return settings_.scale * map_.at(t.column, t.row);
    }
    double pdf(Vec3 direction) const override {
        const Texel t = texel_at(direction);
        return luminance(map_.at(t.column, t.row)) / total_;
    }
    Rgb background(Vec3 direction) const override;
    double weight() const override { return 0.25 * settings_.scale * total_; }

  private:
    struct Texel {
        int column = 0, row = 0;
    };

    /// A direction of the world on the map, and back.
    Vec3 to_map(Vec3 d) const { return {cos_ * d.x - sin_ * d.z, d.y, sin_ * d.x + cos_ * d.z}; }
    Vec3 to_world(Vec3 d) const { return {cos_ * d.x + sin_ * d.z, d.y, cos_ * d.z - sin_ * d.x}; }

    Texel texel_at(Vec3 direction) const {
        const MapPoint p = map_point(to_map(direction));
        return {std::min(static_cast<int>(p.u * map_.width), map_.width - 1),
                std::min(static_cast<int>(p.v * map_.height), map_.height - 1)};
    }
    void accumulate();
    std::span<const double> columns_of(std::size_t row) const {
        const auto width = static_cast<std::size_t>(map_.width);
        return std::span(column_sums_).subspan(row * width, width);
    }
    std::span<std::uint32_t> guides_of(std::size_t row) {
        return std::span(column_guides_).subspan(row * (guides_ + 1), guides_ + 1);
    }

    Image map_;
    EnvironmentMapSettings settings_;
    double cos_ = 1, sin_ = 0;       ///< of the rotation
    std::vector<double> row_edges_;  ///< cos(theta) of the upper edge of each row, and the last
    std::vector<double> row_sums_;   ///< luminance times solid angle, of all rows up to this one
    std::size_t guides_ = 1;         ///< per row, a power of 2, and one more
    std::vector<std::uint32_t> column_guides_;
    std::vector<double> column_sums_;  ///< luminance of the texels of a row up to this one
    double total_ = 0;                 ///< integral of the map's luminance over all directions
};

EnvironmentLight::EnvironmentLight(const Image& map, const EnvironmentMapSettings& settings)
    : map_(map), settings_(settings) {
    if (settings.rotation_deg != 0) {  // so that 0 turns by nothing at all
        cos_ = std::cos(radians(settings.rotation_deg));
        sin_ = std::sin(radians(settings.rotation_deg));
    }
    accumulate();
}

void EnvironmentLight::accumulate() {
    const auto width = static_cast<std::size_t>(map_.width);
    const auto height = static_cast<std::size_t>(map_.height);
    row_edges_.resize(height + 1);
    row_sums_.resize(height);
    column_sums_.resize(width * height);
    guides_ = std::bit_ceil(width / 8 + 1);
    column_guides_.resize((guides_ + 1) * height);
    for (std::size_t row = 0; row <= height; ++row)
        row_edges_[row] = std::cos(kPi * static_cast<double>(row) / map_.height);

    for (std::size_t row = 0; row < height; ++row) {
        double of_row = 0;
        for (std::size_t column = 0; column < width; ++column) {
            of_row += luminance(map_.at(static_cast<int>(column), static_cast<int>(row)));
            column_sums_[row * width + column] = of_row;
        }
        guide(columns_of(row), guides_of(row));
        const double solid_angle = 2 * kPi / map_.width * (row_edges_[row] - row_edges_[row + 1]);
        total_ += solid_angle * of_row;
        row_sums_[row] = total_;
    }
}

std::optional<LightSample> EnvironmentLight::sample(Vec3, double u1, double u2) const {
    // Draw a row by its light, a texel by its light in the row
    const Choice row = choose(row_sums_, u1, 0, row_sums_.size() - 1);
    const auto* const from =
        &column_guides_[row.part * (guides_ + 1) +
                        static_cast<std::size_t>(u2 * static_cast<double>(guides_))];
    const Choice column = choose(columns_of(row.part), u2, from[0], from[1]);

    // Within the texel all solid angles are alike
    const double upper = row_edges_[row.part], lower = row_edges_[row.part + 1];
    const double y = upper + row.place * (lower - upper);
    const double r = std::sqrt(std::max(0.0, (1 - y) * (1 + y)));
    const double phi =
        2 * kPi * ((static_cast<double>(column.part) + column.place) / map_.width - 0.5);
    const Vec3 direction = to_world({r * std::sin(phi), y, -r * std::cos(phi)});

    // On the very edge of a texel rounding may have led across it: there, look it up again
    const bool within = lies_within(row.place) && lies_within(column.place);
    const Texel texel = within ? Texel{static_cast<int>(column.part), static_cast<int>(row.part)}
                               : texel_at(direction);
    const Rgb seen = map_.at(texel.column, texel.row);
    if (is_black(seen)) return std::nullopt;
    return LightSample{direction, kFarAway, settings_.scale * seen, luminance(seen) / total_};
}

Rgb EnvironmentLight::background(Vec3 direction) const {
    const MapPoint p = map_point(to_map(direction));
    const double x = p.u * map_.width - 0.5, y = p.v * map_.height - 0.5;
    const double left = std::floor(x), top = std::floor(y);
    // The map runs round in x and ends at the poles in y.
    const int columns[2] = {(static_cast<int>(left) + map_.width) % map_.width,
                            (static_cast<int>(left) + 1) % map_.width};
    const int rows[2] = {std::max(static_cast<int>(top), 0),
                         std::min(static_cast<int>(top) + 1, map_.height - 1)};
    const double a = x - left, b = y - top;
    const Rgb upper = (1 - a) * map_.at(columns[0], rows[0]) + a * map_.at(columns[1], rows[0]);
    const Rgb lower = (1 - a) * map_.at(columns[0], rows[1]) + a * map_.at(columns[1], rows[1]);
    return settings_.scale * ((1 - b) * upper + b * lower);
}

void check_map(const Image& map, const std::string& name) {
    const auto refuse = [&](const std::string& why) {
        throw Error(ErrorCode::InvalidInput, why, name);
    };
    if (map.width < 1 || map.height < 1) refuse("an environment map has one texel at least");
    bool black = true;
    for (int y = 0; y < map.height; ++y) {
        for (int x = 0; x < map.width; ++x) {
            const Rgb c = map.at(x, y);
            if (!is_finite(c) || std::min({c.r, c.g, c.b}) < 0)
                refuse(fmt::format("texel ({}, {}) is {}/{}/{}, light is finite and not negative",
                                   x, y, c.r, c.g, c.b));
            black = black && is_black(c);
        }
    }
    if (black) refuse("the environment map is black all over");
}

}  // namespace

MapPoint map_point(Vec3 direction) {
    const double r = std::sqrt(direction.x * direction.x + direction.z * direction.z);
    const double u = angle(direction.x, -direction.z) / (2 * kPi) + 0.5;
    // The same as acos(y), but as exact near the poles as elsewhere.
    const double v = angle(r, direction.y) / kPi;
    constexpr double kBelowOne = 1 - 0x1p-53;
    return {u < 1 ? u : 0.0, std::min(v, kBelowOne)};
}

Vec3 map_direction(MapPoint p) {
    const double theta = kPi * p.v, phi = 2 * kPi * (p.u - 0.5);
    const double r = std::sin(theta);
    return {r * std::sin(phi), std::cos(theta), -r * std::cos(phi)};
}

std::unique_ptr<Light> make_environment_light(const Image& map,
                                              const EnvironmentMapSettings& settings) {
    if (!std::isfinite(settings.rotation_deg))
        throw Error(ErrorCode::Usage, "an angle is a finite number", "light-rotation");
    if (!std::isfinite(settings.scale) || !(settings.scale > 0))
        throw Error(ErrorCode::Usage, "a scale is a finite number above 0", "light-scale");
    check_map(map, settings.name);
    auto light = std::make_unique<EnvironmentLight>(map, settings);
    if (!std::isfinite(light->weight()))
        throw Error(ErrorCode::Usage, "so much light is more than a number can hold",
                    "light-scale");
    return light;
}

}  // namespace asperity
