// SPDX-License-Identifier: Apache-2.0
#include <asperity/core/directions.h>
#include <asperity/core/error.h>
#include <asperity/core/parse_number.h>
#include <asperity/core/version.h>
#include <asperity/detector/illumination.h>
#include <asperity/formats/atomic_file.h>
#include <asperity/formats/bsdfs/export_source.h>
#include <asperity/formats/results/result_file.h>
#include <asperity/gonio/experiment_text.h>
#include <asperity/gonio/measurement_head.h>
#include <asperity/measured/tabulated.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace asperity::io {
namespace {

constexpr int kAzimuths = 16;  ///< incident azimuths that stand for all of them

class IsotropicMean final : public Bsdf {
  public:
    IsotropicMean(std::shared_ptr<const Bsdf> bsdf, int azimuths)
        : bsdf_(std::move(bsdf)), azimuths_(azimuths) {}

    int channels() const override { return bsdf_->channels(); }
    std::vector<std::string> channel_names() const override { return bsdf_->channel_names(); }
    std::string name() const override { return bsdf_->name(); }
    bool isotropic() const override { return true; }
    bool bilateral() const override { return true; }

    void eval(Vec3 wi, Vec3 wo, std::span<double> f) const override {
        std::fill(f.begin(), f.end(), 0.0);
        std::array<double, kMaxBsdfChannels> values{};
        const std::span<double> one = std::span(values).first(f.size());
        const double phi_i = azimuth(wi);
        const Vec3 light = rotate_z(wi, -phi_i), out = rotate_z(wo, -phi_i);
        for (int k = 0; k < azimuths_; ++k) {
            const double turn = 2 * kPi * k / azimuths_;
            const Vec3 there = rotate_z(light, turn);
            for (const double side : {1.0, -1.0}) {
                bsdf_->eval(there, rotate_z({out.x, side * out.y, out.z}, turn), one);
                for (std::size_t c = 0; c < f.size(); ++c) f[c] += one[c];
            }
        }
        for (double& value : f) value /= 2 * azimuths_;
    }

    // Drawn as for the first azimuth, mirrored at random.
    std::optional<BsdfSample> sample(Vec3 wi, double u1, double u2) const override {
        const double phi_i = azimuth(wi);
        const Vec3 light = rotate_z(wi, -phi_i);
        const double doubled = 2 * u2;
        const bool mirrored = doubled >= 1;
        const auto drawn = bsdf_->sample(light, u1, mirrored ? doubled - 1 : doubled);
        if (!drawn) return std::nullopt;
        const Vec3 wo =
            rotate_z({drawn->wo.x, mirrored ? -drawn->wo.y : drawn->wo.y, drawn->wo.z}, phi_i);
        return BsdfSample{wo, pdf(wi, wo)};
    }

    double pdf(Vec3 wi, Vec3 wo) const override {
        const double phi_i = azimuth(wi);
        const Vec3 light = rotate_z(wi, -phi_i), out = rotate_z(wo, -phi_i);
        return 0.5 * (bsdf_->pdf(light, out) + bsdf_->pdf(light, {out.x, -out.y, out.z}));
    }

  private:
    std::shared_ptr<const Bsdf> bsdf_;
    int azimuths_;
};

class UntilStopped final : public Bsdf {
  public:
    UntilStopped(std::shared_ptr<const Bsdf> bsdf, const Run& run)
        : bsdf_(std::move(bsdf)), run_(run) {}

    int channels() const override { return bsdf_->channels(); }
    std::vector<std::string> channel_names() const override { return bsdf_->channel_names(); }
    std::string name() const override { return bsdf_->name(); }
    bool isotropic() const override { return bsdf_->isotropic(); }
    bool bilateral() const override { return bsdf_->bilateral(); }
    std::vector<double> incident_angles() const override { return bsdf_->incident_angles(); }
    void eval(Vec3 wi, Vec3 wo, std::span<double> f) const override {
        check_stop(&run_);
        bsdf_->eval(wi, wo, f);
    }
    double eval_pdf(Vec3 wi, Vec3 wo, std::span<double> f) const override {
        check_stop(&run_);
        return bsdf_->eval_pdf(wi, wo, f);
    }
    std::optional<BsdfSample> sample(Vec3 wi, double u1, double u2) const override {
        return bsdf_->sample(wi, u1, u2);
    }
    double pdf(Vec3 wi, Vec3 wo) const override { return bsdf_->pdf(wi, wo); }
    void albedo(Vec3 wi, std::span<double> a) const override {
        check_stop(&run_);
        bsdf_->albedo(wi, a);
    }
    std::optional<double> normal_density(Vec3 wm) const override {
        return bsdf_->normal_density(wm);
    }

  private:
    std::shared_ptr<const Bsdf> bsdf_;
    const Run& run_;
};

std::vector<double> distinct(std::vector<double> angles) {
    std::sort(angles.begin(), angles.end());
    constexpr double kSameAngle = 1e-9;
    const auto same = [](double a, double b) { return b - a <= kSameAngle; };
    angles.erase(std::unique(angles.begin(), angles.end(), same), angles.end());
    return angles;
}

}  // namespace

std::shared_ptr<const Bsdf> isotropic_mean(std::shared_ptr<const Bsdf> bsdf, int azimuths) {
    return std::make_shared<IsotropicMean>(std::move(bsdf), azimuths);
}

