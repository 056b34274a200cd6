// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/render/light.h>

#include <memory>

namespace asperity::studio {

/// Light as in a photographer's room, without a colour: a sky that is brighter towards the zenith,
/// a wide lamp to the upper left of the viewer, a dimmer one to the right, and below the horizon
/// what a matt floor of albedo 0.5 would send back. A white, matt, level plane has the luminance 1
/// in it.
std::shared_ptr<const Light> make_soft_sky();

}  // namespace asperity::studio
