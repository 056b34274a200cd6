// SPDX-License-Identifier: Apache-2.0
#include <asperity/core/directions.h>
#include <asperity/core/error.h>
#include <asperity/core/parallel.h>
#include <asperity/formats/bsdfs/angle_table.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace asperity::io {
namespace {

constexpr double kSame = 1e-9;              ///< angles that differ by less are one [rad]
constexpr double kGrazing = radians(89.5);  ///< f at the horizon is taken from here

/// Unit vectors across the mirror direction of `wi`: towards the normal, and the third.
struct SpecularFrame {
    Vec3 mirror, up, side;

    explicit SpecularFrame(Vec3 wi) : mirror{-wi.x, -wi.y, wi.z} {
        const double s = std::hypot(mirror.x, mirror.y);
        // At normal incidence, the limit for light from azimuth 0, or of where it comes from.
        const double c = s > 0 ? mirror.x / s : -1, n = s > 0 ? mirror.y / s : 0;
        up = {-mirror.z * c, -mirror.z * n, s};
        side = cross(mirror, up);
    }
};

/// A place between two nodes of a list: index of the lower one and share of the upper one.
struct Place {
    std::size_t low = 0, high = 0;
    double share = 0;
};

Place place_in(const std::vector<double>& nodes, double x) {
    if (x <= nodes.front()) return {0, 0, 0};
    if (x >= nodes.back()) return {nodes.size() - 1, nodes.size() - 1, 0};
    const auto above = std::upper_bound(nodes.begin(), nodes.end(), x);
    const auto high = static_cast<std::size_t>(above - nodes.begin());
    return {high - 1, high, (x - nodes[high - 1]) / (nodes[high] - nodes[high - 1])};
}

/// The same around a circle: beyond the last node comes the first one.
Place place_around(const std::vector<double>& nodes, double x) {
    if (nodes.size() == 1) return {};
    const double first = nodes.front(), gap = first + 2 * kPi - nodes.back();
    x = first + std::fmod(std::fmod(x - first, 2 * kPi) + 2 * kPi, 2 * kPi);
    if (x < nodes.back() || gap < kSame) return place_in(nodes, x);
    return {nodes.size() - 1, 0, (x - nodes.back()) / gap};
}

class TableBsdf final : public CosineSampledBsdf {
  public:
    TableBsdf(AngleTable table, std::string name)
        : table_(std::move(table)), name_(std::move(name)) {}

    int channels() const override { return table_.channels; }
    std::vector<std::string> channel_names() const override {
        return table_.channel_names.empty() ? Bsdf::channel_names() : table_.channel_names;
    }
    std::string name() const override { return name_; }
    bool isotropic() const override { return table_.phi_i.size() == 1; }
    std::vector<double> incident_angles() const override { return table_.theta_i; }

    void eval(Vec3 wi, Vec3 wo, std::span<double> f) const override {
        std::fill(f.begin(), f.end(), 0.0);
        if (wi.z <= 0 || wo.z <= 0) return;
        double polar = 0, turn = 0;
        if (table_.frame == AngleFrame::Normal) {
            polar = polar_angle(wo);
            turn = asperity::azimuth(wo) - asperity::azimuth(wi) - table_.azimuth_zero;
        } else {
            const SpecularFrame frame(wi);
            const double x = dot(wo, frame.up), y = dot(wo, frame.side);
            polar = std::atan2(std::hypot(x, y), dot(wo, frame.mirror));
            turn = std::atan2(y, x);
        }
        if (polar > table_.polar.back() + kSame) return;
        if (table_.mirrored) turn = std::abs(std::remainder(turn, 2 * kPi));
        const Place p = place_in(table_.polar, polar);
        const Place a =
            table_.mirrored ? place_in(table_.azimuth, turn) : place_around(table_.azimuth, turn);
        const Place t = place_in(table_.theta_i, polar_angle(wi));
        const Place phi = place_around(table_.phi_i, azimuth(wi));
        add(f, phi.low, t.low, (1 - phi.share) * (1 - t.share), p, a);
        add(f, phi.low, t.high, (1 - phi.share) * t.share, p, a);
        add(f, phi.high, t.low, phi.share * (1 - t.share), p, a);
        add(f, phi.high, t.high, phi.share * t.share, p, a);
    }

  private:
    void add(std::span<double> f, std::size_t phi, std::size_t theta, double weight, const Place& p,
             const Place& a) const {
        if (weight == 0) return;
        const std::size_t columns = table_.azimuth.size();
        for (int c = 0; c < table_.channels; ++c) {
            const double* const v = &table_.f[table_.block(phi, theta, c)];
            const auto row = [&](std::size_t k) {
                return (1 - a.share) * v[k * columns + a.low] + a.share * v[k * columns + a.high];
            };
            f[static_cast<std::size_t>(c)] +=
                weight * ((1 - p.share) * row(p.low) + p.share * row(p.high));
        }
    }

