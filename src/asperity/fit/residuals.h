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
    const FitData& data() const { return data_; }

    /// By how much each residual falls where its energy in the data grows; 0 where a cube root has
    /// no slope.
    std::vector<double> slopes() const;

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

/// Covariances of J^T r by the errors of the data, which batches tell of all blocks of a layer at
/// once; `jacobian` [parameter][residual]. Of data that have batches.
std::vector<double> score_covariances(const Residuals& residuals,
                                      const std::vector<std::vector<double>>& jacobian);

/// Sets errors and at_end, with J by the parameters that are not at an end: square roots of the
/// diagonal of (J^T J)^-1 times noise + misfit, the mean squares of residuals that the data's
/// errors and the model's give. Where batches tell errors of blocks together, their part is (J^T
/// J)^-1 C (J^T J)^-1, C the covariance of J^T r (the sandwich of Huber 1967), and `noise` counts
/// for nothing.
struct MeanSquares {
    double noise = 1, misfit = 0;
};
void set_errors(const Residuals& residuals, Solution& solution, const MeanSquares& mean);

}  // namespace asperity::detail