std::shared_ptr<const Bsdf> until_stopped(std::shared_ptr<const Bsdf> bsdf, const Run& run) {
    return std::make_shared<UntilStopped>(std::move(bsdf), run);
}

ExportSource::ExportSource(std::shared_ptr<const Measurement> measurement, int threads)
    : measurement_(std::move(measurement)),
      experiment_(measurement_->experiment),
      threads_(threads),
      channel_names_(measurement_->channel_names) {
    for (const Layer& layer : measurement_->layers) {
        thetas_.push_back(layer.theta_i);
        phis_.push_back(layer.phi_i);
    }
    take_angles();
}

ExportSource::ExportSource(std::shared_ptr<const Bsdf> bsdf, const Experiment& experiment,
                           int threads)
    : experiment_(experiment), threads_(threads), bsdf_(std::move(bsdf)) {
    channel_names_ = bsdf_->channel_names();
    experiment_.illumination.isotropic = bsdf_->isotropic();
    for (const Incidence& light : incidences(experiment_.illumination)) {
        thetas_.push_back(light.theta);
        phis_.push_back(light.phi);
    }
    take_angles();
}

void ExportSource::take_angles() {
    if (thetas_.empty()) throw Error(ErrorCode::Usage, "there is no layer to write", "layers");
    thetas_ = distinct(std::move(thetas_));
    phis_ = distinct(std::move(phis_));
}

void ExportSource::check_stopped() const {
    check_stop(run_);
}

const Bsdf& ExportSource::bsdf() const {
    if (!bsdf_)
        bsdf_ =
            run_ ? make_tabulated_brdf(*measurement_, *run_) : make_tabulated_brdf(*measurement_);
    if (run_ && !guarded_) bsdf_ = until_stopped(bsdf_, *run_);
    guarded_ = guarded_ || run_;
    return *bsdf_;
}

const Bsdf& ExportSource::isotropic_bsdf() const {
    bsdf();
    if (!isotropic_bsdf_)
        isotropic_bsdf_ = isotropic_mean(bsdf_, bsdf_->isotropic() ? 1 : kAzimuths);
    return *isotropic_bsdf_;
}

bool ExportSource::isotropic() const {
    return measurement_ ? phis_.size() == 1 : bsdf_->isotropic();
}

std::array<int, 3> ExportSource::rgb_channels() const {
    if (channels() == 1) return {0, 0, 0};
    if (channels() == 3) {
        std::array<int, 3> longest_first = {0, 1, 2};
        const std::vector<double> nm = wavelengths_nm();
        std::sort(longest_first.begin(), longest_first.end(), [&](int a, int b) {
            return nm.empty() ? a < b
                              : nm[static_cast<std::size_t>(a)] > nm[static_cast<std::size_t>(b)];
        });
        return longest_first;
    }
    throw Error(ErrorCode::Usage,
                fmt::format("takes red, green and blue, the data have {} channels: only rgl with "
                            "colour=spectral, layers, layers-csv and astm take them as they are",
                            channels()),
                "format");
}

std::vector<double> ExportSource::wavelengths_nm() const {
    std::vector<double> wavelengths;
    for (const std::string& name : channel_names_) {
        if (!name.ends_with("nm")) return {};
        const auto wavelength = parse_double(std::string_view(name).substr(0, name.size() - 2));
        if (!wavelength) return {};
        wavelengths.push_back(*wavelength);
    }
    return wavelengths;
}

std::vector<double> ExportSource::luminance_weights() const {
    if (channels() == 3) {
        const std::array<int, 3> rgb = rgb_channels();
        std::vector<double> weights(3);
        for (std::size_t c = 0; c < 3; ++c)
            weights[static_cast<std::size_t>(rgb[c])] = std::array{0.2126, 0.7152, 0.0722}[c];
        return weights;
    }
    return std::vector<double>(static_cast<std::size_t>(channels()), 1.0 / channels());
}

std::vector<std::string> ExportSource::provenance() const {
    std::vector<std::string> lines = {fmt::format("Asperity {}", kVersion)};
    if (!measurement_) {
        lines.push_back("model " + bsdf_->name());
        return lines;
    }
    lines.push_back("surface " + measurement_->surface_name);
    lines.push_back("measured with Asperity " +
                    (measurement_->version.empty() ? kVersion : measurement_->version));
    lines.push_back("checksum " + checksum(*measurement_));
    for (const Setting& setting : settings_of(experiment_))
        lines.push_back(setting.key + " = " + setting.value);
    for (const std::string& note : measurement_->notes) lines.push_back("note: " + note);
    return lines;
}

std::vector<std::string> ExportSource::remarks() const {
    std::vector<std::string> remarks;
    if (!measurement_) return remarks;
    if (std::string narrow = narrow_lobes(*measurement_); !narrow.empty())
        remarks.push_back(std::move(narrow));
    if (phis_.size() == 1 && !experiment_.illumination.isotropic &&
        !measurement_->surface_isotropic)
        remarks.emplace_back("one azimuth was measured and stands for all");
    const double last = degrees(thetas_.back());
    if (last < 89)
        remarks.push_back(fmt::format(
            "beyond {:.4g} degrees the lobe of the last layer moves on with the light, its albedo "
            "kept",
            last));
    return remarks;
}

}  // namespace asperity::io
