// SPDX-License-Identifier: Apache-2.0
#include <asperity/tracing/engines/wide/wide_engine.h>

#include <asperity/tracing/engines/wide/follow.h>
#include <asperity/tracing/engines/wide/known_facets.h>

namespace asperity {

namespace {

struct WideWorker : Worker {
    Follower follower;
};

class WideLight : public LitSurface {
  public:
    WideLight(const EngineSetup& setup, const WideTracer& tracer, const Incidence& incidence)
        : scene_{setup.surface, tracer, setup.fresnel, setup.detector, setup.bounces, incidence} {}

    /// Many rays meet the same facets: what becomes of them is worked out once, where it is
    /// certain.
    void look_at_facets(const Run& run, int threads) {
        known_ = KnownFacets(scene_, run, threads);
        scene_.known = &known_;
    }

    bool trace(const BatchRequest& batch, Worker& worker, BatchSums& sums,
               Run& run) const override {
        return static_cast<WideWorker&>(worker).follower.follow(scene_, batch, sums, run);
    }

  private:
    Scene scene_;
    KnownFacets known_;
};

class WideEngine : public Engine {
  public:
    WideEngine(const EngineSetup& setup, Run& run) : setup_(setup), tracer_(setup.surface, run) {}

    std::unique_ptr<LitSurface> light(const Incidence& incidence, LaunchPattern pattern,
                                      std::uint64_t rays, const Run& run,
                                      int threads) const override {
        auto light = std::make_unique<WideLight>(setup_, tracer_, incidence);
        const bool lattice = pattern == LaunchPattern::LowDiscrepancy;
        const bool one_direction = !incidence.isotropic || incidence.theta == 0;
        if (lattice && one_direction && KnownFacets::pay(tracer_, rays))
            light->look_at_facets(run, threads);
        return light;
    }

    std::unique_ptr<Worker> worker() const override { return std::make_unique<WideWorker>(); }
    std::size_t memory_bytes() const override { return tracer_.memory_bytes(); }

  private:
    const EngineSetup setup_;
    const WideTracer tracer_;
};

}  // namespace

std::unique_ptr<Engine> make_wide_engine(const EngineSetup& setup, Run& run) {
    return std::make_unique<WideEngine>(setup, run);
}

}  // namespace asperity
