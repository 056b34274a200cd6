// SPDX-License-Identifier: Apache-2.0
#include <asperity/surface/ggx.h>

#include <asperity/core/directions.h>
#include <asperity/surface/blocks.h>
#include <asperity/surface/facets.h>
#include <asperity/surface/length_histogram.h>
#include <asperity/surface/spectrum.h>

#include <cmath>
#include <utility>

namespace asperity {

namespace {

/// Length r of the stretched slope below which a share u of the facets lies.
double quantile(SlopeFamily family, double u) {
    if (family == SlopeFamily::Beckmann) return std::sqrt(-std::log1p(-u));
    return std::sqrt(u / (1 - u));
}

double length_of(Slope s) {
    return std::sqrt(s.x * s.x + s.y * s.y);
}

/// Azimuth of a slope that is not zero as a share of the turn, in [0, 1]: not proportional to the
/// angle (it runs along the square |x| + |y| = 1), but it grows with it, which is all ranks need.
double turn_of(Slope s) {
    const double along = s.y / (std::abs(s.x) + std::abs(s.y));
    const double quarters = s.x < 0 ? 2 - along : (s.y < 0 ? 4 + along : along);
    return quarters / 4;
}

/// Counts of stretched slopes: azimuths in equal bins of turn_of, lengths for each of 16 sectors.
struct SlopeCounts {
    static constexpr std::size_t kAzimuthBins = 4096, kSectors = 16;
    using Lengths = LengthHistogram<8>;
    std::vector<std::uint64_t> azimuths = std::vector<std::uint64_t>(kAzimuthBins, 0);
    std::vector<Lengths> lengths = std::vector<Lengths>(kSectors);

    static std::size_t bin(double turn) {
        return std::min(static_cast<std::size_t>(turn * static_cast<double>(kAzimuthBins)),
                        kAzimuthBins - 1);
    }
    static std::size_t sector(double turn) { return bin(turn) / (kAzimuthBins / kSectors); }

    void add(Slope stretched) {
        const double length = length_of(stretched);
        const double turn = length > 0 ? turn_of(stretched) : 0.0;
        ++azimuths[bin(turn)];
        lengths[sector(turn)].add(length);
    }

    SlopeCounts& operator+=(const SlopeCounts& other) {
        for (std::size_t b = 0; b < kAzimuthBins; ++b) azimuths[b] += other.azimuths[b];
        for (std::size_t s = 0; s < kSectors; ++s) lengths[s] += other.lengths[s];
        return *this;
    }
};

/// Ranks of stretched slopes: the share of the facets of less azimuth, and of those in the same
/// sector the share of less length.
class SlopeRanks {
  public:
    explicit SlopeRanks(const SlopeCounts& counts)
        : lengths_(counts.lengths.begin(), counts.lengths.end()) {
        std::uint64_t total = 0, below = 0;
        for (const std::uint64_t count : counts.azimuths) total += count;
        for (const std::uint64_t count : counts.azimuths) {
            azimuth_shares_.push_back(static_cast<double>(below) / static_cast<double>(total));
            below += count;
        }
        azimuth_shares_.push_back(1.0);
    }

    double length_share(double turn, double length) const {
        return lengths_[SlopeCounts::sector(turn)].share(length);
    }

    double azimuth_share(double turn) const {
        const std::size_t b = SlopeCounts::bin(turn);
        const double inside =
            turn * static_cast<double>(SlopeCounts::kAzimuthBins) - static_cast<double>(b);
        return azimuth_shares_[b] + inside * (azimuth_shares_[b + 1] - azimuth_shares_[b]);
    }

  private:
    std::vector<LengthRanks<8>> lengths_;
    std::vector<double> azimuth_shares_;  // below each bin, and 1
};

Slope stretch(const SlopeLaw& law, Slope s) {
    return {s.x / law.alpha_x, s.y / law.alpha_y};
}

/// The slope a facet should have: in stretched slope space the length and the azimuth of its ranks.
Slope target_slope(const SlopeLaw& law, const SlopeRanks& ranks, Slope s) {
    const Slope stretched = stretch(law, s);
    const double length = length_of(stretched);
    if (length == 0) return s;
    const double turn = turn_of(stretched);
    const double r = quantile(law.family, ranks.length_share(turn, length));
    const double phi = 2 * kPi * ranks.azimuth_share(turn);
    const Slope target{law.alpha_x * r * std::cos(phi), law.alpha_y * r * std::sin(phi)};
    const double gradient = length_of(target);
    const double cut = gradient > law.max_slope ? law.max_slope / gradient : 1.0;
    return {cut * target.x, cut * target.y};
}

/// Wanted slopes of one row of cells, gathered on its edges: an edge of two facets gets both.
struct EdgeTargets {
    std::vector<double> bottom, top;  ///< along x, from the lower and the upper facet of cell i
    std::vector<double> upright;      ///< along y at sample i: the sum of its two facets

