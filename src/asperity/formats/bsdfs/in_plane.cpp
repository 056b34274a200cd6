// SPDX-License-Identifier: Apache-2.0
#include <asperity/core/directions.h>
#include <asperity/core/error.h>
#include <asperity/formats/bsdfs/in_plane.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace asperity::io {
namespace {

struct Scan {
    double theta_i = 0;
    std::vector<double> angles;          ///< signed theta_o, rising
    std::vector<std::vector<double>> f;  ///< of each angle

    /// f at a signed angle, linear between those measured, the last one beyond.
    double at(double angle, std::size_t channel) const {
        const auto above = std::upper_bound(angles.begin(), angles.end(), angle);
        if (above == angles.begin()) return f.front()[channel];
        if (above == angles.end()) return f.back()[channel];
        const auto k = static_cast<std::size_t>(above - angles.begin());
        const double t = (angle - angles[k - 1]) / (angles[k] - angles[k - 1]);
        return (1 - t) * f[k - 1][channel] + t * f[k][channel];
    }
};

class InPlaneBsdf final : public CosineSampledBsdf {
  public:
    InPlaneBsdf(std::vector<Scan> scans, std::vector<std::string> channel_names, std::string name)
        : scans_(std::move(scans)),
          channel_names_(std::move(channel_names)),
          name_(std::move(name)) {}

    int channels() const override { return static_cast<int>(scans_.front().f.front().size()); }
    std::vector<std::string> channel_names() const override {
        return channel_names_.empty() ? Bsdf::channel_names() : channel_names_;
    }
    std::string name() const override { return name_; }
    bool isotropic() const override { return true; }

    void eval(Vec3 wi, Vec3 wo, std::span<double> f) const override {
        std::fill(f.begin(), f.end(), 0.0);
        if (wi.z <= 0 || wo.z <= 0) return;
        // Distance from the mirror direction, and how far towards the horizon it points: 1 beyond
        // the mirror direction, -1 on the light's side of it.
        const double theta_i = polar_angle(wi), phi = azimuth(wi) + kPi;
        const Vec3 mirror = from_spherical(theta_i, phi);
        const Vec3 beyond = from_spherical(theta_i + 0.5 * kPi, phi);
        const double off = std::acos(std::clamp(dot(wo, mirror), -1.0, 1.0));
        const double across = std::sin(off);
        const double towards = across > 1e-12 ? std::clamp(dot(wo, beyond) / across, -1.0, 1.0) : 1;
        const double far_share = 0.5 * (1 + towards);
        std::size_t high = 0;
        while (high < scans_.size() && scans_[high].theta_i < theta_i) ++high;
        const std::size_t low = high == 0 ? 0 : high - 1;
        high = std::min(high, scans_.size() - 1);
        const double span = scans_[high].theta_i - scans_[low].theta_i;
        const double t =
            span > 0 ? std::clamp((theta_i - scans_[low].theta_i) / span, 0.0, 1.0) : 0;
        for (std::size_t c = 0; c < f.size(); ++c)
            f[c] = (1 - t) * of_scan(scans_[low], off, far_share, c) +
                   t * of_scan(scans_[high], off, far_share, c);
    }

  private:
    static double of_scan(const Scan& scan, double off, double far_share, std::size_t channel) {
        double near = scan.at(scan.theta_i - off, channel),
               far = scan.at(scan.theta_i + off, channel);
        // Beyond the horizon nothing can be measured: the other side stands for both.
        if (scan.theta_i + off > 0.5 * kPi) far = near;
        return (1 - far_share) * near + far_share * far;
    }

    std::vector<Scan> scans_;
    std::vector<std::string> channel_names_;
    std::string name_;
};

}  // namespace

std::unique_ptr<Bsdf> make_in_plane_bsdf(std::vector<AngleRow> rows,
                                         std::vector<std::string> channel_names, std::string name,
                                         const std::string& where) {
    std::stable_sort(rows.begin(), rows.end(), [](const AngleRow& a, const AngleRow& b) {
        return std::pair(a.theta_i, a.theta_o) < std::pair(b.theta_i, b.theta_o);
    });
    std::vector<Scan> scans;
    for (AngleRow& row : rows) {
        if (!(row.theta_i >= 0 && row.theta_i < 0.5 * kPi && std::abs(row.theta_o) <= 0.5 * kPi))
            throw Error(ErrorCode::InvalidInput,
                        fmt::format("light from {:.4g} and to {:.4g} degrees is no direction of "
                                    "the plane of incidence",
                                    degrees(row.theta_i), degrees(row.theta_o)),
                        where);
        if (scans.empty() || scans.back().theta_i != row.theta_i)
            scans.push_back({row.theta_i, {}, {}});
        Scan& scan = scans.back();
        if (!scan.angles.empty() && scan.angles.back() == row.theta_o)
            throw Error(ErrorCode::InvalidInput, "has two rows for one pair of directions", where);
        for (double& f : row.f) f = std::max(0.0, f);
        scan.angles.push_back(row.theta_o);
        scan.f.push_back(std::move(row.f));
    }
    if (static_cast<int>(scans.front().f.front().size()) > kMaxBsdfChannels)
        throw Error(ErrorCode::InvalidInput,
                    fmt::format("has more than {} columns of values", kMaxBsdfChannels), where);
    return std::make_unique<InPlaneBsdf>(std::move(scans), std::move(channel_names),
                                         std::move(name));
}

}  // namespace asperity::io
