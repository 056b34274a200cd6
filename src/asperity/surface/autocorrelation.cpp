// SPDX-License-Identifier: Apache-2.0
#include <asperity/surface/autocorrelation.h>

#include <asperity/surface/spectrum.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <utility>

namespace asperity {

namespace {

int even_quick_length(int n) {
    for (n += n % 2;; n += 2) {
        int rest = n;
        for (const int factor : {2, 3, 5})
            while (rest % factor == 0) rest /= factor;
        if (rest == 1) return n;
    }
}

struct MeanAndRms {
    double mean = 0, rms = 0;
};

MeanAndRms mean_and_rms(const std::vector<float>& heights) {
    const auto count = static_cast<double>(heights.size());
    MeanAndRms m;
    const double origin = static_cast<double>(heights.front());
    for (const float h : heights) m.mean += static_cast<double>(h) - origin;
    m.mean = m.mean / count + origin;
    for (const float h : heights)
        m.rms += (static_cast<double>(h) - m.mean) * (static_cast<double>(h) - m.mean);
    m.rms = std::sqrt(m.rms / count);
    return m;
}

}  // namespace

HeightAutocorrelation::HeightAutocorrelation(const Heightfield& surface, Run& run)
    : nx_(surface.nx),
      ny_(surface.ny),
      most_x_(surface.nx / 2),
      most_y_(surface.ny / 2),
      periodic_(surface.boundary == Boundary::Periodic) {
    wide_ = periodic_ ? nx_ : even_quick_length(nx_ + most_x_ + 1);
    high_ = periodic_ ? ny_ : even_quick_length(ny_ + most_y_ + 1);
    const auto [mean, rms] = mean_and_rms(surface.heights);
    const auto nx = static_cast<std::size_t>(nx_), wide = static_cast<std::size_t>(wide_);
    values_.assign(wide * static_cast<std::size_t>(high_), rms > 0 ? 0.0F : 1.0F);
    if (rms == 0) return;
    for (std::size_t k = 0; k < surface.heights.size(); ++k)
        values_[k / nx * wide + k % nx] =
            static_cast<float>((static_cast<double>(surface.heights[k]) - mean) / rms);
    const float scale =
        1 / static_cast<float>(surface.heights.size()) / static_cast<float>(values_.size());
    filter_spectrum(
        {wide_, high_, values_},
        [&](int, std::span<std::complex<float>> column) {
            for (std::complex<float>& c : column) c = std::norm(c) * scale;
        },
        run);
}

double HeightAutocorrelation::at(int a, int b) const {
    const auto i = static_cast<std::size_t>(a < 0 ? a + wide_ : a);
    const auto j = static_cast<std::size_t>(b < 0 ? b + high_ : b);
    const double sum = static_cast<double>(
        values_[j % static_cast<std::size_t>(high_) * static_cast<std::size_t>(wide_) +
                i % static_cast<std::size_t>(wide_)]);
    if (periodic_) return sum;
    // The sum over the part that overlaps, over the number of samples there
    const double overlap = (1.0 - static_cast<double>(std::abs(a)) / nx_) *
                           (1.0 - static_cast<double>(std::abs(b)) / ny_);
    return sum / overlap;
}

AutocorrelationContour contour_of(const HeightAutocorrelation& acf, double dx, double dy,
                                  double level) {
    const int most_x = acf.most_x(), most_y = acf.most_y();
    const auto width = static_cast<std::size_t>(2 * most_x + 1);
    std::vector<bool> seen(width * static_cast<std::size_t>(2 * most_y + 1));
    const auto mark = [&](int a, int b) {
        const std::size_t k =
            static_cast<std::size_t>(b + most_y) * width + static_cast<std::size_t>(a + most_x);
        const bool first = !seen[k];
        seen[k] = true;
        return first;
    };
    AutocorrelationContour contour{std::numeric_limits<double>::infinity(), 0, true};
    std::vector<std::pair<int, int>> open = {{0, 0}};
    mark(0, 0);
    while (!open.empty()) {
        const auto [a, b] = open.back();
        open.pop_back();
        const double here = acf.at(a, b);
        for (const auto& [da, db] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
            const int i = a + da, j = b + db;
            if (std::abs(i) > most_x || std::abs(j) > most_y) {
                contour.closed = false;
                continue;
            }
            const double there = acf.at(i, j);
            if (there >= level) {
                if (mark(i, j)) open.emplace_back(i, j);
                continue;
            }
            const double t = (here - level) / (here - there);
            const double r = std::hypot((a + t * da) * dx, (b + t * db) * dy);
            contour.nearest = std::min(contour.nearest, r);
            contour.farthest = std::max(contour.farthest, r);
        }
    }
    return contour;
}

}  // namespace asperity