    AngleTable table_;
    std::string name_;
};

/// Light along the normal still has an azimuth.
Vec3 incident(const AngleTable& table, std::size_t phi, std::size_t theta) {
    return from_spherical(std::max(table.theta_i[theta], 1e-6), table.phi_i[phi]);
}

void require_rising(const std::vector<double>& angles, double most, const char* what,
                    const std::string& where) {
    for (std::size_t k = 0; k < angles.size(); ++k)
        if (!(angles[k] >= -2 * kPi && angles[k] <= most + 1e-6) ||
            (k > 0 && angles[k] <= angles[k - 1]))
            throw Error(ErrorCode::InvalidInput,
                        fmt::format("{} do not rise or lie outside their range: {:.6g} degrees",
                                    what, degrees(angles[k])),
                        where);
}

}  // namespace

Vec3 direction_of(const AngleTable& table, Vec3 wi, double polar, double turn) {
    if (table.frame == AngleFrame::Normal)
        return from_spherical(polar, asperity::azimuth(wi) + table.azimuth_zero + turn);
    const SpecularFrame frame(wi);
    return std::cos(polar) * frame.mirror +
           std::sin(polar) * (std::cos(turn) * frame.up + std::sin(turn) * frame.side);
}

double integral_of(const AngleTable& table, std::size_t phi, std::size_t theta, int channel) {
    const Vec3 wi = incident(table, phi, theta);
    const double* const f = &table.f[table.block(phi, theta, channel)];
    const std::size_t columns = table.azimuth.size();
    const auto at = [&](std::size_t p, std::size_t a) {
        const Vec3 wo = direction_of(table, wi, table.polar[p], table.azimuth[a]);
        return f[p * columns + a] * std::max(0.0, wo.z) * std::sin(table.polar[p]);
    };
    const auto row = [&](std::size_t p) {
        double sum = 0;
        for (std::size_t a = 0; a + 1 < columns; ++a)
            sum += 0.5 * (at(p, a) + at(p, a + 1)) * (table.azimuth[a + 1] - table.azimuth[a]);
        const double gap = table.azimuth.front() + 2 * kPi - table.azimuth.back();
        if (!table.mirrored && gap > kSame && columns > 1)
            sum += 0.5 * (at(p, columns - 1) + at(p, 0)) * gap;
        return table.mirrored ? 2 * sum : sum;
    };
    double sum = 0;
    for (std::size_t p = 0; p + 1 < table.polar.size(); ++p)
        sum += 0.5 * (row(p) + row(p + 1)) * (table.polar[p + 1] - table.polar[p]);
    return sum;
}

void fill(AngleTable& table, const Bsdf& bsdf, const std::vector<std::vector<double>>& mixture,
          int threads) {
    table.channels = static_cast<int>(mixture.size());
    table.f.assign(table.size(), 0.0);
    const auto channels = static_cast<std::size_t>(bsdf.channels());
    parallel_for(table.phi_i.size() * table.theta_i.size(), threads, [&](std::size_t k) {
        const std::size_t phi = k / table.theta_i.size(), theta = k % table.theta_i.size();
        const Vec3 wi = incident(table, phi, theta);
        std::array<double, kMaxBsdfChannels> values{};
        const std::span<double> f = std::span(values).first(channels);
        for (std::size_t n = 0; n < table.directions(); ++n) {
            double polar = table.polar[n / table.azimuth.size()];
            if (table.frame == AngleFrame::Normal) polar = std::min(polar, kGrazing);
            const Vec3 wo = direction_of(table, wi, polar, table.azimuth[n % table.azimuth.size()]);
            bsdf.eval(wi, wo, f);
            for (std::size_t out = 0; out < mixture.size(); ++out)
                for (std::size_t c = 0; c < channels; ++c)
                    table.f[table.block(phi, theta, static_cast<int>(out)) + n] +=
                        mixture[out][c] * f[c];
        }
    });
}

std::vector<double> even_angles(double first_deg, double last_deg, double step_deg) {
    std::vector<double> angles;
    const int count = static_cast<int>(std::floor((last_deg - first_deg) / step_deg + 1e-9));
    for (int k = 0; k <= count; ++k) angles.push_back(radians(first_deg + k * step_deg));
    return angles;
}

std::vector<double> table_thetas(const ExportSource& source) {
    if (source.measurement()) return source.thetas();
    const std::vector<double> own = source.bsdf().incident_angles();
    return own.empty() ? even_angles(0, 85, 5) : own;
}

std::unique_ptr<Bsdf> make_table_bsdf(AngleTable table, std::string name,
                                      const std::string& where) {
    if (table.phi_i.empty() || table.theta_i.empty() || table.polar.empty() ||
        table.azimuth.empty() || table.f.size() != table.size())
        throw Error(ErrorCode::InvalidInput, "is no whole table", where);
    if (table.channels > kMaxBsdfChannels)
        throw Error(ErrorCode::InvalidInput,
                    fmt::format("has {} channels, {} are taken", table.channels, kMaxBsdfChannels),
                    where);
    require_rising(table.theta_i, 0.5 * kPi, "incident angles", where);
    require_rising(table.phi_i, 2 * kPi, "incident azimuths", where);
    require_rising(table.polar, table.frame == AngleFrame::Normal ? 0.5 * kPi : kPi,
                   "outgoing angles", where);
    require_rising(table.azimuth, 2 * kPi, "outgoing azimuths", where);
    for (double& f : table.f) {
        if (!std::isfinite(f)) throw Error(ErrorCode::InvalidInput, "holds a NaN or inf", where);
        f = std::max(0.0, f);
    }
    return std::make_unique<TableBsdf>(std::move(table), std::move(name));
}

