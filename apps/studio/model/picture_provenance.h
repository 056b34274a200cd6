// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "settings.h"
#include "worn_brdfs.h"

#include <asperity/formats/images/render_writer.h>
#include <asperity/render/camera.h>

#include <string>

namespace asperity::studio {

/// A picture of the scene "Model" in the words of `asperity render`: names of its options, and
/// their values. What has no option there is told under a name of its own: camera-up, scene.
io::Provenance picture_provenance(const ModelView& view, const std::string& model,
                                  const Camera& camera, const WornBrdfs& brdfs);

}  // namespace asperity::studio
