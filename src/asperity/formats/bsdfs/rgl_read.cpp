// SPDX-License-Identifier: Apache-2.0
// Reads an RGL file as the `measured` plug-in of Mitsuba evaluates and samples it.
#include <asperity/core/error.h>
#include <asperity/formats/bsdfs/rgl_format.h>
#include <asperity/formats/bsdfs/rgl_warp.h>
#include <asperity/formats/results/tensor_file.h>

#include <fmt/format.h>

#include <array>
#include <filesystem>

namespace asperity::io {
namespace {

using namespace rgl;

/// Reads the fields of one file and checks that their shapes belong together.
class RglReader {
  public:
    explicit RglReader(const std::string& path) : file_(path) {}

    std::vector<float> numbers(const TensorField& field) const {
        std::vector<float> values(field.bytes / sizeof(float));
        file_.read(field, 0, std::as_writable_bytes(std::span(values)));
        for (const float v : values)
            if (!std::isfinite(v)) file_.fail(field.offset, field.name + " holds a NaN or inf");
        return values;
    }

    std::vector<float> angles(const char* name) const {
        const TensorField& field = file_.require(name, TensorType::F32, 1);
        std::vector<float> values = numbers(field);
        if (values.empty()) file_.fail(field.entry, field.name + " is empty");
        for (std::size_t k = 1; k < values.size(); ++k)
            if (!(values[k] > values[k - 1]))
                file_.fail(field.offset, field.name + " does not rise");
        return values;
    }

    /// Images of a field of 2 + `leading.size()` dimensions, the first of these sizes.
    Images images(const char* name, const std::vector<std::uint64_t>& leading) const {
        const TensorField& field = file_.require(name, TensorType::F32, leading.size() + 2);
        for (std::size_t k = 0; k < leading.size(); ++k)
            if (field.shape[k] != leading[k])
                file_.fail(field.entry, fmt::format("{} has {} slices on axis {}, not {}", name,
                                                    field.shape[k], k, leading[k]));
        const std::uint64_t height = field.shape[leading.size()];
        const std::uint64_t width = field.shape[leading.size() + 1];
        if (width < 2 || height < 2)
            file_.fail(field.entry, fmt::format("{} has images below 2 x 2", name));
        return {width, height, numbers(field)};
    }

    Density density(const char* name, const std::vector<std::uint64_t>& leading) const {
        Images read = images(name, leading);
        const std::size_t size = read.width * read.height;
        for (std::size_t begin = 0; begin < read.values.size(); begin += size) {
            double sum = 0;
            for (std::size_t k = begin; k < begin + size; ++k) {
                if (read.values[k] < 0)
                    file_.fail(file_.find(name)->offset, fmt::format("{} is negative", name));
                sum += double{read.values[k]};
            }
            if (!(sum > 0)) file_.fail(file_.find(name)->offset, fmt::format("{} is empty", name));
        }
        return Density(std::move(read));
    }

    const TensorFile& file() const { return file_; }

  private:
    TensorFile file_;
};

class RglBsdf final : public Bsdf {
  public:
    explicit RglBsdf(const std::string& path) : RglBsdf(path, RglReader(path)) {}

    int channels() const override { return static_cast<int>(channels_); }
    std::vector<std::string> channel_names() const override {
        return wavelengths_.empty() ? Bsdf::channel_names() : wavelengths_;
    }
    std::string name() const override { return name_; }
    bool isotropic() const override { return phis_.size() <= 2; }

    void eval(Vec3 wi, Vec3 wo, std::span<double> f) const override {
        std::fill(f.begin(), f.end(), 0.0);
        if (wi.z <= 0 || wo.z <= 0) return;
        const Place p = place(wi, normalize(wi + wo));
        const Point s = vndf_.invert(p.m, p.blend).point;
        const double sigma = sigma_.eval(p.wi, {});
        const double scale = jacobian_ ? ndf_.eval(p.m, {}) / (4 * std::max(sigma, 1e-12)) : 1.0;
        for (std::size_t c = 0; c < channels_; ++c)
            f[c] = std::max(0.0, values_.eval(s, of_channel(p.blend, c))) * scale / wo.z;
    }

