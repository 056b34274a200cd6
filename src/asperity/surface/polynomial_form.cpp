// SPDX-License-Identifier: Apache-2.0
#include <asperity/surface/polynomial_form.h>

#include <asperity/surface/blocks.h>

#include <Eigen/Dense>

#include <array>

namespace asperity {

namespace {

constexpr int kMost = 10;  // products of Legendre polynomials of total degree 3
using Basis = std::array<double, kMost>;

int basis_size(int order) {
    return (order + 1) * (order + 2) / 2;
}

std::array<double, 4> legendre(double t) {
    return {1, t, 1.5 * t * t - 0.5, t * (2.5 * t * t - 1.5)};
}

/// By total degree, so that a lower order is a beginning of it.
Basis basis_at(double u, double v, int order) {
    const auto pu = legendre(u), pv = legendre(v);
    Basis basis{};
    std::size_t k = 0;
    for (int degree = 0; degree <= order; ++degree)
        for (int b = 0; b <= degree; ++b)
            basis[k++] = pu[static_cast<std::size_t>(degree - b)] * pv[static_cast<std::size_t>(b)];
    return basis;
}

/// Normal equations.
struct NormalSums {
    std::array<double, kMost * kMost> products{};
    Basis heights{};

    void add(const Basis& basis, double height, std::size_t size) {
        for (std::size_t a = 0; a < size; ++a) {
            heights[a] += basis[a] * height;
            for (std::size_t b = 0; b <= a; ++b) products[a * kMost + b] += basis[a] * basis[b];
        }
    }
    NormalSums& operator+=(const NormalSums& other) {
        for (std::size_t k = 0; k < products.size(); ++k) products[k] += other.products[k];
        for (std::size_t k = 0; k < heights.size(); ++k) heights[k] += other.heights[k];
        return *this;
    }
};

}  // namespace

PolynomialForm::PolynomialForm(const Topography& t, int order, const Run& run)
    : nx_(t.nx), ny_(t.ny), order_(order), dx_(t.dx), dy_(t.dy) {
    const auto nx = static_cast<std::size_t>(t.nx);
    const auto gone = [&](std::size_t k) { return !t.missing.empty() && t.missing[k] == 1; };
    // Heights are counted from one of them, so that a far offset costs no digits
    for (std::size_t k = 0; k < t.heights.size(); ++k)
        if (!gone(k)) {
            origin_ = t.heights[k];
            break;
        }
    const auto size = static_cast<std::size_t>(basis_size(order));
    const auto sums = sum_rows<NormalSums>(t.ny, run.threads(), [&](NormalSums& part, int j) {
        throw_if_stopped(run);
        for (std::size_t i = 0; i < nx; ++i) {
            const std::size_t k = static_cast<std::size_t>(j) * nx + i;
            if (!gone(k))
                part.add(basis_at(u(static_cast<int>(i)), v(j), order), t.heights[k] - origin_,
                         size);
        }
    });
    const auto n = static_cast<Eigen::Index>(size);
    Eigen::MatrixXd matrix(n, n);
    Eigen::VectorXd right(n);
    for (Eigen::Index a = 0; a < n; ++a) {
        right(a) = sums.heights[static_cast<std::size_t>(a)];
        for (Eigen::Index b = 0; b <= a; ++b)
            matrix(a, b) = matrix(b, a) = sums.products[static_cast<std::size_t>(a * kMost + b)];
    }
    const Eigen::VectorXd solution = matrix.completeOrthogonalDecomposition().solve(right);
    coefficients_.assign(solution.data(), solution.data() + n);
}

double PolynomialForm::at(int i, int j) const {
    const Basis basis = basis_at(u(i), v(j), order_);
    double height = origin_;
    for (std::size_t k = 0; k < coefficients_.size(); ++k) height += coefficients_[k] * basis[k];
    return height;
}

Slope PolynomialForm::slope() const {
    if (order_ == 0) return {};
    // d P1 / dt = 1 and d P3 / dt = -1.5 at t = 0; the terms are (1), (u, v), (uu, uv, vv), (uuu,
    // uuv, uvv, vvv), and P2 = -0.5 there
    double per_u = coefficients_[1], per_v = coefficients_[2];
    if (order_ == 3) {
        per_u += -1.5 * coefficients_[6] - 0.5 * coefficients_[8];
        per_v += -1.5 * coefficients_[9] - 0.5 * coefficients_[7];
    }
    return {per_u * 2 / ((nx_ - 1) * dx_), per_v * 2 / ((ny_ - 1) * dy_)};
}

}  // namespace asperity
