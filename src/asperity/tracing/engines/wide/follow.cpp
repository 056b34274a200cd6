// SPDX-License-Identifier: Apache-2.0
#include <asperity/tracing/engines/wide/follow.h>

#include <asperity/core/directions.h>
#include <asperity/tracing/engines/wide/known_facets.h>
#include <asperity/tracing/engines/wide/path_kernels.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace asperity {

namespace {

/// Rows launched one after the other, and how wide a strip of them is at most: so that what the
/// rays see of the surface stays in the second cache from row to row.
constexpr std::uint64_t kRowsOfPortion = 8;
constexpr int kStrip = 512;
/// Waves with less room than for so many more are followed.
constexpr std::size_t kLeastPiece = 64;

}  // namespace

Vec3 direction_of_light(const WideTracer& tracer, const Incidence& light) {
    Vec3 d = -from_spherical(light.theta, light.phi);
    if (tracer.mirrored()) d.x = -d.x;
    return d;
}

bool Follower::follow(const Scene& scene, const BatchRequest& request, BatchSums& sums, Run& run) {
    const std::size_t channels =
        scene.fresnel.perfect() ? 0 : static_cast<std::size_t>(scene.fresnel.channels());
    weights_.resize(channels);
    reflectance_.resize(channels);
    weights_of_.assign(weights_.begin(), weights_.end());
    direction_ = direction_of_light(scene.tracer, scene.light);
    // What a stopped run has left behind
    scene.tracer.clear(wave_);
    counted_ = 0;
    turn_ = {};
    const bool around = SweepsAround::possible(scene.surface, scene.light, request.pattern);
    if (around && !scene.tracer.grid().few_azimuths)
        return follow_around(scene, SweepsAround(scene.surface, scene.light, request), sums, run);
    if (SweepBatch::possible(scene.surface, scene.light, request.pattern))
        return follow_lines(scene, SweepBatch(scene.surface, scene.light, request), sums, run);
    const LaunchBatch batch(scene.surface, double{scene.tracer.max_height()}, scene.light, request);
    // What is left of the lattice's light on periodic surfaces comes straight down, but for light
    // from all around onto facets that look into a few azimuths: from as many as there are rays, or
    // few of its azimuths would tell much of the rest
    const bool in_rows =
        request.pattern == LaunchPattern::LowDiscrepancy && scene.tracer.periodic() && !around;
    return in_rows ? follow_rows(scene, batch, sums, run) : follow_each(scene, batch, sums, run);
}

bool Follower::follow_lines(const Scene& scene, const SweepBatch& batch, BatchSums& sums,
                            Run& run) {
    for (std::uint64_t s = 0; s < batch.stripes(); ++s) {
        if (!run.keep_going()) return false;
        // All stripes of a pass go the same way; what waits to land has gone that of the one before
        if (batch.begins_pass(s)) {
            follow_launched(scene, sums);
            scene.tracer.start(line_, batch.offset(s), direction_);
        }
        run.advance(launch_stripe(scene, batch.stripe(s), sums));
    }
    finish(scene, sums);
    return true;
}

/// Light from all around: sweep by sweep, each sorted by the azimuth from its own.
bool Follower::follow_around(const Scene& scene, const SweepsAround& batch, BatchSums& sums,
                             Run& run) {
    for (std::uint64_t k = 0; k < batch.sweeps(); ++k) {
        const Incidence light = batch.light(k);
        direction_ = direction_of_light(scene.tracer, light);
        turn_ = {static_cast<float>(std::cos(light.phi)), static_cast<float>(std::sin(light.phi))};
        if (!follow_lines(scene, batch.sweep(k), sums, run)) return false;
    }
    return true;
}

bool Follower::follow_rows(const Scene& scene, const LaunchBatch& batch, BatchSums& sums,
                           Run& run) {
    for (std::uint64_t r = 0; r < batch.rows(); r += kRowsOfPortion) {
        if (!run.keep_going()) return false;
        run.advance(launch_rows(scene, batch, r, sums));
    }
    finish(scene, sums);
    // It has no azimuth, so all to count from are as good
    if (scene.light.isotropic) sums.share_rows(static_cast<std::size_t>(scene.detector.columns()));
    return true;
}

bool Follower::follow_each(const Scene& scene, const LaunchBatch& batch, BatchSums& sums,
                           Run& run) {
    if (scene.light.isotropic) turn_ = {1, 0, &cos_phi_, &sin_phi_};
    for (std::uint64_t first = 0; first < batch.rays(); first += kWave) {
        if (!run.keep_going()) return false;
        const std::uint64_t last = std::min(first + kWave, batch.rays());
        launch_each(scene, batch, first, last);
        follow_wave(scene, static_cast<std::size_t>(last - first), false, sums);
        sums.rays += last - first;
        sums.segments += last - first;
        run.advance(last - first);
    }
    return true;
}

/// Launches a stripe of lines, and follows the rays whenever they fill a wave.
std::uint64_t Follower::launch_stripe(const Scene& scene, LaunchStripe stripe, BatchSums& sums) {
    const CountedFacets known = scene.known ? scene.known->counted() : CountedFacets{};
    while (!scene.tracer.launch(line_, stripe, known, wave_)) follow_launched(scene, sums);
    sums.truncate_launched(stripe.under_way());
    const auto rays = std::accumulate(stripe.rays, stripe.rays + stripe.lines, std::uint64_t{0});
    sums.rays += rays;
    sums.segments += rays;
    return rays;
}

