// SPDX-License-Identifier: Apache-2.0
#include <asperity/surface/power_spectrum.h>

#include <asperity/core/directions.h>
#include <asperity/surface/blocks.h>

#include <fmt/format.h>

#include <cmath>

namespace asperity {

namespace {

/// Transform of exp(-x^2 / length^2) sampled at the integers, over sqrt(pi) length, for the
/// frequencies k / n: by Poisson's summation the sum over m of exp(-(pi length (k / n + m))^2).
std::vector<double> gaussian_axis(double length, int n) {
    const int aliases = static_cast<int>(std::ceil(0.5 + 6.5 / (kPi * length)));
    std::vector<double> density;
    for (int k = 0; k <= n / 2; ++k) {
        double sum = 0;
        for (int m = -aliases; m <= aliases; ++m) {
            const double t = kPi * length * (static_cast<double>(k) / n + m);
            sum += std::exp(-t * t);
        }
        density.push_back(sum);
    }
    return density;
}

/// (k L)^2 for the wave numbers k = 2 pi m / n, length in samples.
std::vector<double> power_law_axis(double length, int n) {
    std::vector<double> squares;
    for (int m = 0; m <= n / 2; ++m) {
        const double t = 2 * kPi * m / n * length;
        squares.push_back(t * t);
    }
    return squares;
}

/// |exp(i k) - 1|^2 for k = 2 pi m / n: the power of the difference of two neighbours.
double difference_power(int m, int n) {
    const double s = 2 * std::sin(kPi * m / n);
    return s * s;
}

/// How many of the n frequencies share |m|: m and -m, but for zero and the highest of an even n.
double multiplicity(int m, int n) {
    return m == 0 || 2 * m == n ? 1.0 : 2.0;
}

}  // namespace

PowerSpectrum::PowerSpectrum(const PowerSpectrumSettings& s) : settings_(s) {
    const double rows = s.correlation_y / s.aspect;  // correlation length in samples along y
    if (s.autocorrelation == Autocorrelation::Gaussian) {
        x_ = gaussian_axis(s.correlation_x, s.nx);
        y_ = gaussian_axis(rows, s.ny);
    } else {
        x_ = power_law_axis(s.correlation_x, s.nx);
        y_ = power_law_axis(rows, s.ny);
        exponent_ = s.autocorrelation == Autocorrelation::Exponential ? -1.5 : -(1 + s.hurst);
    }
}

double PowerSpectrum::operator()(int kx, int ky) const {
    const double x = x_[static_cast<std::size_t>(std::min(kx, settings_.nx - kx))];
    const double y = y_[static_cast<std::size_t>(std::min(ky, settings_.ny - ky))];
    if (settings_.autocorrelation == Autocorrelation::Gaussian) return x * y;
    return std::pow(1 + x + y, exponent_);
}

PowerSpectrum::Variances& PowerSpectrum::Variances::operator+=(const Variances& other) {
    height += other.height;
    slope_x += other.slope_x;
    slope_y += other.slope_y;
    return *this;
}

PowerSpectrum::Variances PowerSpectrum::variances(const Run& run) const {
    const int nx = settings_.nx, ny = settings_.ny;
    const double aspect2 = settings_.aspect * settings_.aspect;
    const auto add_column = [&](Variances& sum, int kx) {
        throw_if_stopped(run);
        const double weight_x = multiplicity(kx, nx), difference_x = difference_power(kx, nx);
        for (int ky = kx == 0 ? 1 : 0; ky <= ny / 2; ++ky) {
            const double power = weight_x * multiplicity(ky, ny) * (*this)(kx, ky);
            sum.height += power;
            sum.slope_x += power * difference_x;
            sum.slope_y += power * difference_power(ky, ny) / aspect2;
        }
    };
    return sum_rows<Variances>(nx / 2 + 1, run.threads(), add_column);
}

double matching_correlation_y(const PowerSpectrumSettings& settings, double alpha_x, double alpha_y,
                              const Run& run) {
    // Excess of the slopes along y, falling with the correlation length along y.
    const auto excess = [&](double log_length) {
        PowerSpectrumSettings trial = settings;
        trial.correlation_y = std::exp(log_length);
        const auto v = PowerSpectrum(trial).variances(run);
        return 0.5 * std::log(v.slope_y / v.slope_x) - std::log(alpha_y / alpha_x);
    };
    double low = std::log(0.1), high = std::log(settings.ny * std::min(1.0, settings.aspect));
    double excess_low = excess(low), excess_high = excess(high);
    if (excess_low < 0 || excess_high > 0)
        throw Error(ErrorCode::Usage,
                    fmt::format("{} along x and {} along y cannot both be met with a correlation "
                                "length of {} cells along x on this size",
                                alpha_x, alpha_y, settings.correlation_x),
                    "alpha");
    // False position; an end that stays twice loses half its weight (Illinois rule)
    int last_side = 0;
    for (int step = 0; step < 60; ++step) {
        const double middle = (low * excess_high - high * excess_low) / (excess_high - excess_low);
        const double value = excess(middle);
        if (std::abs(value) < 1e-7) return std::exp(middle);
        const int side = value > 0 ? 1 : -1;
        if (side > 0) {
            low = middle;
            excess_low = value;
            if (last_side == side) excess_high *= 0.5;
        } else {
            high = middle;
            excess_high = value;
            if (last_side == side) excess_low *= 0.5;
        }
        last_side = side;
    }
    return std::exp(0.5 * (low + high));
}

}  // namespace asperity
