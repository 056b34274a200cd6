// SPDX-License-Identifier: Apache-2.0
#include <asperity/tracing/engines/wide/known_facets.h>

#include <asperity/core/energy.h>
#include <asperity/core/parallel.h>
#include <asperity/tracing/engines/wide/path_kernels.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <span>
#include <utility>

namespace asperity {

namespace {

constexpr std::uint64_t kMostCells = std::uint64_t{1} << 29;
constexpr int kWidest = (1 << 15) - 1 - CountedFacets::kSlack;
/// So many rows are looked at first, to see whether it pays: when this share is known.
constexpr int kRowsLookedAt = 16;
constexpr double kWorthwhile = 0.02;
/// Rows that are looked at before they are marked, which goes by columns where x and y are swapped.
constexpr std::size_t kRowsTogether = 16;

std::uint64_t cells_of(const WideTracer& tracer) {
    return static_cast<std::uint64_t>(tracer.cells_x()) *
           static_cast<std::uint64_t>(tracer.cells_y());
}

/// From how much goes into each cell, [cell * channels + channel], of `total` in each channel.
SpreadLight spread_of(const std::vector<std::uint64_t>& sums, std::size_t channels,
                      std::uint64_t total) {
    const std::size_t cells = sums.size() / channels;
    std::vector<std::uint32_t> places;
    std::vector<std::uint64_t> energy;
    // The sums so far are rounded, not each by itself, so that nothing is lost
    std::vector<std::uint64_t> so_far(channels), given(channels);
    for (std::size_t cell = 0; cell < cells; ++cell) {
        const std::uint64_t* sum = &sums[cell * channels];
        if (std::all_of(sum, sum + channels, [](std::uint64_t x) { return x == 0; })) continue;
        places.push_back(static_cast<std::uint32_t>(cell));
        for (std::size_t c = 0; c < channels; ++c) {
            so_far[c] += sum[c];
            const double share = static_cast<double>(so_far[c]) / static_cast<double>(total);
            const std::uint64_t rounded = to_energy(share);
            energy.push_back(rounded - given[c]);
            given[c] = rounded;
        }
    }
    return {{.cells = cells, .channels = channels}, std::move(places), std::move(energy)};
}

}  // namespace

bool KnownFacets::pay(const WideTracer& tracer, std::uint64_t rays) {
    const std::uint64_t cells = cells_of(tracer);
    return tracer.periodic() && tracer.grid().horizon_pays &&
           std::max(tracer.cells_x(), tracer.cells_y()) <= kWidest && cells <= kMostCells &&
           rays >= cells;
}

/// What one thread looks with: a row of facets of both kinds, and the light they take.
class KnownFacets::Look {
  public:
    explicit Look(const Scene& scene)
        : scene_(scene), direction_(direction_of_light(scene.tracer, scene.light)) {
        const std::size_t count = static_cast<std::size_t>(cells_x()) + FacetRow::kSlack;
        known_.resize(count);
        for (Facets& facets : both_) {
            facets.cells.resize(count);
            facets.flux.resize(count);
            if (!scene.fresnel.perfect()) facets.cosine.resize(count);
        }
        reflectance_.assign(
            scene.fresnel.perfect() ? 0 : static_cast<std::size_t>(scene.fresnel.channels()),
            std::vector<float>(count));
        // As fine as single precision: what a level facet takes and mirrors out must not be rounded
        // down to less, however much a steep one may take. All of them together take no more than
        // falls onto the tile, which fits; so does one
        const double level = std::hypot(direction_.x, direction_.y);
        const double most = 1 + double{scene.tracer.grid().steepest} * level / -direction_.z;
        unit_ = static_cast<float>(std::exp2(std::min(24.0, std::floor(62 - std::log2(most)))));
    }

    int cells_x() const { return scene_.tracer.cells_x(); }
    int cells_y() const { return scene_.tracer.cells_y(); }
    std::size_t channels() const { return std::max<std::size_t>(1, reflectance_.size()); }
    /// Of the light, in the frame of the tracer.
    const Vec3& direction() const { return direction_; }
    bool all_sides() const { return scene_.light.isotropic; }
    std::size_t columns() const { return static_cast<std::size_t>(scene_.detector.columns()); }
    std::size_t detector_cells() const { return static_cast<std::size_t>(scene_.detector.cells()); }

    void look_at(int j) {
        look_at_facets(scene_.tracer.grid(), scene_.detector,
                       scene_.tracer.mirrored() ? -1.0f : 1.0f, direction_, unit_, j,
                       both_[0].row(), both_[1].row(), known_.data());
    }
    /// The bits of CountedFacets, cell by cell.
    std::span<const std::uint8_t> known() const {
        return {known_.data(), static_cast<std::size_t>(cells_x())};
    }
    /// Adds what the row's known facets take to `total`, and what they send out to `sums`, by cell
    /// of the detector and channel.
    void add_light(std::vector<std::uint64_t>& sums, std::uint64_t& total) {
        const auto count = static_cast<std::size_t>(cells_x());
        std::vector<float*> out;
        for (std::vector<float>& r : reflectance_) out.push_back(r.data());
        for (Facets& facets : both_) {
            for (std::size_t i = 0; i < count; ++i)
                total += static_cast<std::uint64_t>(facets.flux[i]);
            const std::int32_t* cells = facets.cells.data();
            if (out.empty())
                for (std::size_t i = 0; i < count; ++i)
                    sums[static_cast<std::size_t>(cells[i])] +=
                        static_cast<std::uint64_t>(facets.flux[i]);
            else
                scene_.fresnel.eval({facets.cosine.data(), count}, out);
            for (std::size_t c = 0; c < reflectance_.size(); ++c)
                for (std::size_t i = 0; i < count; ++i)
                    sums[static_cast<std::size_t>(cells[i]) * channels() + c] +=
                        static_cast<std::uint64_t>(facets.flux[i] *
                                                   std::min(reflectance_[c][i], 1.0f));
        }
    }

