// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/fit/fit.h>

#include <string>
#include <vector>

namespace asperity {

/// How well a model describes data.
enum class FitGrade {
    WithinErrors,  ///< chi2/dof at most 1.5: no better model can be told from the data
    Close,         ///< not that, but L1 of f cos beyond the noise at most 5 %
    Rough,         ///< at most 15 %
    No,            ///< worse
};
FitGrade grade(const Fit& fit);

/// A sentence or two on fits, best first: whether one describes the data, and which do not.
std::string verdict_of(const std::vector<Fit>& fits);

/// A figure to so many digits, without an exponent from a thousand to a thousand millions:
/// "1.04", "12345".
std::string figure_of(double value, int digits);

}  // namespace asperity
