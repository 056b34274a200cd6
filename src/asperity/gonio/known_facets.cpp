// SPDX-License-Identifier: Apache-2.0
#include <asperity/gonio/known_facets.h>

#include <asperity/core/parallel.h>
#include <asperity/gonio/path_kernels.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <utility>

namespace asperity {

namespace {

constexpr std::uint64_t kMostCells = std::uint64_t{1} << 29;
constexpr int kWidest = (1 << 15) - 1 - kLaunchGroup;
/// So many rows are looked at first, to see whether it pays: when this share is known.
constexpr int kProbes = 16;
constexpr double kWorthwhile = 0.02;
/// A map of where their rays start pays from this share of the light on.
constexpr double kMapWorthwhile = 0.5;
/// Cells by which a ray may pass beside where it should, for rounding.
constexpr double kMargin = 1e-3;
/// Shares of light are added up as integers, so that their order does not matter.
constexpr float kFluxUnit = 1 << 24;

std::uint64_t cells_of(const WideTracer& tracer) {
    return static_cast<std::uint64_t>(tracer.cells_x()) *
           static_cast<std::uint64_t>(tracer.cells_y());
}

std::uint64_t to_units(float flux) {
    return static_cast<std::uint64_t>(flux * kFluxUnit);
}

}  // namespace

bool KnownFacets::pay(const WideTracer& tracer, std::uint64_t rays) {
    const std::uint64_t cells = cells_of(tracer);
    return tracer.periodic() && tracer.grid().horizon_pays && tracer.cells_x() <= kWidest &&
           cells <= kMostCells && rays >= cells;
}

/// What one thread looks with: a row of facets of one kind, and the light they take.
class KnownFacets::Look {
  public:
    Look(const Scene& scene, const Incidence& incidence)
        : scene_(scene),
          direction_(direction_of_light(scene.tracer, incidence)),
          cells_(static_cast<std::size_t>(cells_x()) + FacetRow::kSlack),
          flux_(cells_.size()),
          cosine_(cells_.size()),
          reflectance_(
              scene.fresnel.perfect() ? 0 : static_cast<std::size_t>(scene.fresnel.channels()),
              std::vector<float>(cells_.size())) {}

    int cells_x() const { return scene_.tracer.cells_x(); }
    int cells_y() const { return scene_.tracer.cells_y(); }
    std::size_t channels() const { return std::max<std::size_t>(1, reflectance_.size()); }
    /// Of the light, in the frame of the tracer.
    const Vec3& direction() const { return direction_; }
    const PaddedHeights& heights() const { return scene_.tracer.heights(); }
    std::size_t detector_cells() const { return static_cast<std::size_t>(scene_.detector.cells()); }

    void look_at(int j, bool upper) {
        look_at_facets(scene_.tracer.grid(), scene_.detector,
                       scene_.tracer.mirrored() ? -1.0f : 1.0f, direction_, j, upper,
                       {cells_.data(), flux_.data(), cosine_.data()});
    }
    bool is_known(int i) const { return flux_[static_cast<std::size_t>(i)] > 0; }
    int known() const {
        return static_cast<int>(std::count_if(flux_.begin(), flux_.begin() + cells_x(),
                                              [](float flux) { return flux > 0; }));
    }
    /// Adds what the row's known facets take to `total`, and what they send out to `sums`, by cell
    /// of the detector and channel.
    void add_light(std::vector<std::uint64_t>& sums, std::uint64_t& total) {
        const auto count = static_cast<std::size_t>(cells_x());
        std::vector<float*> out;
        for (std::vector<float>& r : reflectance_) out.push_back(r.data());
        if (!out.empty()) scene_.fresnel.eval({cosine_.data(), count}, out);
        for (std::size_t i = 0; i < count; ++i) {
            if (flux_[i] <= 0) continue;
            total += to_units(flux_[i]);
            std::uint64_t* sum = &sums[static_cast<std::size_t>(cells_[i]) * channels()];
            if (reflectance_.empty()) *sum += to_units(flux_[i]);
            for (std::size_t c = 0; c < reflectance_.size(); ++c)
                sum[c] += to_units(flux_[i] * std::min(reflectance_[c][i], 1.0f));
        }
    }

