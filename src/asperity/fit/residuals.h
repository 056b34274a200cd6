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

    /// Mean squares of the residuals by the errors of the data, blocks taken as independent and the
    /// channels of a ray as one. Of data that have errors.
    std::vector<double> noise() const;

    /// By how much a residual's part of the score J^T r grows with the parameters, over the square
    /// of its J, beside how J bends: less than 1 where the model, whose energies are given, expects
    /// more than there is and its weights follow it. For Chi2 it is data / model then, as in a
    /// likelihood of counts.
    std::vector<double> growth(const std::vector<double>& energy) const;

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
    /// What a ray weighs, for weights of Chi2: variance over energy of the whole layer. That of
    /// single blocks is known too badly, and so much of what a model misses would come and go.
    std::vector<double> ray_;
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

/// Sets errors and at_end, with J by the parameters that are not at an end. The fit takes the score
/// J^T r to zero; A is how it grows with the parameters, C its covariance by the errors of the
/// data: errors are square roots of the diagonal of A^-1 C A^-1 (the sandwich of Huber 1967).
/// Batches tell C, else Residuals::noise() does, and of data without errors the mean square of the
/// residuals. No error, NaN: at an end, or A is singular, or it were as wide as the range.
void set_errors(const Residuals& residuals, Solution& solution);

}  // namespace asperity::detail
