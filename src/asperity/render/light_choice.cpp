// SPDX-License-Identifier: Apache-2.0
#include <asperity/render/light_choice.h>

#include <algorithm>

namespace asperity {

namespace {

/// So many lights are asked one by one.
constexpr std::size_t kFewLights = 3;
/// Part of the choices in which all lights are alike: a weight is that at the origin, and a light
/// that is weak there may be near elsewhere.
constexpr double kEvenChoices = 0.1;

/// Whether lights with an extent are found by asking them.
bool asks_extended(const RenderSettings& settings) {
    return settings.integrator == Integrator::Path && settings.direct != DirectLight::BrdfOnly;
}

}  // namespace

LightChoice::LightChoice(const std::vector<std::shared_ptr<const Light>>& lights,
                         const RenderSettings& settings) {
    double sum = 0;
    for (const auto& light : lights) {
        if (!light->is_delta() && !asks_extended(settings)) continue;
        asked_.push_back({light.get(), 1});
        sum += light->weight();
    }
    chooses_ = asked_.size() > kFewLights;
    if (chooses_) {
        const double even = (sum > 0 ? kEvenChoices : 1.0) / static_cast<double>(asked_.size());
        for (Chance& chance : asked_)
            chance.share =
                even + (sum > 0 ? (1 - kEvenChoices) * (chance.light->weight() / sum) : 0.0);
    }
    for (const auto& light : lights) {
        if (light->is_delta()) continue;
        const auto asked = std::find_if(asked_.begin(), asked_.end(), [&](const Chance& chance) {
            return chance.light == light.get();
        });
        extended_.push_back({light.get(), asked == asked_.end() ? 0.0 : asked->share});
    }
}

std::span<const LightChoice::Chance> LightChoice::choose(double u) const {
    if (!chooses_) return asked_;
    std::size_t k = 0;
    for (double below = asked_[0].share; u >= below && k + 1 < asked_.size();)
        below += asked_[++k].share;
    return {&asked_[k], 1};
}

}  // namespace asperity