  private:
    const Scene& scene_;
    const Vec3 direction_;
    std::vector<std::int32_t> cells_;
    std::vector<float> flux_, cosine_;
    std::vector<std::vector<float>> reflectance_;  ///< [channel]; none for perfect mirrors
};

KnownFacets::KnownFacets(const Scene& scene, const Incidence& incidence, const Run& run)
    : pitch_(scene.tracer.cells_x() + kLaunchGroup) {
    const Look look(scene, incidence);
    if (!worthwhile(look, run)) return;
    cells_.assign(static_cast<std::size_t>(pitch_) * static_cast<std::size_t>(look.cells_y()), 0);
    const double share = look_at_all(look, run);
    // Light straight down needs no map: its rays meet the facets below them
    const bool slanted = look.direction().x != 0 || look.direction().y != 0;
    if (slanted && share > kMapWorthwhile) find_open(look, run);
    // A map that was stopped half-way promises nothing
    if (!slanted || share <= kMapWorthwhile || run.stop_requested())
        for (std::uint8_t& cell : cells_) cell |= CountedFacets::kOpen;
}

/// Looks at a row here and there.
bool KnownFacets::worthwhile(const Look& look, const Run& run) const {
    Look own = look;
    const int step = std::max(1, look.cells_y() / kProbes);
    double known = 0, seen = 0;
    for (int j = 0; j < look.cells_y() && run.keep_going(); j += step) {
        own.look_at(j, j / step % 2 == 1);
        known += own.known();
        seen += own.cells_x();
    }
    return known > kWorthwhile * seen;
}

/// Marks the known facets, and adds up what they send into each cell of the detector. Returns the
/// share of the light that they take.
double KnownFacets::look_at_all(const Look& look, const Run& run) {
    const auto parts = static_cast<std::size_t>(run.threads());
    const std::size_t values = look.detector_cells() * look.channels();
    std::vector<std::vector<std::uint64_t>> sums(parts);
    std::vector<std::uint64_t> totals(parts);
    parallel_for(parts, run.threads(), [&](std::size_t part) {
        Look own = look;
        sums[part].assign(values, 0);
        const auto rows = static_cast<std::size_t>(look.cells_y());
        for (std::size_t j = part * rows / parts; j < (part + 1) * rows / parts; ++j) {
            if (!run.keep_going()) return;
            std::uint8_t* cells = row(static_cast<int>(j));
            for (const bool upper : {false, true}) {
                own.look_at(static_cast<int>(j), upper);
                own.add_light(sums[part], totals[part]);
                const std::uint8_t bit = upper ? CountedFacets::kUpper : CountedFacets::kLower;
                for (int i = 0; i < look.cells_x(); ++i)
                    if (own.is_known(i)) cells[i] |= bit;
            }
        }
    });
    for (std::size_t part = 1; part < parts; ++part) {
        totals[0] += totals[part];
        for (std::size_t k = 0; k < sums[part].size(); ++k) sums[0][k] += sums[part][k];
    }
    light_ = CountedLight(sums[0], look.channels(), totals[0]);
    return static_cast<double>(totals[0]) / double{kFluxUnit} /
           (2.0 * look.cells_x() * look.cells_y());
}

/// Marks the cells above which a ray may start that meets another facet: the boxes around what the
/// cells of such facets look like along the light.
void KnownFacets::find_open(const Look& look, const Run& run) {
    const int cells_x = look.cells_x(), cells_y = look.cells_y();
    const PaddedHeights& heights = look.heights();
    // From a vertex back to the plane of the highest point, in cells per height
    const double back_x = look.direction().x / -look.direction().z / heights.dx(),
                 back_y = look.direction().y / -look.direction().z / heights.dy();
    const double top = double{heights.max_height()};
    const auto wrap = [](int a, int n) { return a >= 0 && a < n ? a : (a % n + n) % n; };
    const auto open_above = [&](int i, int j) {
        const auto [low, high] = std::minmax({heights.at(i, j), heights.at(i + 1, j),
                                              heights.at(i, j + 1), heights.at(i + 1, j + 1)});
        const double deep = top - double{low}, shallow = top - double{high};
        const auto [x_low, x_high] = std::minmax({back_x * deep, back_x * shallow});
        const auto [y_low, y_high] = std::minmax({back_y * deep, back_y * shallow});
        const int x0 = static_cast<int>(std::floor(i - x_high - kMargin)),
                  y0 = static_cast<int>(std::floor(j - y_high - kMargin));
        const int x1 = std::min(static_cast<int>(std::floor(i + 1 - x_low + kMargin)),
                                x0 + cells_x - 1),
                  y1 = std::min(static_cast<int>(std::floor(j + 1 - y_low + kMargin)),
                                y0 + cells_y - 1);
        for (int y = y0; y <= y1; ++y)
            for (int x = x0; x <= x1; ++x) {
                const std::atomic_ref cell(row(wrap(y, cells_y))[wrap(x, cells_x)]);
                if ((cell.load(std::memory_order_relaxed) & CountedFacets::kOpen) == 0)
                    cell.fetch_or(CountedFacets::kOpen, std::memory_order_relaxed);
            }
    };
    constexpr std::uint8_t kBoth = CountedFacets::kLower | CountedFacets::kUpper;
    parallel_for(static_cast<std::size_t>(cells_y), run.threads(), [&](std::size_t task) {
        if (!run.keep_going()) return;
        const int j = static_cast<int>(task);
        for (int i = 0; i < cells_x; ++i)
            if ((std::atomic_ref(row(j)[i]).load(std::memory_order_relaxed) & kBoth) != kBoth)
                open_above(i, j);
    });
    for (int j = 0; j < cells_y; ++j)
        for (int i = 0; i < kLaunchGroup; ++i) row(j)[cells_x + i] = row(j)[i % cells_x];
}

}  // namespace asperity
