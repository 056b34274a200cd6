// SPDX-License-Identifier: Apache-2.0
#include <asperity/fit/residuals.h>

#include <Eigen/Dense>
#include <unsupported/Eigen/NonLinearOptimization>

#include <algorithm>
#include <cmath>

namespace asperity::detail {
namespace {

constexpr double kAtEnd = 1e-4;  ///< of the range, and nearer to an end than that is at it
constexpr int kMostSteps = 40;   ///< towards an end of a range the way is long and leads nowhere

/// The parameters between their ends as angles: value = middle + half the range times sin(angle).
class Ranges {
  public:
    explicit Ranges(const std::vector<FreeParam>& params) : params_(params) {}

    std::vector<double> values(const Eigen::VectorXd& angles) const {
        std::vector<double> values;
        for (std::size_t k = 0; k < params_.size(); ++k) {
            const FreeParam& p = params_[k];
            const double share = 0.5 * (1 + std::sin(angles[static_cast<Eigen::Index>(k)]));
            values.push_back(p.value(p.lowest() + share * (p.highest() - p.lowest())));
        }
        return values;
    }

    Eigen::VectorXd angles(const std::vector<double>& values) const {
        Eigen::VectorXd angles(static_cast<Eigen::Index>(values.size()));
        for (std::size_t k = 0; k < values.size(); ++k) {
            const double share = std::clamp(this->share(k, values[k]), 1e-3, 1 - 1e-3);
            angles[static_cast<Eigen::Index>(k)] = std::asin(2 * share - 1);
        }
        return angles;
    }

    double share(std::size_t k, double value) const {
        const FreeParam& p = params_[k];
        return (p.coordinate(value) - p.lowest()) / (p.highest() - p.lowest());
    }

  private:
    const std::vector<FreeParam>& params_;
};

/// What Eigen's solver asks for.
struct Functor {
    using Scalar = double;
    enum { InputsAtCompileTime = Eigen::Dynamic, ValuesAtCompileTime = Eigen::Dynamic };
    using InputType = Eigen::VectorXd;
    using ValueType = Eigen::VectorXd;
    using JacobianType = Eigen::MatrixXd;

    const Residuals& residuals;
    Ranges ranges;

    int inputs() const { return static_cast<int>(residuals.params()); }
    int values() const { return static_cast<int>(residuals.size()); }

    int operator()(const InputType& x, ValueType& out) const {
        const std::vector<double> r = residuals.at(ranges.values(x));
        out = Eigen::Map<const ValueType>(r.data(), static_cast<Eigen::Index>(r.size()));
        return 0;
    }

    int df(const InputType& x, JacobianType& jacobian) const {
        constexpr double kStep = 1e-5;
        ValueType here(values()), there(values());
        (*this)(x, here);
        for (Eigen::Index k = 0; k < x.size(); ++k) {
            InputType moved = x;
            moved[k] += kStep;
            (*this)(moved, there);
            jacobian.col(k) = (there - here) / kStep;
        }
        return 0;
    }
};

/// Derivatives of the residuals by the coordinates of those parameters that are not at an end.
Eigen::MatrixXd jacobian_of(const Residuals& residuals, const Solution& solution,
                            const std::vector<std::size_t>& inside) {
    const std::vector<FreeParam>& params = residuals.model().free;
    const auto rows = static_cast<Eigen::Index>(residuals.size());
    Eigen::MatrixXd jacobian(rows, static_cast<Eigen::Index>(inside.size()));
    for (std::size_t j = 0; j < inside.size(); ++j) {
        const FreeParam& p = params[inside[j]];
        const double u = p.coordinate(solution.values[inside[j]]);
        const double step = 1e-4 * std::min(1.0, p.highest() - p.lowest());
        const double low = std::max(u - step, p.lowest()), high = std::min(u + step, p.highest());
        std::vector<double> values = solution.values;
        values[inside[j]] = p.value(high);
        const std::vector<double> above = residuals.at(values);
        values[inside[j]] = p.value(low);
        const std::vector<double> below = residuals.at(values);
        using Vector = Eigen::Map<const Eigen::VectorXd>;
        jacobian.col(static_cast<Eigen::Index>(j)) =
            (Vector(above.data(), rows) - Vector(below.data(), rows)) / (high - low);
    }
    return jacobian;
}

/// Covariances of the coordinates by what batches tell of J^T r; `inverse` is (J^T J)^-1.
Eigen::MatrixXd sandwich(const Residuals& residuals, const Eigen::MatrixXd& jacobian,
                         const Eigen::MatrixXd& inverse) {
    std::vector<std::vector<double>> columns;
    for (Eigen::Index k = 0; k < jacobian.cols(); ++k)
        columns.emplace_back(jacobian.col(k).begin(), jacobian.col(k).end());
    const std::vector<double> scores = score_covariances(residuals, columns);
    return inverse *
           Eigen::Map<const Eigen::MatrixXd>(scores.data(), inverse.rows(), inverse.cols()) *
           inverse;
}

}  // namespace

Solution solve(const Residuals& residuals, const std::vector<double>& start, double precision) {
    Functor functor{residuals, Ranges(residuals.model().free)};
    Eigen::VectorXd x = functor.ranges.angles(start);
    Eigen::LevenbergMarquardt<Functor> solver(functor);
    solver.parameters.maxfev = kMostSteps;
    solver.parameters.xtol = 1e-6;
    solver.parameters.ftol = precision;
    solver.minimize(x);
    Solution solution;
    solution.values = functor.ranges.values(x);
    solution.sum = solver.fvec.squaredNorm();
    return solution;
}

void set_errors(const Residuals& residuals, Solution& solution, const MeanSquares& mean) {
    const std::vector<FreeParam>& params = residuals.model().free;
    const Ranges ranges(params);
    solution.errors.assign(params.size(), std::numeric_limits<double>::quiet_NaN());
    solution.at_end.assign(params.size(), false);
    std::vector<std::size_t> inside;
    for (std::size_t k = 0; k < params.size(); ++k) {
        const double share = ranges.share(k, solution.values[k]);
        solution.at_end[k] = share < kAtEnd || share > 1 - kAtEnd;
        if (!solution.at_end[k]) inside.push_back(k);
    }
    if (inside.empty()) return;
    const Eigen::MatrixXd jacobian = jacobian_of(residuals, solution, inside);
    const Eigen::MatrixXd square = jacobian.transpose() * jacobian;
    // Directions along which nothing changes leave the parameters that they touch open.
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> axes(square);
    constexpr double kFlat = 1e-12;
    if (!(axes.eigenvalues().minCoeff() > kFlat * axes.eigenvalues().maxCoeff())) return;
    const bool batches = residuals.data().has_batches();
    const Eigen::MatrixXd inverse = square.inverse();
    Eigen::MatrixXd covariance = inverse * (mean.misfit + (batches ? 0 : mean.noise));
    if (batches) covariance += sandwich(residuals, jacobian, inverse);
    for (std::size_t j = 0; j < inside.size(); ++j) {
        const FreeParam& p = params[inside[j]];
        const double x = solution.values[inside[j]], u = p.coordinate(x), step = 1e-4;
        const double slope = (p.value(u + step) - p.value(u - step)) / (2 * step);
        const auto k = static_cast<Eigen::Index>(j);
        solution.errors[inside[j]] = slope * std::sqrt(covariance(k, k));
    }
}

}  // namespace asperity::detail
