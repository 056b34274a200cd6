// SPDX-License-Identifier: Apache-2.0
#include <asperity/fit/residuals.h>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <limits>

namespace asperity::detail {
namespace {

constexpr double kAtEnd = 1e-4;  ///< of the range, and nearer to an end than that is at it
constexpr double kApart = 1e-3;  ///< of differences, in coordinates
constexpr double kFlat = 1e-9;   ///< of an axis of the correlations: along it nothing changes

using Vector = Eigen::Map<const Eigen::VectorXd>;

/// What is near the best values of those parameters that are not at an end: residuals r with the
/// weights that they have there, and their derivatives by the coordinates.
struct Surroundings {
    Eigen::MatrixXd first;  ///< J, [residual, parameter]
    Eigen::MatrixXd bend;   ///< sum over residuals of r d2r/dp dq
};

class Differences {
  public:
    Differences(const Residuals& residuals, const std::vector<double>& values,
                const std::vector<std::size_t>& inside)
        : residuals_(residuals), values_(values), inside_(inside) {
        for (const std::size_t k : inside) {
            const FreeParam& p = residuals.model().free[k];
            const double u = p.coordinate(values[k]);
            // As far to either side as the nearer end allows
            steps_.push_back(std::min({kApart, u - p.lowest(), p.highest() - u}));
        }
    }

    Surroundings around() const {
        const auto count = static_cast<Eigen::Index>(inside_.size());
        const Eigen::VectorXd here = at(0, 0, 0, 0);
        Surroundings s{Eigen::MatrixXd(here.size(), count), Eigen::MatrixXd(count, count)};
        for (std::size_t p = 0; p < inside_.size(); ++p) {
            const auto column = static_cast<Eigen::Index>(p);
            const Eigen::VectorXd above = at(p, 1, p, 0), below = at(p, -1, p, 0);
            s.first.col(column) = (above - below) / (2 * steps_[p]);
            s.bend(column, column) = here.dot(above - 2 * here + below) / (steps_[p] * steps_[p]);
            for (std::size_t q = 0; q < p; ++q) {
                const auto row = static_cast<Eigen::Index>(q);
                s.bend(row, column) = s.bend(column, row) =
                    here.dot(at(p, 1, q, 1) - at(p, 1, q, -1) - at(p, -1, q, 1) +
                             at(p, -1, q, -1)) /
                    (4 * steps_[p] * steps_[q]);
            }
        }
        return s;
    }

  private:
    /// The residuals some steps away along the axes of the p-th and the q-th parameter.
    Eigen::VectorXd at(std::size_t p, int steps_p, std::size_t q, int steps_q) const {
        std::vector<double> values = values_;
        const auto move = [&](std::size_t k, int steps) {
            if (steps == 0) return;
            const FreeParam& param = residuals_.model().free[inside_[k]];
            values[inside_[k]] =
                param.value(param.coordinate(values[inside_[k]]) + steps * steps_[k]);
        };
        move(p, steps_p);
        move(q, steps_q);
        const std::vector<double> r = residuals_.at(values);
        return Vector(r.data(), static_cast<Eigen::Index>(r.size()));
    }

    const Residuals& residuals_;
    const std::vector<double>& values_;
    const std::vector<std::size_t>& inside_;
    std::vector<double> steps_;
};

Eigen::DiagonalMatrix<double, Eigen::Dynamic> diagonal(const std::vector<double>& values) {
    return Vector(values.data(), static_cast<Eigen::Index>(values.size())).asDiagonal();
}

/// How the score J^T r, which the fit takes to zero, grows with the coordinates; weights that
/// follow the model grow with it.
Eigen::MatrixXd growth(const Residuals& residuals, const Surroundings& s,
                       const std::vector<double>& energy) {
    return s.first.transpose() * diagonal(residuals.growth(energy)) * s.first + s.bend;
}

/// Covariances of the score J^T r.
Eigen::MatrixXd score_of(const Residuals& residuals, const Eigen::MatrixXd& first,
                         double mean_square) {
    const FitData& data = residuals.data();
    if (!data.has_errors()) return mean_square * first.transpose() * first;
    if (!data.has_batches()) return first.transpose() * diagonal(residuals.noise()) * first;
    std::vector<std::vector<double>> columns;
    for (Eigen::Index k = 0; k < first.cols(); ++k)
        columns.emplace_back(first.col(k).begin(), first.col(k).end());
    const std::vector<double> scores = score_covariances(residuals, columns);
    return Eigen::Map<const Eigen::MatrixXd>(scores.data(), first.cols(), first.cols());
}

/// Whether a matrix is positive and has no axis along which nothing changes.
bool determined(const Eigen::MatrixXd& matrix) {
    if (!(matrix.diagonal().minCoeff() > 0)) return false;
    const Eigen::VectorXd scale = matrix.diagonal().cwiseSqrt().cwiseInverse();
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> axes(scale.asDiagonal() * matrix *
                                                              scale.asDiagonal());
    return axes.eigenvalues().minCoeff() > kFlat;
}

}  // namespace

void set_errors(const Residuals& residuals, Solution& solution) {
    const std::vector<FreeParam>& params = residuals.model().free;
    solution.errors.assign(params.size(), std::numeric_limits<double>::quiet_NaN());
    solution.at_end.assign(params.size(), false);
    std::vector<std::size_t> inside;
    for (std::size_t k = 0; k < params.size(); ++k) {
        const FreeParam& p = params[k];
        const double share =
            (p.coordinate(solution.values[k]) - p.lowest()) / (p.highest() - p.lowest());
        solution.at_end[k] = share < kAtEnd || share > 1 - kAtEnd;
        if (!solution.at_end[k]) inside.push_back(k);
    }
    if (inside.empty()) return;
    const Surroundings near = Differences(residuals, solution.values, inside).around();
    const Eigen::MatrixXd growth =
        detail::growth(residuals, near, residuals.energy(solution.values));
    if (!determined(growth)) return;
    const Eigen::MatrixXd inverse = growth.inverse();
    const auto dof = static_cast<double>(residuals.size() - residuals.params());
    const Eigen::MatrixXd score = score_of(residuals, near.first, solution.sum / dof);
    const Eigen::MatrixXd covariance = inverse * score * inverse;
    for (std::size_t j = 0; j < inside.size(); ++j) {
        const FreeParam& p = params[inside[j]];
        const double u = p.coordinate(solution.values[inside[j]]), step = 1e-4;
        const auto k = static_cast<Eigen::Index>(j);
        const double error = std::sqrt(covariance(k, k));
        // As wide as its range: the data do not tell
        if (!(error < p.highest() - p.lowest())) continue;
        solution.errors[inside[j]] = error * (p.value(u + step) - p.value(u - step)) / (2 * step);
    }
}

}  // namespace asperity::detail
