// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "render_options.h"
#include "report_json.h"

#include <asperity/render/renderer.h>

#include <string>
#include <vector>

namespace asperity::cli {

/// A picture and all that is told about it.
struct Picture {
    const LoadedModel& loaded;
    const ModelScene& scene;
    const Camera& camera;
    const Renderer& renderer;
    RenderOutcome outcome;
    std::vector<std::string> files;  ///< as written
};

/// The model in one line or two: meshes, instances, unique and instanced triangles and vertices,
/// and what its file had that cannot be drawn.
std::string model_lines(const LoadedModel& loaded);

/// The materials and the lights, a line each.
std::string scene_lines(const ModelScene& scene);

/// Samples, noise, seconds, rays per second.
std::string outcome_line(const Picture& picture);

Json to_json(const Picture& picture);

/// 16 hexadecimal digits over the bits of the pixels: FNV-1a of their means as floats.
std::string checksum(const Film& film);

/// What came out, to go behind what was asked for.
io::Provenance outcome_provenance(const Picture& picture);

}  // namespace asperity::cli