    std::optional<BsdfSample> sample(Vec3 wi, double u1, double u2) const override {
        if (wi.z <= 0) return std::nullopt;
        const double phi_i = std::atan2(wi.y, wi.x);
        const Blend blend = blend_at(phis_, thetas_, phi_i, polar_angle(wi));
        const Density::Warped light = luminance_.sample({u2, u1}, blend);
        const Point u = vndf_.sample(light.point, blend).point;
        const Vec3 wm = from_spherical(theta_of(u), phi_of(u) + (isotropic() ? phi_i : 0.0));
        const Vec3 wo = reflect(wi, wm);
        const double density = wo.z > 0 ? pdf(wi, wo) : 0.0;
        if (!(density > 0)) return std::nullopt;
        return BsdfSample{wo, density};
    }

    double pdf(Vec3 wi, Vec3 wo) const override {
        if (wi.z <= 0 || wo.z <= 0) return 0;
        const Vec3 wm = normalize(wi + wo);
        const Place p = place(wi, wm);
        const Density::Warped there = vndf_.invert(p.m, p.blend);
        return there.density * luminance_.eval(there.point, p.blend) /
               (solid_angle_of(p.m) * 4 * dot(wi, wm));
    }

  private:
    RglBsdf(const std::string& path, const RglReader& in)
        : name_("file:" + std::filesystem::path(path).filename().string()),
          phis_(in.angles("phi_i")),
          thetas_(in.angles("theta_i")),
          ndf_(in.images("ndf", {})),
          sigma_(in.images("sigma", {})),
          vndf_(in.density("vndf", {phis_.size(), thetas_.size()})),
          luminance_(in.density("luminance", {phis_.size(), thetas_.size()})) {
        const TensorField* spectra = in.file().find("spectra");
        const char* field = spectra ? "spectra" : "rgb";
        const TensorField& entry = in.file().require(field, TensorType::F32, 5);
        channels_ = entry.shape[2];
        if (channels_ < 1 || channels_ > kMaxBsdfChannels || (!spectra && channels_ != 3))
            in.file().fail(entry.entry, fmt::format("{} has {} channels", field, channels_));
        if (spectra) {
            for (const float nm : in.angles("wavelengths"))
                wavelengths_.push_back(fmt::format("{}nm", nm));
            if (wavelengths_.size() != channels_)
                in.file().fail(entry.entry, "spectra and wavelengths differ in number");
        }
        values_ = in.images(field, {phis_.size(), thetas_.size(), channels_});
        const TensorField& jacobian = in.file().require("jacobian", TensorType::U8, 1);
        std::byte flag{};
        if (jacobian.bytes != 1) in.file().fail(jacobian.entry, "jacobian is not one number");
        in.file().read(jacobian, 0, {&flag, 1});
        jacobian_ = flag != std::byte{0};
    }

    /// Where a pair of directions lies in the tables.
    struct Place {
        Blend blend;
        Point wi, m;
    };
    Place place(Vec3 wi, Vec3 wm) const {
        const double phi_i = std::atan2(wi.y, wi.x), theta_i = polar_angle(wi);
        const double phi_m = std::atan2(wm.y, wm.x) - (isotropic() ? phi_i : 0.0);
        return {blend_at(phis_, thetas_, phi_i, theta_i), to_square(theta_i, phi_i),
                to_square(polar_angle(wm), phi_m)};
    }

    Blend of_channel(Blend blend, std::size_t channel) const {
        for (std::size_t& slice : blend.slice) slice = slice * channels_ + channel;
        return blend;
    }

    std::string name_;
    std::vector<float> phis_, thetas_;
    Images ndf_, sigma_;
    Density vndf_, luminance_;
    Images values_;
    std::size_t channels_ = 0;
    std::vector<std::string> wavelengths_;  ///< names of channels that are some
    bool jacobian_ = true;
};

}  // namespace

std::unique_ptr<Bsdf> read_rgl(const std::string& path) {
    return std::make_unique<RglBsdf>(path);
}

bool looks_like_rgl(std::string_view head) {
    if (!head.starts_with(std::string_view("tensor_file", 12))) return false;
    const auto names = [head](std::string_view field) {
        return head.find(field) != std::string_view::npos;
    };
    return names("vndf") && names("sigma") && names("luminance");
}

}  // namespace asperity::io
