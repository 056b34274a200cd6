// SPDX-License-Identifier: Apache-2.0
#include <asperity/surface/resample.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace asperity {

namespace {

/// What a new sample is made of: weights of samples, which may lie beyond the ends.
struct Mixture {
    std::vector<std::pair<int, double>> parts;
};

/// Each new sample is the mean over its cell of the straight lines between the samples there were,
/// which stand in the middles of theirs.
std::vector<Mixture> mixtures(int from, int to, bool periodic) {
    std::vector<Mixture> all(static_cast<std::size_t>(to));
    const double width = static_cast<double>(from) / to;
    const auto wrapped = [&](int k) { return ((k % from) + from) % from; };
    for (int n = 0; n < to; ++n) {
        auto& parts = all[static_cast<std::size_t>(n)].parts;
        const double end = (n + 1) * width - 0.5;
        double begin = n * width - 0.5;
        while (begin < end - 1e-12 * from) {
            // Between two neighbours; beyond the last ones on the line through them
            const double stop = std::min(end, std::floor(begin + 1e-12 * from) + 1);
            int k = static_cast<int>(std::floor(0.5 * (begin + stop)));
            if (!periodic) k = std::clamp(k, 0, from - 2);
            const double share = (stop - begin) / width, t = 0.5 * (begin + stop) - k;
            parts.emplace_back(wrapped(k), share * (1 - t));
            parts.emplace_back(wrapped(k + 1), share * t);
            begin = stop;
        }
    }
    return all;
}

}  // namespace

void crop(Topography& t, int first_x, int first_y, int nx, int ny) {
    std::vector<double> part;
    part.reserve(static_cast<std::size_t>(nx) * static_cast<std::size_t>(ny));
    for (int j = first_y; j < first_y + ny; ++j) {
        const auto row =
            t.heights.begin() + static_cast<std::ptrdiff_t>(j) * static_cast<std::ptrdiff_t>(t.nx);
        part.insert(part.end(), row + first_x, row + first_x + nx);
    }
    t.heights = std::move(part);
    t.missing.clear();
    if (nx < t.nx || ny < t.ny) t.boundary = Boundary::Finite;
    t.nx = nx, t.ny = ny;
}

void resample(Topography& t, int nx, int ny) {
    const bool periodic = t.boundary == Boundary::Periodic;
    const auto old_nx = static_cast<std::size_t>(t.nx), new_nx = static_cast<std::size_t>(nx);
    const std::vector<Mixture> along_x = mixtures(t.nx, nx, periodic),
                               along_y = mixtures(t.ny, ny, periodic);
    std::vector<double> narrow(new_nx * static_cast<std::size_t>(t.ny));
    for (std::size_t j = 0; j < static_cast<std::size_t>(t.ny); ++j)
        for (std::size_t i = 0; i < new_nx; ++i)
            for (const auto& [k, weight] : along_x[i].parts)
                narrow[j * new_nx + i] +=
                    weight * t.heights[j * old_nx + static_cast<std::size_t>(k)];
    std::vector<double> heights(new_nx * static_cast<std::size_t>(ny));
    for (std::size_t j = 0; j < static_cast<std::size_t>(ny); ++j)
        for (const auto& [k, weight] : along_y[j].parts)
            for (std::size_t i = 0; i < new_nx; ++i)
                heights[j * new_nx + i] +=
                    weight * narrow[static_cast<std::size_t>(k) * new_nx + i];
    t.dx *= static_cast<double>(t.nx) / nx;
    t.dy *= static_cast<double>(t.ny) / ny;
    t.nx = nx, t.ny = ny;
    t.heights = std::move(heights);
    t.missing.clear();
}

}  // namespace asperity
