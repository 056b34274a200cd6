// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/render/camera.h>
#include <asperity/render/light.h>
#include <asperity/render/tonemap.h>

#include <memory>

namespace asperity::studio {

/// The grey behind the model, as in the thesis, somewhat darker away from the middle of the view.
/// It is seen and gives no light. As a screen shows it, it is the same for every tone mapping.
std::shared_ptr<const Light> make_backdrop(const Camera& camera, const ToneMapping& tone);

}  // namespace asperity::studio
