// SPDX-License-Identifier: Apache-2.0
#include <asperity/plots/plot_axis.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>

namespace asperity::plots {

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

std::string superscript(int number) {
    constexpr std::array kDigits = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
    std::string text = number < 0 ? "⁻" : "";
    for (const char digit : std::to_string(std::abs(number)))
        text += kDigits[static_cast<std::size_t>(digit - '0')];
    return text;
}

std::string power_of_ten(int exponent) {
    return "10" + superscript(exponent);
}

/// With a minus sign in place of the hyphen.
std::string with_minus(const std::string& number) {
    std::string text;
    for (const char c : number) text += c == '-' ? std::string("−") : std::string(1, c);
    return text;
}

std::string rounded(double value, int digits) {
    if (!std::isfinite(value)) return "∞";
    const double size = std::abs(value);
    if (size > 0 && (size < 1e-3 || size >= 1e5)) {
        const int exponent = static_cast<int>(std::floor(std::log10(size)));
        return with_minus(fmt::format("{:.{}f}", value / std::pow(10.0, exponent), digits - 1)) +
               "×" + power_of_ten(exponent);
    }
    return with_minus(fmt::format("{:.{}g}", value, digits));
}

/// Parts that the step between labels is cut into by short marks: at round numbers.
int parts_of(double step) {
    const double lead = step / std::pow(10.0, std::floor(std::log10(step) + kSlack));
    for (const double of_three : {1.5, 3.0, 4.5, 9.0})
        if (std::abs(lead - of_three) < kSlack) return 3;
    return std::abs(lead - 2) < kSlack ? 4 : 5;
}

std::vector<PlotTick> linear_ticks(const PlotAxis& axis, int count) {
    const double step =
        axis.step > 0 ? axis.step : round_up_to_125((axis.high - axis.low) / std::max(1, count));
    std::vector<PlotTick> ticks;
    const double first = std::ceil(axis.low / step - kSlack);
    const int parts = parts_of(step);
    for (double k = first - 1; k * step <= axis.high + kSlack * step; ++k)
        for (int part = 0; part < parts; ++part) {
            const double value = (k + static_cast<double>(part) / parts) * step;
            if (value < axis.low - kSlack * step || value > axis.high + kSlack * step) continue;
            ticks.push_back({value, part == 0 ? number_label(value, step) : std::string()});
        }
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
            else if (stride == 1 || multiple == 1)
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
        // A power of ten, or twice one: no empty decade above the values
        const double decade = std::pow(10.0, std::ceil(std::log10(end) - kSlack));
        const double high = end <= 0.2 * decade * (1 + kSlack) ? 0.2 * decade : decade;
        return {{}, high * std::pow(10.0, -decades), high, true, 0};
    }
    // A fifth of a decade apart, so that a curve fills the height
    const double step = round_up_to_125(end / 5);
    return {{}, 0, step * std::ceil(end / step - kSlack), false, 0};
}

PlotAxis axis_between(double low, double high) {
    if (!(high > low)) return {{}, low - 1, low + 1, false, 0};
    const double step = round_up_to_125((high - low) / 10);
    return {{}, step * std::floor(low / step + kSlack), step * std::ceil(high / step - kSlack)};
}

std::string number_label(double value, double step) {
    if (std::abs(value) < kSlack * step) return "0";
    const int digit = static_cast<int>(std::floor(std::log10(step) + kSlack));
    if (digit < -3 || digit > 4) {
        const int exponent = static_cast<int>(std::floor(std::log10(std::abs(value)) + kSlack));
        const double mantissa = value / std::pow(10.0, exponent);
        const int decimals = std::max(0, exponent - digit);
        return with_minus(fmt::format("{:.{}f}", mantissa, decimals)) + "×" +
               power_of_ten(exponent);
    }
    return with_minus(fmt::format("{:.{}f}", value, std::max(0, -digit)));
}

std::string value_text(double value) {
    return rounded(value, 4);
}

std::string error_text(double error) {
    return rounded(error, 2);
}

}  // namespace asperity::plots
