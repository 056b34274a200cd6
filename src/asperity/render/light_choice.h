// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/render/light.h>
#include <asperity/render/render_settings.h>

#include <memory>
#include <span>
#include <vector>

namespace asperity {

/// Which lights are asked for a sample at a point: up to three are asked all, of more one is chosen
/// in proportion to its weight().
class LightChoice {
  public:
    /// A light and how often it is asked, 0 .. 1.
    struct Chance {
        const Light* light = nullptr;
        double share = 1;
    };

    /// The lights must live as long. Those with an extent are asked for no sample when the
    /// integrator finds them by the BRDF alone, or by itself.
    LightChoice(const std::vector<std::shared_ptr<const Light>>& lights,
                const RenderSettings& settings);

    /// Those to ask at one point; `u` in [0, 1) chooses when one is to be chosen.
    std::span<const Chance> choose(double u) const;

    /// True when choose() does choose.
    bool chooses() const { return chooses_; }

    /// All lights with an extent, and how often each is asked: 0 when it is not.
    std::span<const Chance> extended() const { return extended_; }

  private:
    bool chooses_ = false;
    std::vector<Chance> asked_, extended_;
};

}  // namespace asperity
