// SPDX-License-Identifier: Apache-2.0
//
// Single paths of light, followed with the plain tracer so that they can be seen.
#include <asperity/gonio/light_paths.h>

#include <asperity/core/energy.h>
#include <asperity/core/error.h>
#include <asperity/core/parallel.h>
#include <asperity/detector/detector.h>
#include <asperity/tracing/launch.h>
#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <iterator>

namespace asperity {

namespace {

/// Paths a thread follows at a time, and chunks between two looks at what was found.
constexpr std::uint64_t kChunk = 256, kChunksPerRound = 64;

PathEnd path_end(RayEnd end) {
    return end == RayEnd::Escaped ? PathEnd::Escaped
           : end == RayEnd::Edge  ? PathEnd::Edge
                                  : PathEnd::Stuck;
}

/// The paths of one layer, by their numbers.
class LightOfLayer {
  public:
    LightOfLayer(const Tracer& tracer, const Experiment& experiment, int layer)
        : tracer_(tracer),
          detector_(experiment.detector),
          bounces_(static_cast<std::size_t>(experiment.run.bounces)),
          launches_(launches(tracer, experiment, layer)) {}

    const Detector& detector() const { return detector_; }

    /// Path k, k < kMaxRaysPerLayer; into `path`, whose memory is used again.
    void follow(std::uint64_t k, LightPath& path) const {
        const Launch launch = launches_.launch(k);
        Ray ray = launch.ray;
        path.wi = -ray.direction;
        path.launched = position(ray);
        path.points.clear();
        path.facets.clear();
        path.wo = {};
        path.cell = -1;
        for (;;) {
            // Find the next facet or the way out
            RayEnd end = RayEnd::Hit;
            tracer_.trace({&ray, 1}, {&end, 1});
            if (end != RayEnd::Hit) {
                path.end = path_end(end);
                path.wo = ray.direction;
                if (end == RayEnd::Escaped) path.cell = cell_of(path.wo, launch.phi_i);
                return;
            }
            path.points.push_back(position(ray));
            path.facets.push_back({ray.i, ray.j, static_cast<Triangle>(ray.facet)});
            // The bounce limit cuts a path that would need one reflection more
            if (path.points.size() > bounces_) {
                path.end = PathEnd::Truncated;
                return;
            }
            ray.direction = normalize(reflect(-ray.direction, tracer_.normal(ray)));
        }
    }

  private:
    /// Random launch points: path k does not depend on how many there are.
    static LaunchBatch launches(const Tracer& tracer, const Experiment& experiment, int layer) {
        validate(experiment);
        const std::vector<Incidence> light = incidences(experiment.illumination);
        const auto found = std::find_if(light.begin(), light.end(),
                                        [&](const Incidence& l) { return l.number == layer; });
        if (found == light.end())
            throw Error(ErrorCode::Usage, fmt::format("there is no layer {}", layer), "layer");
        const auto stream = static_cast<std::uint32_t>(found - light.begin());
        return {tracer.surface(),
                double{tracer.max_height()},
                *found,
                {LaunchPattern::Random, kMaxRaysPerLayer, experiment.run.seed, stream, 0}};
    }

    Vec3 position(const Ray& ray) const {
        const Heightfield& s = tracer_.surface();
        const double column = static_cast<double>(ray.tiles_x) * s.cells_x() + ray.i;
        const double row = static_cast<double>(ray.tiles_y) * s.cells_y() + ray.j;
        return {(column + ray.u) * s.dx, (row + ray.v) * s.dy, ray.z};
    }

    int cell_of(Vec3 wo, double phi_i) const {
        const bool relative = launches_.incidence().isotropic;
        return detector_.cell_of(relative ? rotate_z(wo, -phi_i) : wo);
    }

    const Tracer& tracer_;
    const Detector detector_;
    const std::size_t bounces_;
    const LaunchBatch launches_;
};

/// The first `wanted` paths among the first `most_tried` that are chosen. Chunks of the sequence
/// are followed side by side and looked through in order, so threads do not matter.
LightPathsFound first_paths(const LightOfLayer& light,
                            const std::function<bool(const LightPath&)>& chosen, std::size_t wanted,
                            std::uint64_t most_tried, Run& run) {
    struct Chunk {
        std::vector<LightPath> paths;
        std::vector<std::uint64_t> numbers;
        bool complete = false;
    };
    LightPathsFound found;
    const std::uint64_t most = std::min(most_tried, kMaxRaysPerLayer);
    run.begin("following light", most);
    while (found.paths.size() < wanted && found.tried < most && run.keep_going()) {
        const std::uint64_t begin = found.tried;
        const std::uint64_t count = std::min(kChunk * kChunksPerRound, most - begin);
        std::vector<Chunk> chunks((count + kChunk - 1) / kChunk);
        parallel_for(chunks.size(), run.threads(), [&](std::size_t c) {
            const std::uint64_t first = begin + c * kChunk;
            const std::uint64_t last = std::min(first + kChunk, begin + count);
            LightPath path;
            for (std::uint64_t k = first; k < last; ++k) {
                if (!run.keep_going()) return;
                light.follow(k, path);
                if (!chosen(path)) continue;
                chunks[c].paths.push_back(path);
                chunks[c].numbers.push_back(k);
            }
            chunks[c].complete = true;
            run.advance(last - first);
        });
        // Take what is wanted, up to where the run was stopped
        for (std::size_t c = 0; c < chunks.size() && chunks[c].complete; ++c) {
            const std::size_t room = wanted - found.paths.size();
            const std::size_t taken = std::min(room, chunks[c].paths.size());
            std::move(chunks[c].paths.begin(),
                      chunks[c].paths.begin() + static_cast<std::ptrdiff_t>(taken),
                      std::back_inserter(found.paths));
            if (taken == room) {
                found.tried = chunks[c].numbers[taken - 1] + 1;
                break;
            }
            found.tried = std::min(begin + (c + 1) * kChunk, most);
        }
    }
    run.end();
    return found;
}

}  // namespace

std::vector<LightPath> sample_light_paths(const Tracer& tracer, const Experiment& experiment,
                                          int layer, std::size_t count, Run& run) {
    const LightOfLayer light(tracer, experiment, layer);
    return first_paths(
               light, [](const LightPath&) { return true; }, count, count, run)
        .paths;
}

LightPathsFound paths_into_cells(const Tracer& tracer, const Experiment& experiment, int layer,
                                 std::span<const int> cells, std::size_t wanted,
                                 std::uint64_t most_tried, Run& run) {
    const LightOfLayer light(tracer, experiment, layer);
    std::vector<bool> in_cells(static_cast<std::size_t>(light.detector().cells()));
    for (const int cell : cells) {
        if (cell < 0 || cell >= light.detector().cells())
            throw Error(ErrorCode::Usage, fmt::format("the detector has no cell {}", cell), "cell");
        in_cells[static_cast<std::size_t>(cell)] = true;
    }
    const auto chosen = [&](const LightPath& path) {
        return path.end == PathEnd::Escaped && in_cells[static_cast<std::size_t>(path.cell)];
    };
    return first_paths(light, chosen, wanted, most_tried, run);
}

}  // namespace asperity
