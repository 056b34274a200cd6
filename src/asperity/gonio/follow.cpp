// SPDX-License-Identifier: Apache-2.0
#include <asperity/gonio/follow.h>

#include <asperity/core/directions.h>
#include <asperity/gonio/known_facets.h>
#include <asperity/gonio/path_kernels.h>

#include <algorithm>
#include <cmath>

namespace asperity {

void Follower::follow(const Scene& scene, const LaunchBatch& batch, std::uint64_t begin,
                      std::uint64_t end, BatchSums& sums) {
    const std::size_t channels =
        scene.fresnel.perfect() ? 0 : static_cast<std::size_t>(scene.fresnel.channels());
    weights_.resize(channels);
    reflectance_.resize(channels);
    for (PerPath<float>& weights : weights_) std::fill_n(weights.values, end - begin, 1.0f);

    // Find the first facet of every ray
    launch(scene, batch, begin, end);
    sums.rays += end - begin;
    sums.segments += end - begin;
    // Some facets are known to send the light out
    settle_known(scene, sums);
    for (int reflections = 0;; ++reflections) {
        // Sort what has left by direction
        settle(scene, reflections, sums);
        const std::size_t under_way = wave_.points.count;
        if (under_way == 0) break;
        // The bounce limit cuts a ray that would need one reflection more
        if (reflections == scene.bounces) {
            for (std::size_t k = 0; k < under_way; ++k)
                paths_[k] = wave_.arriving().path[static_cast<std::size_t>(wave_.points.ray[k])];
            sums.truncate(paths_, under_way, weights_);
            break;
        }
        // Mirror the others at their facets, and find the next facet or the way out
        reflect(scene, in_rows_ && reflections == 0);
        sums.reflections += under_way;
        sums.segments += under_way;
        scene.tracer.leave(wave_);
    }
}

void Follower::launch(const Scene& scene, const LaunchBatch& batch, std::uint64_t begin,
                      std::uint64_t end) {
    in_rows_ = batch.in_rows() && scene.tracer.periodic();
    if (in_rows_)
        launch_rows(scene, batch, begin, end);
    else
        launch_each(scene, batch, begin, end);
}

void Follower::launch_rows(const Scene& scene, const LaunchBatch& batch, std::uint64_t begin,
                           std::uint64_t end) {
    const WideTracer& tracer = scene.tracer;
    const FacetAnswers known = scene.known ? scene.known->cells() : nullptr;
    tracer.clear(wave_);
    const Vec3 d = set_parallel(tracer, batch.incidence(), end - begin, wave_);
    for (std::uint64_t k = begin; k < end;) {
        const LaunchRow row = batch.row(k);
        const auto count = static_cast<int>(std::min(row.count, end - k));
        const auto first = static_cast<int>(k - begin);
        // In a mirrored row the last ray comes first; rays of a row are all alike
        const int cells = tracer.cells_x();
        const int i = tracer.mirrored() ? (2 * cells - row.i - count) % cells : row.i;
        const double u = tracer.mirrored() ? 1 - row.u : row.u;
        if (d.x == 0 && d.y == 0) {
            tracer.launch_down(u, row.v, i, row.j, count, first, known, wave_);
        } else {
            line_.start(tracer.heights(), u, row.v, double{tracer.max_height()}, d);
            tracer.launch(line_, i, row.j, count, first, known, wave_);
        }
        k += static_cast<std::uint64_t>(count);
    }
    tracer.land(wave_);
}

Vec3 set_parallel(const WideTracer& tracer, const Incidence& light, std::size_t count,
                  PathWave& wave) {
    Vec3 d = -from_spherical(light.theta, light.phi);
    if (tracer.mirrored()) d.x = -d.x;
    wave.arriving().x[0] = static_cast<float>(d.x);
    wave.arriving().y[0] = static_cast<float>(d.y);
    wave.arriving().z[0] = static_cast<float>(d.z);
    for (std::size_t k = 0; k < count; ++k) wave.arriving().path[k] = static_cast<std::int32_t>(k);
    return d;
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

void Follower::settle_known(const Scene& scene, BatchSums& sums) {
    const AnsweredRays& answered = wave_.answered;
    if (answered.count == 0) return;
    for (std::size_t c = 0; c < weights_.size(); ++c)
        for (std::size_t k = 0; k < answered.count; ++k)
            weights_[c][static_cast<std::size_t>(answered.ray[k])] =
                scene.known->reflectance(c, static_cast<std::size_t>(answered.facet[k]));
    sums.escape(answered.answer, answered.ray, answered.count, 1, weights_);
    sums.reflections += answered.count;
    sums.segments += answered.count;
}

void Follower::reflect(const Scene& scene, bool parallel) {
    reflect_paths(wave_.points, wave_.arriving(), parallel, scene.tracer.heights(), wave_.leaving(),
                  cosine_);
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