  private:
    struct Facets {
        std::vector<std::int32_t> cells;
        std::vector<float> flux;
        std::vector<float> cosine;  ///< none for perfect mirrors
        FacetRow row() {
            return {cells.data(), flux.data(), cosine.empty() ? nullptr : cosine.data()};
        }
    };
    const Scene& scene_;
    const Vec3 direction_;
    float unit_;
    Facets both_[2];  ///< lower, upper
    std::vector<std::uint8_t> known_;
    std::vector<std::vector<float>> reflectance_;  ///< [channel]; none for perfect mirrors
};

KnownFacets::KnownFacets(const Scene& scene, const Run& run, int threads) {
    const Look look(scene);
    if (!worthwhile(look, run)) return;
    swapped_ = scene.tracer.lines_along_x(look.direction());
    const int rows = swapped_ ? look.cells_x() : look.cells_y();
    pitch_ = (swapped_ ? look.cells_y() : look.cells_x()) + CountedFacets::kSlack;
    cells_.assign(static_cast<std::size_t>(pitch_) * static_cast<std::size_t>(rows), 0);
    look_at_all(look, run, threads);
    // Rows go on at their beginning
    const int cells = pitch_ - CountedFacets::kSlack;
    for (int j = 0; j < rows; ++j) {
        std::uint8_t* row = &cells_[static_cast<std::size_t>(j) * static_cast<std::size_t>(pitch_)];
        for (int k = 0; k < CountedFacets::kSlack; ++k) row[cells + k] = row[k % cells];
    }
}

/// Looks at a row here and there.
bool KnownFacets::worthwhile(const Look& look, const Run& run) const {
    Look own = look;
    const int step = std::max(1, look.cells_y() / kRowsLookedAt);
    int known = 0, seen = 0;
    for (int j = 0; j < look.cells_y() && run.keep_going(); j += step) {
        own.look_at(j);
        for (const std::uint8_t bits : own.known()) known += std::popcount(bits);
        seen += 2 * own.cells_x();
    }
    return known > kWorthwhile * seen;
}

/// Marks the known facets, and adds up what they send into each cell of the detector.
void KnownFacets::look_at_all(const Look& look, const Run& run, int threads) {
    const auto parts = static_cast<std::size_t>(threads);
    const auto rows = static_cast<std::size_t>(look.cells_y());
    std::vector<std::vector<std::uint64_t>> sums(parts);
    std::vector<std::uint64_t> totals(parts);
    parallel_for(parts, threads, [&](std::size_t part) {
        Look own = look;
        sums[part].assign(look.detector_cells() * look.channels(), 0);
        std::vector<std::uint8_t> known;
        const std::size_t end = (part + 1) * rows / parts;
        for (std::size_t j = part * rows / parts; j < end; j += kRowsTogether) {
            // All of these rows, or none: what is added up must be marked
            if (!run.keep_going()) return;
            known.clear();
            for (std::size_t row = j; row < std::min(j + kRowsTogether, end); ++row) {
                own.look_at(static_cast<int>(row));
                own.add_light(sums[part], totals[part]);
                known.insert(known.end(), own.known().begin(), own.known().end());
            }
            mark(j, known, own.known().size());
        }
    });
    for (std::size_t part = 1; part < parts; ++part) {
        totals[0] += totals[part];
        for (std::size_t k = 0; k < sums[part].size(); ++k) sums[0][k] += sums[part][k];
    }
    // Straight down light has no azimuth, and goes to all sides alike
    if (look.all_sides())
        for (std::size_t k = 0; k < sums[0].size(); k += look.columns() * look.channels())
            for (std::size_t c = 0; c < look.channels(); ++c)
                share_evenly(&sums[0][k + c], look.columns(), look.channels());
    light_ = std::make_shared<const SpreadLight>(spread_of(sums[0], look.channels(), totals[0]));
}

/// Writes some rows of `width` cells from row `j` on.
void KnownFacets::mark(std::size_t j, const std::vector<std::uint8_t>& known, std::size_t width) {
    const auto pitch = static_cast<std::size_t>(pitch_);
    const std::size_t rows = known.size() / width;
    if (!swapped_) {
        for (std::size_t row = 0; row < rows; ++row)
            std::copy_n(&known[row * width], width, &cells_[(j + row) * pitch]);
        return;
    }
    for (std::size_t i = 0; i < width; ++i)
        for (std::size_t row = 0; row < rows; ++row)
            cells_[i * pitch + j + row] = known[row * width + i];
}

}  // namespace asperity