namespace {

/// The different values of an angle, rising; such as differ by digits of a text are one.
class Axis {
  public:
    template <class Get>
    Axis(const std::vector<AngleRow>& rows, Get get) {
        std::vector<double> all;
        for (const AngleRow& row : rows) all.push_back(get(row));
        std::sort(all.begin(), all.end());
        for (const double angle : all)
            if (nodes.empty() || angle > nodes.back() + kOfText) nodes.push_back(angle);
    }
    std::size_t place(double angle) const {
        const auto above = std::upper_bound(nodes.begin(), nodes.end(), angle);
        return static_cast<std::size_t>(above - nodes.begin()) - 1;
    }
    std::vector<double> nodes;

  private:
    static constexpr double kOfText = 1e-5;
};

}  // namespace

AngleTable table_of_rows(std::vector<AngleRow> rows, const std::string& where) {
    if (rows.empty()) throw Error(ErrorCode::InvalidInput, "has no rows", where);
    for (AngleRow& row : rows) {
        if (row.phi_o < -1e-5) row.phi_o += 2 * kPi;
        if (row.phi_i != 0 && row.phi_o > 2 * kPi - 1e-5) row.phi_o = 0;
    }
    const Axis phi_i(rows, [](const AngleRow& r) { return r.phi_i; });
    const Axis theta_i(rows, [](const AngleRow& r) { return r.theta_i; });
    const Axis theta_o(rows, [](const AngleRow& r) { return r.theta_o; });
    const Axis phi_o(rows, [](const AngleRow& r) { return r.phi_o; });
    AngleTable table;
    table.phi_i = phi_i.nodes;
    table.theta_i = theta_i.nodes;
    table.polar = theta_o.nodes;
    table.azimuth = phi_o.nodes;
    table.channels = static_cast<int>(rows.front().f.size());
    const std::size_t combinations = table.size() / rows.front().f.size();
    if (combinations < rows.size())
        throw Error(ErrorCode::InvalidInput, "has two rows for one pair of directions", where);
    if (combinations != rows.size())
        throw Error(ErrorCode::InvalidInput,
                    fmt::format("has {} rows; every combination of its {} x {} incident and {} x "
                                "{} outgoing angles would be {}",
                                rows.size(), table.theta_i.size(), table.phi_i.size(),
                                table.polar.size(), table.azimuth.size(), combinations),
                    where);
    // Azimuths that stop at 180 degrees stand for both sides.
    table.mirrored = table.azimuth.size() > 1 && table.azimuth.front() < kSame &&
                     std::abs(table.azimuth.back() - kPi) < 1e-5;
    table.f.assign(table.size(), 0.0);
    std::vector<bool> seen(combinations, false);
    for (const AngleRow& row : rows) {
        const std::size_t p = phi_i.place(row.phi_i), t = theta_i.place(row.theta_i);
        const std::size_t n =
            theta_o.place(row.theta_o) * table.azimuth.size() + phi_o.place(row.phi_o);
        const std::size_t index = (p * table.theta_i.size() + t) * table.directions() + n;
        if (seen[index])
            throw Error(ErrorCode::InvalidInput, "has two rows for one pair of directions", where);
        seen[index] = true;
        for (int c = 0; c < table.channels; ++c)
            table.f[table.block(p, t, c) + n] = row.f[static_cast<std::size_t>(c)];
    }
    return table;
}

// IEC 61966-2-1, D65.
std::array<double, 3> rgb_of_xyz(const std::array<double, 3>& v) {
    return {3.2404542 * v[0] - 1.5371385 * v[1] - 0.4985314 * v[2],
            -0.9692660 * v[0] + 1.8760108 * v[1] + 0.0415560 * v[2],
            0.0556434 * v[0] - 0.2040259 * v[1] + 1.0572252 * v[2]};
}

std::vector<std::vector<double>> tristimulus_or_luminance(const ExportSource& source) {
    if (source.channels() != 3) return {source.luminance_weights()};
    constexpr std::array<std::array<double, 3>, 3> kXyzOfRgb = {
        {{0.4124564, 0.3575761, 0.1804375},
         {0.2126729, 0.7151522, 0.0721750},
         {0.0193339, 0.1191920, 0.9503041}}};
    const std::array<int, 3> channels = source.rgb_channels();
    std::vector<std::vector<double>> mixture(3, std::vector<double>(3));
    for (std::size_t row = 0; row < 3; ++row)
        for (std::size_t c = 0; c < 3; ++c)
            mixture[row][static_cast<std::size_t>(channels[c])] = kXyzOfRgb[row][c];
    return mixture;
}

}  // namespace asperity::io