    explicit EdgeTargets(int nx)
        : bottom(static_cast<std::size_t>(nx)),
          top(static_cast<std::size_t>(nx)),
          upright(static_cast<std::size_t>(nx)) {}

    void collect(const Heightfield& surface, const SlopeLaw& law, const SlopeRanks& ranks, int j) {
        std::fill(upright.begin(), upright.end(), 0.0);
        const bool anti = surface.diagonal == Diagonal::Anti;
        visit_facets(surface, j, [&](int i, Triangle triangle, Slope s) {
            const Slope target = target_slope(law, ranks, s);
            const auto left = static_cast<std::size_t>(i);
            const auto right = static_cast<std::size_t>(i + 1 < surface.nx ? i + 1 : 0);
            const bool lower = triangle == Triangle::Lower;
            (lower ? bottom : top)[left] = target.x;
            upright[lower == anti ? left : right] += target.y;
        });
    }
};

/// Writes row j of the right-hand side of the normal equations: minus the divergence of the wanted
/// slopes, each edge taking the mean of its two facets.
void write_divergence(const EdgeTargets& before, const EdgeTargets& after, double dx, double dy,
                      float* row) {
    const std::size_t nx = after.bottom.size();
    std::size_t left = nx - 1;
    for (std::size_t i = 0; i < nx; left = i++) {
        const double from_left = after.bottom[left] + before.top[left];
        const double to_right = after.bottom[i] + before.top[i];
        const double d = (from_left - to_right) / dx + (before.upright[i] - after.upright[i]) / dy;
        row[i] = static_cast<float>(0.5 * d);
    }
}

SlopeRanks rank_slopes(const Heightfield& surface, const SlopeLaw& law, Run& run) {
    const auto add_row = [&](SlopeCounts& part, int j) {
        throw_if_stopped(run);
        visit_facets(surface, j, [&](int, Triangle, Slope s) { part.add(stretch(law, s)); });
        run.advance(1);
    };
    return SlopeRanks(
        sum_rows<SlopeCounts>(surface.ny, run.threads(), add_row, rows_per_histogram(surface.ny)));
}

void move_to_ranks(const Heightfield& surface, const SlopeLaw& law, const SlopeRanks& ranks,
                   std::vector<float>& divergence, Run& run) {
    const auto nx = static_cast<std::size_t>(surface.nx);
    for_blocks(surface.ny, kRowsPerBlock, run, [&](int first, int last) {
        EdgeTargets before(surface.nx), after(surface.nx);
        before.collect(surface, law, ranks, first == 0 ? surface.ny - 1 : first - 1);
        for (int j = first; j < last; ++j) {
            after.collect(surface, law, ranks, j);
            write_divergence(before, after, surface.dx, surface.dy,
                             divergence.data() + static_cast<std::size_t>(j) * nx);
            std::swap(before, after);
        }
        run.advance(static_cast<std::uint64_t>(last - first));
    });
}

/// Least squares: divides the spectrum by that of minus the Laplacian of the grid,
/// 4 sin^2(kx / 2) / dx^2 + 4 sin^2(ky / 2) / dy^2.
void integrate(const Heightfield& surface, std::vector<float>& divergence, Run& run) {
    const auto difference = [](int k, int n, double step) {
        const double s = 2 * std::sin(kPi * k / n) / step;
        return s * s;
    };
    std::vector<double> along_y;
    for (int ky = 0; ky < surface.ny; ++ky)
        along_y.push_back(difference(ky, surface.ny, surface.dy));
    const double count = static_cast<double>(surface.nx) * static_cast<double>(surface.ny);
    const auto solve = [&](int kx, std::span<std::complex<float>> column) {
        const double along_x = difference(kx, surface.nx, surface.dx);
        for (std::size_t k = 0; k < column.size(); ++k) {
            const bool mean = kx == 0 && k == 0;
            const double factor = mean ? 0.0 : 1 / ((along_x + along_y[k]) * count);
            column[k] *= static_cast<float>(factor);
        }
    };
    filter_spectrum({surface.nx, surface.ny, divergence}, solve, run);
}

}  // namespace

void impose_slope_law(Heightfield& surface, const SlopeLaw& law, int rounds, Run& run) {
    const Boundary boundary = std::exchange(surface.boundary, Boundary::Periodic);
    std::vector<float> next;
    allocate(next, surface.heights.size(), run);
    for (int round = 0; round < rounds; ++round) {
        const SlopeRanks ranks = rank_slopes(surface, law, run);
        move_to_ranks(surface, law, ranks, next, run);
        integrate(surface, next, run);
        surface.heights.swap(next);
    }
    surface.boundary = boundary;
}

std::uint64_t impose_steps(int nx, int ny) {
    // Rank, move, and the three passes of the filter
    return 3 * static_cast<std::uint64_t>(ny) + transform_steps(nx, ny);
}

}  // namespace asperity
