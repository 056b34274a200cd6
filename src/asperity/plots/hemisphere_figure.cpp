// SPDX-License-Identifier: Apache-2.0
#include <asperity/plots/figures.h>

#include <asperity/core/directions.h>
#include <asperity/core/error.h>
#include <asperity/core/index.h>
#include <asperity/measured/compare.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace asperity::plots::detail {

namespace {

constexpr int kModelResolution = 180;  ///< columns where no measurement gives a detector
constexpr double kEnoughNoise = 0.03;  ///< that needs no more averaging
constexpr double kHelps = 0.8;         ///< noise that averaging twice as wide must leave at most
constexpr double kMostColumns = 8;

/// Columns that a cell is averaged over, in this row: cells as wide as at the horizon, `columns` of
/// those.
int window(const Detector& detector, int row, double columns) {
    const double wide = columns / std::sin(detector.theta_centre(row));
    return std::clamp(static_cast<int>(std::lround(wide)), 1, detector.columns());
}

/// Sums over the window of each column of a row; the window of column k begins at k - wide / 2.
std::vector<double> sums_over(const std::vector<double>& values, int row, int count, int wide) {
    const auto at = [&](int column) {
        return values[index(row * count + (column % count + count) % count)];
    };
    std::vector<double> sums;
    double sum = 0;
    int lit = 0;  // a sum of nothing is exactly 0, whatever was added and taken away
    for (int k = 0; k < wide; ++k) {
        sum += at(k - wide / 2);
        lit += at(k - wide / 2) != 0;
    }
    for (int column = 0; column < count; ++column) {
        sums.push_back(lit > 0 ? std::max(0.0, sum) : 0.0);
        const double next = at(column - wide / 2 + wide), first = at(column - wide / 2);
        sum += next - first;
        lit += (next != 0) - (first != 0);
    }
    return sums;
}

/// Means over windows of columns and, where these are wider than one at the horizon, of as many
/// rows as make them square, by projected solid angle. Rows beyond the pole lie on its other side.
HemisphereValues averaged(const HemisphereValues& from, double columns) {
    HemisphereValues to = from;
    const Detector& detector = from.detector;
    const int count = detector.columns(), rows = detector.rows();
    const int half = static_cast<int>(std::lround(columns)) - 1;
    std::vector<double> variances;
    for (const double error : from.errors) variances.push_back(error * error);
    for (int row = 0; row < rows; ++row) {
        const int wide = window(detector, row, columns);
        std::vector<double> sum(index(count)), variance(index(count));
        double weights = 0;
        for (int other = row - half; other <= std::min(rows - 1, row + half); ++other) {
            const int mirrored = other < 0 ? -1 - other : other;
            const int turned = other < 0 ? count / 2 : 0;
            if (mirrored >= rows) continue;
            const double weight = detector.projected_solid_angle(mirrored);
            weights += weight;
            const std::vector<double> values = sums_over(from.values, mirrored, count, wide);
            for (int column = 0; column < count; ++column)
                sum[index(column)] += weight * values[index((column + turned) % count)];
            if (variances.empty()) continue;
            const std::vector<double> squares = sums_over(variances, mirrored, count, wide);
            for (int column = 0; column < count; ++column)
                variance[index(column)] +=
                    weight * weight * squares[index((column + turned) % count)];
        }
        for (int column = 0; column < count; ++column) {
            const std::size_t cell = index(row * count + column);
            to.values[cell] = sum[index(column)] / (weights * wide);
            if (!to.errors.empty())
                to.errors[cell] = std::sqrt(variance[index(column)]) / (weights * wide);
        }
    }
    return to;
}

/// How much a cell is off, as a share, the mean by the light that it reflects: its standard error,
/// or how it differs from the middle of its neighbours in theta, whichever is more. What the facets
/// of a small surface do, no error of the rays knows.
double noise_of(const HemisphereValues& of) {
    double errors = 0, grain = 0, sum = 0;
    const int count = of.detector.columns();
    for (int row = 1; row + 1 < of.detector.rows(); ++row)
        for (int column = 0; column < count; ++column) {
            const std::size_t cell = index(row * count + column);
            const double angle = of.detector.projected_solid_angle(row);
            const double middle =
                0.5 * (of.values[cell - index(count)] + of.values[cell + index(count)]);
            // Of independent values this difference is sqrt(3 / 2) times as large as their errors
            grain += std::abs(of.values[cell] - middle) * angle / std::sqrt(1.5);
            sum += of.values[cell] * angle;
            if (!of.errors.empty() && std::isfinite(of.errors[cell]))
                errors += of.errors[cell] * angle;
        }
    return sum > 0 ? std::max(errors, grain) / sum : 0;
}

/// Columns at the horizon to average over, so that none of the hemispheres is noisier than people
/// like; no more where that does not help.
double columns_for(const std::vector<HemisphereValues>& raw) {
    double columns = 1;
    for (const HemisphereValues& values : raw) {
        double noise = noise_of(averaged(values, columns));
        while (noise > kEnoughNoise && 2 * columns <= kMostColumns) {
            const double wider = noise_of(averaged(values, 2 * columns));
            if (wider > kHelps * noise) break;
            noise = wider;
            columns *= 2;
        }
    }
    return columns;
}

HemisphereValues values_of_model(const LitSubject& lit, int channel, const Detector& detector,
                                 bool isotropic, int threads) {
    const CellAverages averages = average_over_cells(
        *lit.subject->model, detector, lit.light.theta_i, lit.light.phi_i, isotropic, threads);
    HemisphereValues values;
    values.detector = detector;
    const int channels = lit.subject->model->channels();
    for (int cell = 0; cell < detector.cells(); ++cell) {
        double energy = 0;
        for (int c = 0; c < channels; ++c)
            if (channel < 0 || channel == c)
                energy += averages.energy[index(c * detector.cells() + cell)];
        const double mean = channel < 0 ? energy / channels : energy;
        values.values.push_back(mean / detector.projected_solid_angle(cell / detector.columns()));
    }
    return values;
}

/// The largest f, the brightest cells left out that carry a thousandth of the energy together.
double brightest(const HemisphereValues& of) {
    constexpr double kLeftOut = 1e-3;
    std::vector<int> cells(of.values.size());
    std::iota(cells.begin(), cells.end(), 0);
    std::sort(cells.begin(), cells.end(),
              [&](int a, int b) { return of.values[index(a)] > of.values[index(b)]; });
    const auto energy = [&](int cell) {
        return of.values[index(cell)] *
               of.detector.projected_solid_angle(cell / of.detector.columns());
    };
    double total = 0, left_out = 0;
    for (const int cell : cells) total += energy(cell);
    for (const int cell : cells) {
        left_out += energy(cell);
        if (left_out > kLeftOut * total) return of.values[index(cell)];
    }
    return 0;
}

}  // namespace