/// Launches rows of rays straight down, and follows the rays whenever they fill a wave.
std::uint64_t Follower::launch_rows(const Scene& scene, const LaunchBatch& batch,
                                    std::uint64_t first, BatchSums& sums) {
    const WideTracer& tracer = scene.tracer;
    const CountedFacets known = scene.known ? scene.known->counted() : CountedFacets{};
    const int cells = tracer.cells_x();
    std::uint64_t rays = 0;
    rows_.clear();
    for (std::uint64_t r = first; r < std::min(first + kRowsOfPortion, batch.rows()); ++r) {
        LaunchRow row = batch.row(r);
        if (tracer.mirrored()) {
            // The last ray comes first; rays of a row are all alike
            row.i = (2 * cells - row.i - static_cast<int>(row.count)) % cells;
            row.u = 1 - row.u;
        }
        rays += row.count;
        rows_.push_back(row);
    }
    for (int x = 0; x < cells; x += kStrip) {
        const int end = std::min(x + kStrip, cells);
        for (const LaunchRow& row : rows_) {
            // A row may pass the end of the tile and go on at its beginning
            for (const int begin : {0, cells}) {
                const int from = std::max(x + begin, row.i);
                const int to = std::min(end + begin, row.i + static_cast<int>(row.count));
                for (int i = from, count = 0; i < to; i += count) {
                    const std::size_t room = kWave - tracer.launched(wave_);
                    count = std::min(static_cast<int>(room), to - i);
                    tracer.launch_down(row.u, row.v, {i % cells, row.j, count}, known, wave_);
                    if (tracer.launched(wave_) + kLeastPiece > kWave) follow_launched(scene, sums);
                }
            }
        }
    }
    sums.rays += rays;
    sums.segments += rays;
    return rays;
}

/// Follows the rays that still wait, and spreads the light of those that were only counted.
void Follower::finish(const Scene& scene, BatchSums& sums) {
    follow_launched(scene, sums);
    if (counted_ > 0) sums.escape_spread(counted_, scene.known->light());
    sums.reflections += counted_;
    sums.segments += counted_;
    counted_ = 0;
}

/// Follows the rays of parallel light that have been launched.
void Follower::follow_launched(const Scene& scene, BatchSums& sums) {
    // Some are only counted
    counted_ += wave_.counted;
    if (direction_.x != 0 || direction_.y != 0) scene.tracer.land(line_, direction_, wave_);
    for (std::size_t k = 0; k < wave_.points.count; ++k)
        wave_.points.path[k] = static_cast<std::int32_t>(k);
    follow_wave(scene, wave_.points.count, true, sums);
}

/// Follows the rays that stand at their first facets, or have met none, until the last has ended.
void Follower::follow_wave(const Scene& scene, std::size_t count, bool parallel, BatchSums& sums) {
    // The first reflection of parallel light sets them
    if (!parallel)
        for (PerPath<float>& weights : weights_) std::fill_n(weights.values, count, 1.0f);
    for (int reflections = 0;; ++reflections) {
        // Sort what has left by direction
        settle(scene, reflections, sums);
        const std::size_t under_way = wave_.points.count;
        if (under_way == 0) break;
        // The bounce limit cuts a ray that would need one reflection more
        if (reflections == scene.bounces) {
            sums.truncate(wave_.points.path, under_way, weights_of_);
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
        if (scene.light.isotropic) {
            cos_phi_[rays_.size()] = static_cast<float>(start.cos_phi_i);
            sin_phi_[rays_.size()] = static_cast<float>(start.sin_phi_i);
        }
        rays_.push_back(start.ray);
    }
    scene.tracer.enter(rays_, wave_);
}

void Follower::reflect(const Scene& scene, bool parallel) {
    reflect_paths(wave_.points, parallel ? &direction_ : nullptr, scene.tracer.heights(),
                  wave_.leaving(), weights_.empty() ? nullptr : &cosine_);
    // Each facet takes its share
    const std::size_t count = wave_.points.count;
    if (weights_.empty()) return;
    std::vector<float*> out;
    for (PerPath<float>& f : parallel ? weights_ : reflectance_) out.push_back(f);
    scene.fresnel.eval({cosine_.values, count}, out);
    if (parallel) return;  // path k is at point k
    const std::int32_t* path = wave_.leaving().path;
    for (std::size_t c = 0; c < weights_.size(); ++c) {
        float* weight = weights_[c];
        const float* share = reflectance_[c];
        for (std::size_t k = 0; k < count; ++k) weight[path[k]] *= share[k];
    }
}

void Follower::settle(const Scene& scene, int reflections, BatchSums& sums) {
    const Escapes& escapes = wave_.escapes;
    if (escapes.count > 0) {
        find_cells(escapes, scene.detector, scene.tracer.mirrored() ? -1.0f : 1.0f, turn_, cells_);
        sums.escape(0, reflections, cells_, escapes.path, escapes.count, weights_of_);
    }
    sums.lose_at_edge(wave_.edge, wave_.edge_count, weights_of_);
    sums.truncate(wave_.stuck, wave_.stuck_count, weights_of_);
    sums.stuck += wave_.stuck_count;
}

}  // namespace asperity
