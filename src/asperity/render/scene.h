// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/bsdf/models/lambert.h>
#include <asperity/render/light.h>
#include <asperity/render/material.h>
#include <asperity/render/traced_model.h>

#include <memory>
#include <optional>
#include <vector>

namespace asperity {

/// Two materials on one model: left of an upright line in the picture the scene's own, right of it
/// another. A path keeps the material of the pixel it started from everywhere, so each side is what
/// the whole picture would be.
struct SplitView {
    Material right;
    double position =
        0.5;  ///< of the line, as a share of the width, 0 .. 1; pixels by their middle
};

/// What a picture is made of. Cheap to copy and to change: the geometry and the BRDFs are shared.
struct ModelScene {
    std::shared_ptr<const TracedModel> model;
    Material material;
    std::optional<SplitView> split;
    /// Of parts with Role::Stage.
    Material stage{std::make_shared<LambertBrdf>(std::vector<double>{0.5})};
    std::vector<std::shared_ptr<const Light>> lights;  ///< none: all is black
};

}  // namespace asperity
