// SPDX-License-Identifier: Apache-2.0
#include <asperity/fit/verdict.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace asperity {
namespace {

constexpr double kWithinErrors = 1.5, kClose = 0.05, kRough = 0.15;

/// L1 beyond what the errors alone give.
double beyond_noise(const Fit& fit) {
    return std::sqrt(std::max(0.0, fit.mean_l1 * fit.mean_l1 - fit.mean_noise * fit.mean_noise));
}

/// A share in words, to two digits: "0.52 %", "37 %", "100 %", "more than 100 %".
std::string percent(double share) {
    constexpr double kRoundsToMore = 1.005, kWhole = 0.0995;
    if (share >= kRoundsToMore) return "more than 100 %";
    return share >= kWhole ? fmt::format("{:.0f} %", 100 * share)
                           : fmt::format("{:.2g} %", 100 * share);
}

std::string with_misfit(const Fit& fit) {
    std::string text = fmt::format("{} (L1 of f cos {}", fit.text, percent(fit.mean_l1));
    if (!std::isnan(fit.chi2_per_dof)) text += ", chi2/dof " + figure_of(fit.chi2_per_dof, 3);
    return text + ")";
}

/// Those of a grade, "a (...), b (...) and c (...)".
std::string list(const std::vector<const Fit*>& fits) {
    std::string text;
    for (std::size_t k = 0; k < fits.size(); ++k)
        text += (k == 0 ? "" : k + 1 < fits.size() ? ", " : " and ") + with_misfit(*fits[k]);
    return text;
}

}  // namespace

std::string figure_of(double value, int digits) {
    constexpr double kFromHereDigitsStayWhole = 1e3, kUnreadable = 1e9;
    return value >= kFromHereDigitsStayWhole && value < kUnreadable
               ? fmt::format("{:.0f}", value)
               : fmt::format("{:.{}g}", value, digits);
}

FitGrade grade(const Fit& fit) {
    if (fit.chi2_per_dof <= kWithinErrors) return FitGrade::WithinErrors;
    const double off = beyond_noise(fit);
    return off <= kClose ? FitGrade::Close : off <= kRough ? FitGrade::Rough : FitGrade::No;
}

std::string verdict_of(const std::vector<Fit>& fits) {
    if (fits.empty()) return "no model was fitted";
    const FitGrade best = grade(fits.front());
    if (best == FitGrade::Rough)
        return "no model of the list describes the data; the nearest: " + with_misfit(fits.front());
    if (best == FitGrade::No)
        return "no model of the list describes the data, not even roughly; the nearest: " +
               with_misfit(fits.front());
    std::vector<const Fit*> good, others;
    for (const Fit& fit : fits) (grade(fit) == best ? good : others).push_back(&fit);
    std::string text =
        best == FitGrade::WithinErrors ? "as good as the data: " : "close to the data";
    if (best == FitGrade::Close)
        text += std::isnan(fits.front().chi2_per_dof) ? ": " : ", not within their errors: ";
    text += list(good);
    if (!others.empty()) text += fmt::format("; not {}", list(others));
    return text;
}

}  // namespace asperity
