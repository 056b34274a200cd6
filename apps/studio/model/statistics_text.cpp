// SPDX-License-Identifier: Apache-2.0
#include "statistics_text.h"

#include <fmt/format.h>

namespace asperity::studio {

GeometryCounts geometry_of(const Heightfield& surface) {
    const std::uint64_t cells = surface.cell_count();
    return {cells, cells, 2 * cells, 4 * cells, 2 * cells, 4 * cells};
}

RayCounts rays_of(const Drawing& drawing) {
    if (const auto result = drawing.result()) {
        RayCounts counts;
        for (const Layer& layer : result->layers) counts.rays += static_cast<double>(layer.rays);
        if (result->trace_seconds > 0) counts.per_second = counts.rays / result->trace_seconds;
        return counts;
    }
    const Progress progress = drawing.progress();
    if (progress.stage != "tracing") return {};
    return {static_cast<double>(progress.done), progress.per_second};
}

QString statistics_text(const StudioStatistics& s) {
    const GeometryCounts& g = s.geometry;
    std::string text = s.samples > 0 ? fmt::format("Frame Stats: refined, {} sample{}\n\n",
                                                   s.samples, s.samples == 1 ? "" : "s")
                                     : fmt::format("Frame Stats: {:.0f} FPS ({:.2f} ms/frame)\n\n",
                                                   s.frames_per_second, s.milliseconds_per_frame);
    text += "Geometry stats:\n";
    text += fmt::format("  Mesh count: {}\n", g.meshes);
    text += fmt::format("  Mesh instance count (total): {}\n", g.instances);
    text += fmt::format("  Mesh instance count (opaque): {}\n", g.instances);
    text += "  Mesh instance count (non-opaque): 0\n";  // nothing of ours is see-through
    text += fmt::format("  Transform matrix count: {}\n", g.transform_matrices());
    text += fmt::format("  Unique triangle count: {}\n", g.unique_triangles);
    text += fmt::format("  Unique vertex count: {}\n", g.unique_vertices);
    text += fmt::format("  Instanced triangle count: {}\n", g.instanced_triangles);
    text += fmt::format("  Instanced vertex count: {}\n\n", g.instanced_vertices);
    text += fmt::format("Environment map:\n  Resolution: {0}x{0}\n\n", s.resolution);
    text += fmt::format("Rays Stats:\n  Rays Count: {:g}\n  Rays/s: {:.3g}", s.rays.rays,
                        s.rays.per_second);
    return QString::fromStdString(text);
}

}  // namespace asperity::studio
