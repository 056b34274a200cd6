// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/core/error.h>
#include <asperity/core/parallel.h>
#include <asperity/core/run.h>

#include <algorithm>
#include <vector>

namespace asperity {

/// Throws Error(Stopped) once the user asked to stop; waits while the run is paused.
inline void throw_if_stopped(const Run& run) {
    if (!run.keep_going()) throw Error(ErrorCode::Stopped, "stopped");
}

/// Rows of a surface that a thread takes at a time: the stop is heard in between.
inline constexpr int kRowsPerBlock = 16;

/// Calls body(first, last) for [0, count) cut into blocks of `per_block`, on the threads of `run`.
///
/// Throws Error(Stopped) before the next block once the user asked to stop.
template <class Body>
void for_blocks(int count, int per_block, const Run& run, const Body& body) {
    const int blocks = (count + per_block - 1) / per_block;
    parallel_for(static_cast<std::size_t>(blocks), run.threads(), [&](std::size_t b) {
        throw_if_stopped(run);
        const int first = static_cast<int>(b) * per_block;
        body(first, std::min(first + per_block, count));
    });
}

/// Grows `values` to `count` zeros, a part at a time: to fault in gigabytes of memory takes
/// seconds.
///
/// Throws Error(Stopped) between parts, std::bad_alloc when there is not enough.
template <class Value>
void allocate(std::vector<Value>& values, std::size_t count, const Run& run) {
    constexpr std::size_t kPart = std::size_t{1} << 22;
    values.reserve(count);
    while (values.size() < count) {
        throw_if_stopped(run);
        values.resize(std::min(count, values.size() + kPart));
    }
}

/// Rows summed into one part of a sum: fixed, so that rounding does not depend on the threads.
inline constexpr int kRowsPerSum = 16;

/// Calls add_row(part, row) for every row and returns the sum of the parts, added in order of rows.
///
/// `Sum` starts as Sum{} and has operator+=. Each part covers `rows_per_part` rows, so the result
/// has the same bits for any number of threads.
template <class Sum, class AddRow>
Sum sum_rows(int rows, int threads, const AddRow& add_row, int rows_per_part = kRowsPerSum) {
    const int count = (rows + rows_per_part - 1) / rows_per_part;
    std::vector<Sum> parts(static_cast<std::size_t>(count));
    parallel_for(parts.size(), threads, [&](std::size_t p) {
        const int first = static_cast<int>(p) * rows_per_part;
        const int last = std::min(first + rows_per_part, rows);
        for (int row = first; row < last; ++row) add_row(parts[p], row);
    });
    Sum total{};
    for (const Sum& part : parts) total += part;
    return total;
}

/// Rows of a part when a part is large (a histogram): at most 16 parts, whatever the surface.
inline int rows_per_histogram(int rows) {
    return std::max(1, (rows + 15) / 16);
}

}  // namespace asperity