Hemispheres hemispheres_of(const Subjects& subjects, const PlotSettings& settings, Run& run) {
    Hemispheres result;
    result.lit = lit_subjects(subjects, settings);
    const LitSubject* measured = first_measured(result.lit);
    DetectorSettings own;
    own.resolution = kModelResolution;
    const Detector detector =
        measured != nullptr ? measured->subject->measurement->detector : Detector(own);
    const bool isotropic =
        measured != nullptr && measured->subject->measurement->experiment.illumination.isotropic;
    std::vector<HemisphereValues> raw;
    for (const LitSubject& one : result.lit) {
        if (!run.keep_going()) throw Error(ErrorCode::Stopped, "stopped");
        if (one.layer != nullptr)
            raw.push_back(hemisphere_values(*one.subject->measurement, *one.layer,
                                            channel_of(*one.subject->measurement, settings)));
        else
            raw.push_back(values_of_model(one, channel_of(*one.subject->model, subjects, settings),
                                          detector, isotropic, run.threads()));
        raw.back().name = one.name;
        raw.back().theta_i = one.light.theta_i;
        raw.back().phi_i = one.light.phi_i;
    }
    if (measured == nullptr) {
        result.values = std::move(raw);
        return result;
    }
    const double columns = settings.average > 0 ? settings.average : columns_for(raw);
    for (const HemisphereValues& values : raw) result.values.push_back(averaged(values, columns));
    result.note = "Near the pole, cells are averaged over columns";
    if (columns > 1)
        result.note = fmt::format("Means over {:.3g}° by {:.3g}° about each cell{}",
                                  columns * 360.0 / detector.columns(),
                                  (2 * std::round(columns) - 1) * 90.0 / detector.rows(),
                                  settings.average == 0 ? ", for the noise" : "");
    return result;
}

io::ValueScale scale_of(const std::vector<HemisphereValues>& values, bool log, double decades) {
    double most = 0, largest = 0;
    for (const HemisphereValues& of : values) {
        most = std::max(most, brightest(of));
        for (const double value : of.values) largest = std::max(largest, value);
    }
    const PlotAxis axis = axis_up_to(most, log, decades);
    io::ValueScale scale;
    scale.scale = log ? io::Scale::Log : io::Scale::Linear;
    // The first 1, 2 or 5 times a power of ten
    const double decade = most > 0 ? std::pow(10.0, std::floor(std::log10(most))) : 1;
    scale.high = axis.high;
    for (const double step : {10.0, 5.0, 2.0, 1.0})
        if (log && most > 0 && most <= step * decade * (1 + 1e-9)) scale.high = step * decade;
    scale.low = log ? scale.high * std::pow(10.0, -decades) : 0;
    scale.clipped = largest > scale.high * (1 + 1e-9);
    return scale;
}

PlotPointer hemisphere_figure(const Subjects& subjects, const PlotSettings& settings, Run& run) {
    Hemispheres hemispheres = hemispheres_of(subjects, settings, run);
    HemispherePlot::Data data;
    data.title = title_of(hemispheres.lit, settings);
    data.note = hemispheres.note;
    data.scale = scale_of(hemispheres.values, is_log(settings), settings.decades);
    data.discs = std::move(hemispheres.values);
    data.colour_map = settings.colour_map;
    return std::make_shared<HemispherePlot>(std::move(data));
}

}  // namespace asperity::plots::detail
