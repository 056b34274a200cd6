// SPDX-License-Identifier: Apache-2.0
#include <asperity/gonio/follow.h>

#include <asperity/core/directions.h>
#include <asperity/gonio/known_facets.h>
#include <asperity/gonio/path_kernels.h>

#include <algorithm>
#include <cmath>

namespace asperity {

namespace {

/// Rows launched one after the other, and how wide a strip of them is at most: so that what the
/// rays see of the surface stays in the second cache from row to row.
constexpr std::uint64_t kRowsOfPortion = 8;
constexpr int kStrip = 512;
/// Rays launched at a time.
constexpr int kPiece = 64;

}  // namespace

Vec3 direction_of_light(const WideTracer& tracer, const Incidence& light) {
    Vec3 d = -from_spherical(light.theta, light.phi);
    if (tracer.mirrored()) d.x = -d.x;
    return d;
}

std::uint64_t Follower::end_of_portion(const LaunchBatch& batch, std::uint64_t begin) {
    if (!batch.in_rows()) return std::min(begin + kWave, batch.rays());
    return batch.end_of_rows(begin, kRowsOfPortion);
}

void Follower::follow(const Scene& scene, const LaunchBatch& batch, std::uint64_t begin,
                      std::uint64_t end, BatchSums& sums) {
    const std::size_t channels =
        scene.fresnel.perfect() ? 0 : static_cast<std::size_t>(scene.fresnel.channels());
    weights_.resize(channels);
    reflectance_.resize(channels);
    sums.rays += end - begin;
    sums.segments += end - begin;
    if (batch.in_rows() && scene.tracer.periodic()) {
        follow_rows(scene, batch, begin, end, sums);
        return;
    }
    for (std::uint64_t first = begin; first < end; first += kWave) {
        const std::uint64_t last = std::min(first + kWave, end);
        launch_each(scene, batch, first, last);
        follow_wave(scene, static_cast<std::size_t>(last - first), false, sums);
    }
}

void Follower::finish(const Scene& scene, BatchSums& sums) {
    follow_launched(scene, sums);
}

void Follower::follow_rows(const Scene& scene, const LaunchBatch& batch, std::uint64_t begin,
                           std::uint64_t end, BatchSums& sums) {
    const WideTracer& tracer = scene.tracer;
    direction_ = direction_of_light(tracer, batch.incidence());
    rows_.clear();
    for (std::uint64_t k = begin; k < end; k += rows_.back().count) {
        LaunchRow row = batch.row(k);
        row.count = std::min(row.count, end - k);
        if (tracer.mirrored()) {
            // The last ray comes first; rays of a row are all alike
            const int cells = tracer.cells_x();
            row.i = (2 * cells - row.i - static_cast<int>(row.count)) % cells;
            row.u = 1 - row.u;
        }
        rows_.push_back(row);
    }
    if (direction_.x != 0 || direction_.y != 0) {
        if (lines_.size() < rows_.size()) lines_.resize(rows_.size());
        for (std::size_t r = 0; r < rows_.size(); ++r)
            lines_[r].start(tracer.heights(), rows_[r].u, rows_[r].v, double{tracer.max_height()},
                            direction_);
    }
    launch_rows(scene, sums);
}

/// Launches the rows, and follows the rays whenever there are enough for a wave.
void Follower::launch_rows(const Scene& scene, BatchSums& sums) {
    const WideTracer& tracer = scene.tracer;
    const CountedFacets known = scene.known ? scene.known->counted() : CountedFacets{};
    const int cells = tracer.cells_x();
    const bool down = direction_.x == 0 && direction_.y == 0;
    for (int x = 0; x < cells; x += kStrip) {
        const int end = std::min(x + kStrip, cells);
        for (std::size_t r = 0; r < rows_.size(); ++r) {
            // A row may pass the end of the tile and go on at its beginning
            const LaunchRow& row = rows_[r];
            for (const int begin : {0, cells}) {
                const int from = std::max(x + begin, row.i);
                const int to = std::min(end + begin, row.i + static_cast<int>(row.count));
                for (int i = from; i < to; i += kPiece) {
                    if (tracer.launched(wave_) + kPiece > kWave) follow_launched(scene, sums);
                    const LaunchedRow piece{i % cells, row.j, std::min(kPiece, to - i), 0};
                    if (down)
                        tracer.launch_down(row.u, row.v, piece, known, wave_);
                    else
                        tracer.launch(lines_[r], piece, known, wave_);
                }
            }
        }
    }
}

/// Follows the rays of rows that have been launched.
void Follower::follow_launched(const Scene& scene, BatchSums& sums) {
    // Some are only counted
    if (wave_.counted > 0) sums.escape_counted(wave_.counted, scene.known->light());
    sums.reflections += wave_.counted;
    sums.segments += wave_.counted;
    scene.tracer.land(direction_, wave_);
    for (std::size_t k = 0; k < wave_.points.count; ++k)
        wave_.points.path[k] = static_cast<std::int32_t>(k);
    follow_wave(scene, wave_.points.count, true, sums);
}

/// Follows the rays that stand at their first facets, or have met none, until the last has ended.
void Follower::follow_wave(const Scene& scene, std::size_t count, bool parallel, BatchSums& sums) {
    for (PerPath<float>& weights : weights_) std::fill_n(weights.values, count, 1.0f);
    for (int reflections = 0;; ++reflections) {
        // Sort what has left by direction
        settle(scene, reflections, sums);
        const std::size_t under_way = wave_.points.count;
        if (under_way == 0) break;
        // The bounce limit cuts a ray that would need one reflection more
        if (reflections == scene.bounces) {
            sums.truncate(wave_.points.path, under_way, weights_);
            break;
        }
        // Mirror the others at their facets, and find the next facet or the way out
        reflect(scene, parallel && reflections == 0);
        sums.reflections += under_way;
        sums.segments += under_way;
        scene.tracer.leave(wave_);
    }
    scene.tracer.clear(wave_);
}

void Follower::launch_each(const Scene& scene, const LaunchBatch& batch, std::uint64_t begin,
                           std::uint64_t end) {
    rays_.clear();
    for (std::uint64_t k = begin; k < end; ++k) {
        const Launch start = batch.launch(k);
        if (scene.relative_azimuth) {
            cos_phi_[rays_.size()] = static_cast<float>(std::cos(start.phi_i));
            sin_phi_[rays_.size()] = static_cast<float>(std::sin(start.phi_i));
        }
        rays_.push_back(start.ray);
    }
    scene.tracer.enter(rays_, wave_);
}

void Follower::reflect(const Scene& scene, bool parallel) {
    reflect_paths(wave_.points, parallel ? &direction_ : nullptr, scene.tracer.heights(),
                  wave_.leaving(), cosine_);
    // Each facet takes its share
    const std::size_t count = wave_.points.count;
    if (weights_.empty()) return;
    std::vector<float*> out;
    for (PerPath<float>& f : reflectance_) out.push_back(f);
    scene.fresnel.eval({cosine_.values, count}, out);
    for (std::size_t c = 0; c < weights_.size(); ++c)
        for (std::size_t k = 0; k < count; ++k)
            weights_[c][static_cast<std::size_t>(wave_.leaving().path[k])] *= reflectance_[c][k];
}

void Follower::settle(const Scene& scene, int reflections, BatchSums& sums) {
    const Escapes& escapes = wave_.escapes;
    if (escapes.count > 0) {
        find_cells(escapes, scene.detector, scene.tracer.mirrored() ? -1.0f : 1.0f,
                   scene.relative_azimuth ? &cos_phi_ : nullptr,
                   scene.relative_azimuth ? &sin_phi_ : nullptr, cells_);
        sums.escape(cells_, escapes.path, escapes.count, reflections, weights_);
    }
    sums.lose_at_edge(wave_.edge, wave_.edge_count, weights_);
    sums.truncate(wave_.stuck, wave_.stuck_count, weights_);
    sums.stuck += wave_.stuck_count;
}

}  // namespace asperity
