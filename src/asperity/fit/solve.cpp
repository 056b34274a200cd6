// SPDX-License-Identifier: Apache-2.0
#include <asperity/fit/residuals.h>

#include <Eigen/Dense>
#include <unsupported/Eigen/NonLinearOptimization>

#include <algorithm>
#include <cmath>

namespace asperity::detail {
namespace {

constexpr int kMostSteps = 40;  ///< towards an end of a range the way is long and leads nowhere

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

}  // namespace asperity::detail
