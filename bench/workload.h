// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/core/vec.h>
#include <asperity/surface/heightfield.h>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace asperity::bench {

/// A launch point on the plane through the highest point of the surface.
struct Launch {
    std::int32_t i, j;  ///< cell
    float u, v;         ///< position inside it, 0 <= . < 1
};

/// What all rivals trace: parallel light onto one tile of perfect mirrors.
struct Workload {
    const Heightfield* surface = nullptr;
    double theta_deg = 0;        ///< of incidence
    Vec3 direction;              ///< of travel, unit length
    std::vector<Launch> launch;  ///< see blocked_launch
    int bounces = 16;            ///< reflections a path may make
};

/// Launch points come in blocks of kBlock x kBlock surface cells, one point at a random place in
/// each cell, along a Z-order curve: as dense as a measurement with one ray per cell, so that every
/// tracer finds in its caches what it would find there.
inline constexpr int kBlock = 64;

/// `count` launch points, a multiple of kBlock^2, in blocks spread over the surface; with more
/// blocks than the surface has, each is used again. The side of the surface is a multiple of
/// kBlock.
std::vector<Launch> blocked_launch(const Heightfield& surface, int count, std::uint64_t seed);

/// Direction of travel of light from polar angle `theta_deg`. The azimuth, 25 degrees, lies along
/// no line of the triangle grid: no tracer gets its easy case.
Vec3 incident_direction(double theta_deg);

/// What came out: the same bookkeeping for all rivals, so that their times compare.
class Tally {
  public:
    static constexpr int kSide = 32;  ///< cells along the diameter of the projected disk

    /// A path left along the unit vector (x, y, z) after `bounces` reflections.
    void add_escape(double x, double y, int bounces) {
        ++histogram_[static_cast<std::size_t>(cell(y) * kSide + cell(x))];
        reflections_ += static_cast<std::uint64_t>(bounces);
        ++escaped_;
    }
    void add_truncated() { ++truncated_; }
    /// A path that fell through a seam of the mesh, or never ended.
    void add_lost() { ++lost_; }
    void add_segments(std::uint64_t count) { segments_ += count; }

    std::uint64_t segments() const { return segments_; }
    std::uint64_t escaped() const { return escaped_; }
    std::uint64_t truncated() const { return truncated_; }
    std::uint64_t lost() const { return lost_; }
    std::uint64_t paths() const { return escaped_ + truncated_ + lost_; }
    double mean_reflections() const {
        return static_cast<double>(reflections_) / static_cast<double>(escaped_);
    }
    const std::array<std::uint64_t, kSide * kSide>& histogram() const { return histogram_; }

  private:
    static int cell(double x) {
        const int c = static_cast<int>((x + 1) * (kSide / 2));
        return c < kSide ? c : kSide - 1;
    }

    std::array<std::uint64_t, kSide * kSide> histogram_{};
    std::uint64_t segments_ = 0, escaped_ = 0, truncated_ = 0, lost_ = 0, reflections_ = 0;
};

/// Share of the paths that lie in different cells: half the L1 distance of the histograms.
double distance(const Tally& a, const Tally& b);

/// The distance to be expected between two runs with independent launch points. Rivals follow the
/// same points, so they must come much closer than this.
double distance_of_independent_runs(const Tally& a);

}  // namespace asperity::bench
