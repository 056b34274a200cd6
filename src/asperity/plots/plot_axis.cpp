// SPDX-License-Identifier: Apache-2.0
#include "plot_axis.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace asperity::studio {

namespace {

/// Rounding of values that should lie on a tick, as a share of the step.
constexpr double kSlack = 1e-6;

/// The first of ... 0.1, 0.2, 0.5, 1, 2, 5 ... not below `value` > 0.
double round_up_to_125(double value) {
    const double decade = std::pow(10.0, std::floor(std::log10(value)));
    for (const double step : {1.0, 2.0, 5.0})
        if (value <= step * decade * (1 + kSlack)) return step * decade;
    return 10 * decade;
}

QString superscript(int number) {
    static const QString digits = QStringLiteral("⁰¹²³⁴⁵⁶⁷⁸⁹");
    QString text = number < 0 ? QStringLiteral("⁻") : QString();
    for (const QChar digit : QString::number(std::abs(number))) text += digits[digit.digitValue()];
    return text;
}

QString power_of_ten(int exponent) {
    return QStringLiteral("10") + superscript(exponent);
}

QString rounded(double value, int digits) {
    if (!std::isfinite(value)) return QStringLiteral("∞");
    const double size = std::abs(value);
    if (size > 0 && (size < 1e-3 || size >= 1e5)) {
        const int exponent = static_cast<int>(std::floor(std::log10(size)));
        return QString::number(value / std::pow(10.0, exponent), 'f', digits - 1) +
               QStringLiteral("×") + power_of_ten(exponent);
    }
    return QString::number(value, 'g', digits).replace('-', QChar(0x2212));
}

std::vector<PlotTick> linear_ticks(const PlotAxis& axis, int count) {
    const double step =
        axis.step > 0 ? axis.step : round_up_to_125((axis.high - axis.low) / std::max(1, count));
    std::vector<PlotTick> ticks;
    const double first = std::ceil(axis.low / step - kSlack);
    for (double k = first; k * step <= axis.high + kSlack * step; ++k)
        ticks.push_back({k * step, number_label(k * step, step)});
    return ticks;
}

std::vector<PlotTick> log_ticks(const PlotAxis& axis, int count) {
    const int first = static_cast<int>(std::floor(std::log10(axis.low) + kSlack));
    const int last = static_cast<int>(std::ceil(std::log10(axis.high) - kSlack));
    const int stride = std::max(1, (last - first + count - 1) / std::max(1, count));
    std::vector<PlotTick> ticks;
    for (int decade = first; decade <= last; ++decade)
        for (int multiple = 1; multiple < 10; ++multiple) {
            const double value = multiple * std::pow(10.0, decade);
            if (value < axis.low * (1 - kSlack) || value > axis.high * (1 + kSlack)) continue;
            const bool labelled = multiple == 1 && (last - decade) % stride == 0;
            if (labelled)
                ticks.push_back({value, power_of_ten(decade)});
            else if (stride == 1)
                ticks.push_back({value, {}});
        }
    return ticks;
}

}  // namespace

double PlotAxis::position(double value) const {
    if (!log) return (value - low) / (high - low);
    if (!(value > 0)) return -std::numeric_limits<double>::infinity();
    return std::log(value / low) / std::log(high / low);
}

double PlotAxis::value_at(double position) const {
    return log ? low * std::pow(high / low, position) : low + position * (high - low);
}

std::vector<PlotTick> PlotAxis::ticks(int count) const {
    return log ? log_ticks(*this, count) : linear_ticks(*this, count);
}

PlotAxis axis_up_to(double top, bool log, double decades) {
    const double end = top > 0 && std::isfinite(top) ? top : 1.0;
    if (log) {
        const double high = std::pow(10.0, std::ceil(std::log10(end) - kSlack));
        return {{}, high * std::pow(10.0, -decades), high, true, 0};
    }
    // A fifth of a decade apart, so that a curve fills the height
    const double step = round_up_to_125(end / 5);
    return {{}, 0, step * std::ceil(end / step - kSlack), false, 0};
}

QString number_label(double value, double step) {
    if (std::abs(value) < kSlack * step) return QStringLiteral("0");
    const int digit = static_cast<int>(std::floor(std::log10(step) + kSlack));
    if (digit < -3 || digit > 4) {
        const int exponent = static_cast<int>(std::floor(std::log10(std::abs(value)) + kSlack));
        const double mantissa = value / std::pow(10.0, exponent);
        const int decimals = std::max(0, exponent - digit);
        return QString::number(mantissa, 'f', decimals) + QStringLiteral("×") +
               power_of_ten(exponent);
    }
    QString text = QString::number(value, 'f', std::max(0, -digit));
    return text.replace('-', QChar(0x2212));
}

QString value_text(double value) {
    return rounded(value, 4);
}

QString error_text(double error) {
    return rounded(error, 2);
}

}  // namespace asperity::studio
