// SPDX-License-Identifier: Apache-2.0
#include "backdrop.h"

#include <algorithm>
#include <cmath>

namespace asperity::studio {

namespace {

// As a screen shows them, 0 .. 1; the thesis' is 0.667 all over.
constexpr double kMiddle = 0.70, kAway = 0.60;

/// The grey that a tone mapping shows at `level`, found by halving the interval of its logarithm.
double radiance_shown_at(double level, const ToneMapping& tone) {
    double low = -60, high = 60;
    const ToneMapping unexposed{0, tone.curve, tone.transfer};
    for (int k = 0; k < 60; ++k) {
        const double middle = 0.5 * (low + high), c = std::exp2(middle);
        (apply(unexposed, {c, c, c}).g < level ? low : high) = middle;
    }
    return std::exp2(0.5 * (low + high) - tone.exposure);
}

class Backdrop final : public Light {
  public:
    Backdrop(const Camera& camera, const ToneMapping& tone)
        : forward_(camera.forward),
          middle_(radiance_shown_at(kMiddle, tone)),
          away_(radiance_shown_at(kAway, tone)) {}

    std::string name() const override { return "grey backdrop, seen but without light"; }
    // No direction is ever drawn to it, and none finds it.
    bool is_delta() const override { return true; }
    std::optional<LightSample> sample(Vec3, double, double) const override { return std::nullopt; }
    Rgb radiance(Vec3) const override { return {}; }
    double pdf(Vec3) const override { return 0; }
    double weight() const override { return 0; }

    Rgb background(Vec3 direction) const override {
        constexpr double kAwayAt = 0.25;  // 1 - cos of 41 degrees: a corner of a wide view
        const double t = std::clamp((1 - dot(direction, forward_)) / kAwayAt, 0.0, 1.0);
        const double grey = middle_ + t * (away_ - middle_);
        return {grey, grey, grey};
    }

  private:
    Vec3 forward_;
    double middle_, away_;
};

}  // namespace

std::shared_ptr<const Light> make_backdrop(const Camera& camera, const ToneMapping& tone) {
    return std::make_shared<Backdrop>(camera, tone);
}

}  // namespace asperity::studio
