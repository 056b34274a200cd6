// SPDX-License-Identifier: Apache-2.0
#pragma once

// What a fit squares and sums; inside this folder only.

#include <asperity/fit/fit.h>

#include <vector>

namespace asperity::detail {

/// Differences of data and model, weighted, a value a block and channel.
class Residuals {
  public:
    Residuals(const FitData& data, const FreeModel& model, FitMetric metric, int threads);

    std::size_t size() const { return data_.energy.size(); }
    std::size_t params() const { return model_.free.size(); }
    const FreeModel& model() const { return model_; }

    /// For Chi2: variances from now on as a model of these energies expects them. Before, residuals
    /// are those of Freeman and Tukey 1950, sqrt(n) + sqrt(n + 1) - sqrt(4 m + 1) for n rays where
    /// m are expected: of unit variance without knowing m, and no wrong model goes far astray.
    void expect(const std::vector<double>& energy);

    /// At these values of the parameters, or for these energies of a model.
    std::vector<double> at(const std::vector<double>& values) const;
    std::vector<double> of_energy(const std::vector<double>& energy) const;
    std::vector<double> energy(const std::vector<double>& values) const;

  private:
    const FitData& data_;
    const FreeModel& model_;
    FitMetric metric_;
    int threads_;
    bool counts_ = false;  ///< residuals of numbers of rays
    std::vector<double> weights_;
    std::vector<double> shown_;  ///< the data as the metric sees them
};

/// Chi-square over degrees of freedom of a model of these energies; NaN without errors.
double chi2_per_dof(const FitData& data, const std::vector<double>& energy, std::size_t params);

/// Every fourth block of the data, for a first search.
FitData every_fourth(const FitData& data);

/// Values of the parameters that make the residuals small.
struct Solution {
    std::vector<double> values, errors;
    std::vector<bool> at_end;
    double sum = 0;  ///< of squares
};

/// From `start`, by Levenberg and Marquardt. Ranges are kept by a sine between their ends (F.
/// James, MINUIT). Ends when a step changes the sum by less than `precision` of it. Errors are not
/// set.
Solution solve(const Residuals& residuals, const std::vector<double>& start, double precision);

/// Sets errors and at_end: the square roots of the diagonal of (J^T J)^-1, with J by the parameters
/// that are not at an end, times `scale`.
void set_errors(const Residuals& residuals, Solution& solution, double scale);

}  // namespace asperity::detail
