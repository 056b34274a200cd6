// SPDX-License-Identifier: Apache-2.0
#include <asperity/surface/fill_missing.h>

#include <asperity/surface/blocks.h>
#include <asperity/surface/polynomial_form.h>

#include <Eigen/Sparse>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace asperity {

namespace {

std::size_t index(const Topography& t, int i, int j) {
    return static_cast<std::size_t>(j) * static_cast<std::size_t>(t.nx) +
           static_cast<std::size_t>(i);
}

bool gone(const Topography& t, std::size_t k) {
    return !t.missing.empty() && t.missing[k] == 1;
}

/// The middle one, the lower of two.
double median_of(std::vector<double>& values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>((values.size() - 1) / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

/// The measured heights among the 5 x 5 points around (i, j).
void neighbours(const Topography& t, int i, int j, std::vector<double>& heights) {
    constexpr int kReach = 2;
    heights.clear();
    for (int b = std::max(0, j - kReach); b <= std::min(t.ny - 1, j + kReach); ++b)
        for (int a = std::max(0, i - kReach); a <= std::min(t.nx - 1, i + kReach); ++a)
            if (const std::size_t k = index(t, a, b); !gone(t, k)) heights.push_back(t.heights[k]);
}

/// Of each measured point from the median around it; 0 where missing.
std::vector<double> differences(const Topography& t, const Run& run) {
    std::vector<double> all(t.heights.size());
    for_blocks(t.ny, kRowsPerBlock, run, [&](int first, int last) {
        std::vector<double> around;
        for (int j = first; j < last; ++j)
            for (int i = 0; i < t.nx; ++i) {
                const std::size_t k = index(t, i, j);
                if (gone(t, k)) continue;
                neighbours(t, i, j, around);
                all[k] = t.heights[k] - median_of(around);
            }
    });
    return all;
}

double deviation(const Topography& t, const std::vector<double>& differences) {
    constexpr double kOfMedian = 1.4826;  // the deviation of normal ones per their median size
    std::vector<double> sizes;
    double squares = 0;
    for (std::size_t k = 0; k < differences.size(); ++k) {
        if (gone(t, k)) continue;
        sizes.push_back(std::abs(differences[k]));
        squares += differences[k] * differences[k];
    }
    if (sizes.empty()) return 0;
    const double rms = std::sqrt(squares / static_cast<double>(sizes.size()));
    const double median = median_of(sizes);
    return median > 0 ? kOfMedian * median : rms;
}

/// For each place of a line the nearest of its sites, by the lower envelope of parabolas:
/// Felzenszwalb and Huttenlocher, "Distance transforms of sampled functions", Theory of Computing 8
/// (2012). `square` is the squared distance a site brings along, infinite for none.
std::vector<int> nearest_sites(const std::vector<double>& square, double step) {
    const int n = static_cast<int>(square.size());
    const auto value = [&](int s) { return square[static_cast<std::size_t>(s)]; };
    const auto crossing = [&](int a, int b) {
        const double xa = a * step, xb = b * step;
        return (value(b) + xb * xb - value(a) - xa * xa) / (2 * (xb - xa));
    };
    std::vector<int> sites;
    std::vector<double> from;
    for (int s = 0; s < n; ++s) {
        if (std::isinf(value(s))) continue;
        while (!sites.empty() && crossing(sites.back(), s) <= from.back()) {
            sites.pop_back();
            from.pop_back();
        }
        from.push_back(sites.empty() ? -std::numeric_limits<double>::infinity()
                                     : crossing(sites.back(), s));
        sites.push_back(s);
    }
    std::vector<int> nearest(square.size(), -1);
    std::size_t k = 0;
    for (int x = 0; x < n && !sites.empty(); ++x) {
        while (k + 1 < sites.size() && from[k + 1] < x * step) ++k;
        nearest[static_cast<std::size_t>(x)] = sites[k];
    }
    return nearest;
}

}  // namespace

std::size_t mark_outliers(Topography& t, double sigma, const Run& run) {
    const std::vector<double> far = differences(t, run);
    const double limit = sigma * deviation(t, far);
    std::vector<std::size_t> outliers;
    for (std::size_t k = 0; k < far.size(); ++k)
        if (std::abs(far[k]) > limit) outliers.push_back(k);
    for (const std::size_t k : outliers) t.mark_missing(k);
    return outliers.size();
}

void fill_nearest(Topography& t) {
    constexpr double kNone = std::numeric_limits<double>::infinity();
    // The nearest measured row in each column, then the nearest of the columns' in each row
    std::vector<int> row_of(t.heights.size(), -1);
    for (int i = 0; i < t.nx; ++i) {
        std::vector<double> square(static_cast<std::size_t>(t.ny));
        for (int j = 0; j < t.ny; ++j)
            square[static_cast<std::size_t>(j)] = gone(t, index(t, i, j)) ? kNone : 0;
        const std::vector<int> nearest = nearest_sites(square, t.dy);
        for (int j = 0; j < t.ny; ++j)
            row_of[index(t, i, j)] = nearest[static_cast<std::size_t>(j)];
    }
    for (int j = 0; j < t.ny; ++j) {
        std::vector<double> square(static_cast<std::size_t>(t.nx), kNone);
        for (int i = 0; i < t.nx; ++i)
            if (const int row = row_of[index(t, i, j)]; row >= 0)
                square[static_cast<std::size_t>(i)] = (row - j) * t.dy * ((row - j) * t.dy);
        const std::vector<int> nearest = nearest_sites(square, t.dx);
        for (int i = 0; i < t.nx; ++i) {
            const std::size_t k = index(t, i, j);
            const int column = nearest[static_cast<std::size_t>(i)];
            if (gone(t, k)) t.heights[k] = t.heights[index(t, column, row_of[index(t, column, j)])];
        }
    }
}

void fill_smooth(Topography& t, const Run& run) {
    const PolynomialForm plane(t, 1, run);
    fill_nearest(t);  // where the search for the film starts
    std::vector<int> unknown(t.heights.size(), -1);
    std::vector<Eigen::Triplet<double>> entries;
    int count = 0;
    for (std::size_t k = 0; k < unknown.size(); ++k)
        if (gone(t, k)) unknown[k] = count++;
    if (count == 0) return;
    const auto above_plane = [&](int i, int j) {
        return t.heights[index(t, i, j)] - plane.at(i, j);
    };
    Eigen::VectorXd right = Eigen::VectorXd::Zero(count), heights(count);
    const double along_x = t.dy / t.dx, along_y = t.dx / t.dy;
    for (int j = 0; j < t.ny; ++j) {
        throw_if_stopped(run);
        for (int i = 0; i < t.nx; ++i) {
            const int row = unknown[index(t, i, j)];
            if (row < 0) continue;
            heights(row) = above_plane(i, j);
            double sum = 0;
            const auto add = [&](int a, int b, double weight) {
                if (a < 0 || b < 0 || a >= t.nx || b >= t.ny) return;
                sum += weight;
                if (const int column = unknown[index(t, a, b)]; column >= 0)
                    entries.emplace_back(row, column, -weight);
                else
                    right(row) += weight * above_plane(a, b);
            };
            add(i - 1, j, along_x), add(i + 1, j, along_x);
            add(i, j - 1, along_y), add(i, j + 1, along_y);
            entries.emplace_back(row, row, sum);
        }
    }
    Eigen::SparseMatrix<double> matrix(count, count);
    matrix.setFromTriplets(entries.begin(), entries.end());
    Eigen::ConjugateGradient<Eigen::SparseMatrix<double>, Eigen::Lower | Eigen::Upper,
                             Eigen::IncompleteCholesky<double>>
        solver;
    solver.setTolerance(1e-12);
    solver.compute(matrix);
    const Eigen::VectorXd film = solver.solveWithGuess(right, heights);
    for (int j = 0; j < t.ny; ++j)
        for (int i = 0; i < t.nx; ++i)
            if (const int row = unknown[index(t, i, j)]; row >= 0)
                t.heights[index(t, i, j)] = film(row) + plane.at(i, j);
}

}  // namespace asperity
