// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/formats/heights/binary_view.h>
#include <asperity/formats/heights/heights_source.h>

#include <algorithm>
#include <cmath>

namespace asperity::io {

/// How numbers in a file become heights in metres.
struct GridNumbers {
    NumberType type = NumberType::F32;
    bool big_endian = false;
    std::uint64_t at = 0;         ///< first byte
    std::uint64_t row_bytes = 0;  ///< from row to row; 0: rows without gaps
    double scale = 1, offset = 0;
};

/// Rows of numbers, the first on top, as heights scale * number + offset. `missing(number)` and
/// numbers that are not finite mark missing points. Bytes are compared with the size before.
template <typename Missing>
Topography read_grid(const HeightsSource& source, const BinaryView& view, std::uint64_t nx,
                     std::uint64_t ny, const GridNumbers& numbers, Missing&& missing) {
    check_sides(nx, ny, source.path());
    const std::uint64_t size = size_of(numbers.type);
    const std::uint64_t row_bytes = numbers.row_bytes == 0 ? nx * size : numbers.row_bytes;
    view.need(numbers.at, (ny - 1) * row_bytes + nx * size);
    Topography t = empty_topography(nx, ny, source.path());
    source.for_each_row(t.ny, [&](int j) {
        const auto row = static_cast<std::size_t>(j);
        for (std::size_t i = 0; i < nx; ++i) {
            const double number = number_at(
                view, numbers.type, numbers.at + row * row_bytes + i * size, numbers.big_endian);
            const std::size_t k = row * static_cast<std::size_t>(nx) + i;
            if (!std::isfinite(number) || missing(number))
                t.mark_missing(k);
            else
                t.heights[k] = number * numbers.scale + numbers.offset;
        }
    });
    return t;
}

inline bool never_missing(double) {
    return false;
}

/// Turns the rows of a file whose first one lies at the bottom.
inline void turn_rows(Topography& t) {
    const auto nx = static_cast<std::ptrdiff_t>(t.nx);
    const auto turn = [&](auto& samples) {
        if (samples.empty()) return;
        for (std::ptrdiff_t j = 0, k = t.ny - 1; j < k; ++j, --k)
            std::swap_ranges(samples.begin() + j * nx, samples.begin() + (j + 1) * nx,
                             samples.begin() + k * nx);
    };
    turn(t.heights);
    turn(t.missing);
}

}  // namespace asperity::io
