// SPDX-License-Identifier: Apache-2.0
#include <asperity/core/directions.h>
#include <asperity/core/error.h>
#include <asperity/formats/bsdfs/fidelity.h>
#include <asperity/measured/compare.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace asperity::io {
namespace {

constexpr double kLastAngle = 85;  // [deg]

/// Red, green and blue of a file of a grey source are alike: one of them is compared.
class OneChannel final : public Bsdf {
  public:
    explicit OneChannel(const Bsdf& bsdf) : bsdf_(bsdf) {}
    int channels() const override { return 1; }
    std::string name() const override { return bsdf_.name(); }
    void eval(Vec3 wi, Vec3 wo, std::span<double> f) const override {
        std::array<double, kMaxBsdfChannels> values{};
        const std::size_t n = static_cast<std::size_t>(bsdf_.channels());
        bsdf_.eval(wi, wo, std::span(values).first(n));
        f[0] = 0;
        for (std::size_t c = 0; c < n; ++c) f[0] += values[c] / static_cast<double>(n);
    }
    std::optional<BsdfSample> sample(Vec3 wi, double u1, double u2) const override {
        return bsdf_.sample(wi, u1, u2);
    }
    double pdf(Vec3 wi, Vec3 wo) const override { return bsdf_.pdf(wi, wo); }
    bool isotropic() const override { return bsdf_.isotropic(); }

  private:
    const Bsdf& bsdf_;
};

/// A file whose channels stand in another order, as that of their wavelengths: those of the source.
class InOrder final : public Bsdf {
  public:
    InOrder(std::shared_ptr<const Bsdf> bsdf, std::vector<std::size_t> order)
        : bsdf_(std::move(bsdf)), order_(std::move(order)) {}
    int channels() const override { return bsdf_->channels(); }
    std::string name() const override { return bsdf_->name(); }
    void eval(Vec3 wi, Vec3 wo, std::span<double> f) const override {
        std::array<double, kMaxBsdfChannels> values{};
        bsdf_->eval(wi, wo, std::span(values).first(order_.size()));
        for (std::size_t c = 0; c < f.size(); ++c) f[c] = values[order_[c]];
    }
    std::optional<BsdfSample> sample(Vec3 wi, double u1, double u2) const override {
        return bsdf_->sample(wi, u1, u2);
    }
    double pdf(Vec3 wi, Vec3 wo) const override { return bsdf_->pdf(wi, wo); }
    bool isotropic() const override { return bsdf_->isotropic(); }

  private:
    std::shared_ptr<const Bsdf> bsdf_;
    std::vector<std::size_t> order_;
};

/// The file with its channels as the source has them: by their names; of three that the file knows
/// as red, green and blue only, those that stand for them.
std::shared_ptr<const Bsdf> as_in_source(std::shared_ptr<const Bsdf> file,
                                         const ExportSource& source) {
    const std::vector<std::string> theirs = file->channel_names();
    const std::vector<std::string>& ours = source.channel_names();
    if (theirs == ours || theirs.size() != ours.size()) return file;
    std::vector<std::size_t> order;
    for (const std::string& name : ours) {
        const auto found = std::find(theirs.begin(), theirs.end(), name);
        if (found != theirs.end()) order.push_back(std::size_t(found - theirs.begin()));
    }
    if (order.size() < ours.size()) {
        if (ours.size() != 3) return file;
        const std::array<int, 3> rgb = source.rgb_channels();
        order.assign(3, 0);
        for (std::size_t c = 0; c < 3; ++c) order[static_cast<std::size_t>(rgb[c])] = c;
    }
    return std::make_shared<InOrder>(std::move(file), std::move(order));
}

/// Mean L1 as a share of the albedo of A, over the layers below kLastAngle.
double mean_share(const Comparison& comparison) {
    double sum = 0, count = 0;
    for (const LayerComparison& layer : comparison.layers) {
        if (degrees(layer.theta_i) >= kLastAngle || !(layer.albedo_a > 0)) continue;
        sum += layer.l1 / layer.albedo_a;
        ++count;
    }
    return sum / std::max(1.0, count);
}

Comparison comparison_of(const ExportSource& source, const Bsdf& file) {
    if (source.measurement()) return compare(*source.measurement(), file, source.threads());
    Experiment experiment = source.experiment();
    return compare(source.bsdf(), file, experiment, source.threads());
}

}  // namespace

Fidelity fidelity_of(const ExportSource& source, const BsdfFormat& format,
                     const std::string& path) {
    if (!format.read) throw Error(ErrorCode::Usage, "this format is not read back", format.name);
    std::shared_ptr<const Bsdf> file = as_in_source(format.read(path), source);
    if (source.watched()) file = until_stopped(std::move(file), *source.watched());
    const bool as_grey = source.channels() != file->channels();
    const Comparison comparison =
        as_grey ? comparison_of(source, OneChannel(*file)) : comparison_of(source, *file);

    Fidelity result;
    for (const LayerComparison& layer : comparison.layers) {
        if (degrees(layer.theta_i) >= kLastAngle || !(layer.albedo_a > 0)) continue;
        const Fidelity::LayerFidelity f = {layer.theta_i, layer.phi_i, layer.l1 / layer.albedo_a,
                                           layer.l1_noise / layer.albedo_a,
                                           -layer.albedo_difference};
        result.layers.push_back(f);
        result.mean_l1 += f.l1;
        result.mean_noise += f.noise;
        if (f.l1 > result.worst_l1) {
            result.worst_l1 = f.l1;
            result.worst_theta_i = f.theta_i;
        }
        if (std::abs(f.albedo_difference) > std::abs(result.max_albedo_difference))
            result.max_albedo_difference = f.albedo_difference;
    }
    const double count = std::max(1.0, static_cast<double>(result.layers.size()));
    result.mean_l1 /= count;
    result.mean_noise /= count;
    if (!source.measurement()) return result;
    const Bsdf& made_from = file->isotropic() ? source.isotropic_bsdf() : source.bsdf();
    if (file->isotropic()) result.mean_isotropy = mean_share(comparison_of(source, made_from));
    const OneChannel grey(*file);
    const Bsdf& read = as_grey ? static_cast<const Bsdf&>(grey) : *file;
    result.mean_format =
        mean_share(compare(made_from, read, source.experiment(), source.threads()));
    return result;
}

std::string to_text(const Fidelity& f) {
    if (f.layers.empty()) return "fidelity: no layer below 85 degrees to compare";
    const std::string isotropy =
        f.mean_isotropy < 0 ? ""
                            : fmt::format(", of the data made isotropic and smooth {:.2f} %",
                                          100 * f.mean_isotropy);
    return fmt::format(
        "read back: L1 of f cos {:.2f} % (mean of {} layers below 85°), worst {:.2f} % at {:.4g}°, "
        "albedo {:+.4f} at most; noise of the data alone {:.2f} %{}{}",
        100 * f.mean_l1, f.layers.size(), 100 * f.worst_l1, degrees(f.worst_theta_i),
        f.max_albedo_difference, 100 * f.mean_noise, isotropy,
        f.mean_format < 0 ? ""
                          : fmt::format(", of the format alone {:.2f} %", 100 * f.mean_format));
}

}  // namespace asperity::io
