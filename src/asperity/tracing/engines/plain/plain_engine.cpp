// SPDX-License-Identifier: Apache-2.0
//
// Light, one ray at a time. docs/theory.md, "Measurement", has the equations.
#include <asperity/tracing/engines/plain/plain_engine.h>

#include <asperity/core/directions.h>
#include <asperity/tracing/engines/plain/tracer.h>

#include <algorithm>
#include <vector>

namespace asperity {

namespace {

/// Rays between two looks at whether the run goes on.
constexpr std::uint64_t kRaysAtOnce = 4096;

/// What is left of one ray, by channel.
struct PlainWorker : Worker {
    std::vector<double> reflectance;
    std::vector<float> weight;
    std::vector<const float*> weights;  ///< of path 0, as BatchSums wants them; none for mirrors
};

class PlainLight : public LitSurface {
  public:
    PlainLight(const EngineSetup& setup, const Tracer& tracer, const Incidence& incidence)
        : setup_(setup), tracer_(tracer), incidence_(incidence) {}

    bool trace(const BatchRequest& request, Worker& worker, BatchSums& sums,
               Run& run) const override {
        // Choose start points
        const LaunchBatch batch(setup_.surface, double{tracer_.max_height()}, incidence_, request);
        for (std::uint64_t k = 0; k < batch.rays(); k += kRaysAtOnce) {
            if (!run.keep_going()) return false;
            const std::uint64_t end = std::min(k + kRaysAtOnce, batch.rays());
            for (std::uint64_t ray = k; ray < end; ++ray)
                follow(batch.launch(ray), static_cast<PlainWorker&>(worker), sums);
            run.advance(end - k);
        }
        return true;
    }

  private:
    /// Follows the ray until it leaves.
    void follow(const Launch& launch, PlainWorker& worker, BatchSums& sums) const {
        constexpr std::int32_t kPath = 0;
        Ray ray = launch.ray;
        std::fill(worker.weight.begin(), worker.weight.end(), 1.0f);
        ++sums.rays;
        for (int reflections = 0;; ++reflections) {
            // Find the next facet or the way out
            RayEnd end = RayEnd::Hit;
            tracer_.trace({&ray, 1}, {&end, 1});
            ++sums.segments;
            if (end == RayEnd::Escaped) {
                // Find the cell
                const Vec3 wo =
                    incidence_.isotropic ? rotate_z(ray.direction, -launch.phi_i) : ray.direction;
                const std::int32_t cell = setup_.detector.cell_of(wo);
                return sums.escape(0, reflections, &cell, &kPath, 1, worker.weights);
            }
            if (end == RayEnd::Edge) return sums.lose_at_edge(&kPath, 1, worker.weights);
            if (end == RayEnd::Stuck) ++sums.stuck;
            // The bounce limit cuts a ray that would need one reflection more
            if (end == RayEnd::Stuck || reflections == setup_.bounces)
                return sums.truncate(&kPath, 1, worker.weights);
            // The facet mirrors it and takes its share
            const Vec3 wi = -ray.direction, wm = tracer_.normal(ray);
            ray.direction = normalize(reflect(wi, wm));
            ++sums.reflections;
            if (setup_.fresnel.perfect()) continue;
            setup_.fresnel.eval(std::min(1.0, dot(wi, wm)), worker.reflectance);
            for (std::size_t c = 0; c < worker.weight.size(); ++c)
                worker.weight[c] *= static_cast<float>(worker.reflectance[c]);
        }
    }

    const EngineSetup& setup_;
    const Tracer& tracer_;
    const Incidence incidence_;
};

class PlainEngine : public Engine {
  public:
    PlainEngine(const EngineSetup& setup, int threads)
        : setup_(setup), tracer_(setup.surface, threads) {}

    std::unique_ptr<LitSurface> light(const Incidence& incidence, LaunchPattern, std::uint64_t,
                                      const Run&, int) const override {
        return std::make_unique<PlainLight>(setup_, tracer_, incidence);
    }

    std::unique_ptr<Worker> worker() const override {
        auto worker = std::make_unique<PlainWorker>();
        if (setup_.fresnel.perfect()) return worker;
        const auto channels = static_cast<std::size_t>(setup_.fresnel.channels());
        worker->reflectance.resize(channels);
        worker->weight.resize(channels);
        for (const float& weight : worker->weight) worker->weights.push_back(&weight);
        return worker;
    }

    std::size_t memory_bytes() const override { return tracer_.memory_bytes(); }

  private:
    const EngineSetup setup_;
    const Tracer tracer_;
};

}  // namespace

std::unique_ptr<Engine> make_plain_engine(const EngineSetup& setup, Run& run) {
    auto engine = std::make_unique<PlainEngine>(setup, run.threads());
    run.advance(setup.surface.cell_count());
    return engine;
}

}  // namespace asperity
