// SPDX-License-Identifier: Apache-2.0
// The product as a rival: what measure() does for one layer, without what it does once per run.
// Launch points, order counts, exact energies and error bars are part of its time.
#include "clocks.h"
#include "rival.h"

#include <asperity/core/directions.h>
#include <asperity/core/energy.h>
#include <asperity/gonio/layer_of_sums.h>
#include <asperity/tracing/engine.h>

#include <algorithm>

namespace asperity::bench {

namespace {

/// As in measure().
constexpr std::uint64_t kBatches = 16, kLargestBatch = 1 << 20;

DetectorSettings detector_settings() {
    DetectorSettings settings;
    settings.kind = DetectorKind::EqualArea;
    settings.resolution = DirectionCells::kColumns;
    return settings;
}

class OwnRival : public Rival {
  public:
    OwnRival(const Heightfield& surface, int threads)
        : begin_(wall_seconds()),
          fresnel_(OpticsSettings{}),
          detector_(detector_settings()),
          run_(threads),
          engine_(
              engines().front().make({surface, fresnel_, detector_, RunSettings{}.bounces}, run_)),
          build_seconds_(wall_seconds() - begin_) {}

    std::string name() const override { return "asperity"; }
    std::size_t memory_bytes() const override { return engine_->memory_bytes(); }
    double build_seconds() const override { return build_seconds_; }
    bool follows_points() const override { return false; }

    Tally run(const Workload& workload) const override {
        const std::uint64_t rays = workload.own_paths;
        const std::uint64_t batches =
            std::max(std::min(kBatches, rays), (rays + kLargestBatch - 1) / kLargestBatch);
        const SumShape shape{.cells = static_cast<std::size_t>(detector_.cells()),
                             .orders = static_cast<std::size_t>(DetectorSettings{}.orders),
                             .bounces = static_cast<std::size_t>(workload.bounces)};
        const Incidence light{1, radians(workload.theta_deg), radians(kPhiDeg), false};
        constexpr auto kPattern = LaunchPattern::LowDiscrepancy;
        Run run(1);
        const auto lit = engine_->light(light, kPattern, rays, run, 1);
        const auto worker = engine_->worker();
        LayerSums layer_sums(shape, (rays + batches - 1) / batches);
        BatchSums sums(shape);
        for (std::uint64_t b = 0; b < batches; ++b) {
            const std::uint64_t size = rays / batches + (b < rays % batches ? 1 : 0);
            lit->trace({kPattern, size, workload.seed, 0, static_cast<std::uint32_t>(b)}, *worker,
                       sums, run);
            layer_sums.add(b, sums);
            sums.clear();
        }
        return tally_of(layer_of(light, layer_sums));
    }

  private:
    static double rays_of(std::uint64_t energy) {
        return static_cast<double>(energy) / static_cast<double>(kRayEnergy);
    }
    Tally tally_of(const Layer& layer) const {
        Tally tally;
        const auto cells = static_cast<std::size_t>(detector_.cells());
        for (std::size_t k = 0; k < layer.energy.size(); ++k) {
            tally.add_escapes(static_cast<int>(k % cells), rays_of(layer.energy[k]));
        }
        tally.add_truncated(rays_of(layer.truncated[0]) - static_cast<double>(layer.stuck), 0);
        tally.add_lost(layer.stuck);
        tally.add_reflections(layer.reflections);
        tally.add_segments(layer.segments);
        return tally;
    }

    double begin_;
    Fresnel fresnel_;
    Detector detector_;
    Run run_;
    std::unique_ptr<Engine> engine_;
    double build_seconds_;
};

}  // namespace

std::unique_ptr<Rival> make_own_rival(const Heightfield& surface, int threads) {
    return std::make_unique<OwnRival>(surface, threads);
}

}  // namespace asperity::bench
