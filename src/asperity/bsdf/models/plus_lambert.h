// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/bsdf/bsdf_models.h>

#include <memory>
#include <vector>

namespace asperity {

/// The key that plus_lambert() adds.
inline constexpr const char* kLambertKey = "lambert";

/// The sum of a BSDF and a Lambertian lobe: f + albedo / pi, as "ggx:alpha=0.3,lambert=0.2" has it.
/// Nothing couples the two, so their albedos add up and may exceed 1. sample() draws from either.
class PlusLambertBrdf final : public Bsdf {
  public:
    /// One albedo for all channels or one per channel, each in [0, 1]; a `first` of one channel
    /// counts for all. Throws Error(Usage, "lambert").
    PlusLambertBrdf(std::unique_ptr<Bsdf> first, std::vector<double> albedo);

    int channels() const override { return channels_; }
    std::vector<std::string> channel_names() const override {
        return channels_ == first_->channels() ? first_->channel_names() : Bsdf::channel_names();
    }
    std::string name() const override;
    void eval(Vec3 wi, Vec3 wo, std::span<double> f) const override;
    std::optional<BsdfSample> sample(Vec3 wi, double u1, double u2) const override;
    double pdf(Vec3 wi, Vec3 wo) const override;
    void albedo(Vec3 wi, std::span<double> a) const override;
    bool isotropic() const override { return first_->isotropic(); }
    bool bilateral() const override { return first_->bilateral(); }
    std::optional<double> normal_density(Vec3 wm) const override {
        return first_->normal_density(wm);
    }

  private:
    void add(std::span<double> values, double scale) const;
    std::span<double> of_first(std::span<double> values) const;

    std::unique_ptr<Bsdf> first_;
    std::vector<double> albedo_;
    int channels_ = 1;
    double diffuse_share_ = 0;  ///< of the samples
};

/// The model with one key more, "lambert": the albedo of a Lambertian lobe added to it, by default
/// none. Its BSDF's name must be a specification of the same model.
BsdfModel plus_lambert(BsdfModel model);

}  // namespace asperity
