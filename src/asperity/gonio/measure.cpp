// SPDX-License-Identifier: Apache-2.0
//
// The gonioreflectometer, from light to layers. docs/theory.md, "Measurement", has the equations.
#include <asperity/gonio/measure.h>

#include <asperity/core/energy.h>
#include <asperity/core/error.h>
#include <asperity/core/parallel.h>
#include <asperity/core/version.h>
#include <asperity/gonio/follow.h>
#include <asperity/gonio/known_facets.h>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <mutex>
#include <optional>

namespace asperity {

namespace {

/// A batch larger than this is split: a stopped run loses the batches under way.
constexpr std::uint64_t kLargestBatch = 1 << 20;

/// A layer with nothing in it.
Layer named_layer(const Incidence& light) {
    Layer layer;
    layer.number = light.number;
    layer.theta_i = light.theta;
    layer.phi_i = light.phi;
    return layer;
}

/// How the rays of a layer are divided into independent batches.
struct BatchPlan {
    std::uint64_t rays = 0;     ///< of the first round of batches
    std::uint64_t batches = 0;  ///< in the first round
    std::uint64_t limit = 0;    ///< rays of a layer at most

    /// Rays of batch b: all alike, the first ones of a round one more if they must.
    std::uint64_t rays_of(std::uint64_t b) const {
        return rays / batches + (b % batches < rays % batches ? 1 : 0);
    }
    std::uint64_t largest() const { return rays_of(0); }
};

BatchPlan plan_batches(const Heightfield& surface, const RunSettings& run) {
    BatchPlan plan;
    const double wanted = run.rays > 0 ? static_cast<double>(run.rays)
                                       : run.jitter * static_cast<double>(surface.cell_count());
    if (wanted > static_cast<double>(kMaxRaysPerLayer))
        throw Error(ErrorCode::Usage,
                    fmt::format("{} launch points per cell are {:.3g} rays a layer, more than {}",
                                run.jitter, wanted, kMaxRaysPerLayer),
                    "jitter");
    plan.rays = std::max<std::uint64_t>(2, static_cast<std::uint64_t>(std::llround(wanted)));
    plan.batches = std::min<std::uint64_t>(static_cast<std::uint64_t>(run.batches), plan.rays);
    plan.batches = std::max(plan.batches, (plan.rays + kLargestBatch - 1) / kLargestBatch);
    plan.limit = run.max_rays > 0 ? run.max_rays : std::min(kMaxRaysPerLayer, 256 * plan.rays);
    return plan;
}

/// Shows layers to the listener while they grow.
class LayerPreview {
  public:
    explicit LayerPreview(const MeasureListener& listener) : listener_(listener) {}

    /// Shows what `sums` hold if it is time for it; from any thread. `guard` is held while they are
    /// copied.
    void show(const Incidence& light, const LayerSums& sums, std::mutex& guard) {
        if (!listener_.layer) return;
        const std::unique_lock showing(mutex_, std::try_to_lock);
        const auto begin = Clock::now();
        if (!showing || begin < next_) return;
        Layer layer = named_layer(light);
        {
            const std::scoped_lock lock(guard);
            if (sums.batches() < 2) return;
            sums.write(layer);
        }
        listener_.layer(layer, false);
        const auto end = Clock::now();
        next_ = std::max(begin + kShortestPause, end + 9 * (end - begin));
    }

  private:
    using Clock = std::chrono::steady_clock;
    static constexpr std::chrono::milliseconds kShortestPause{100};

    const MeasureListener& listener_;
    std::mutex mutex_;
    Clock::time_point next_ = Clock::now();
};

/// Measures one layer after the other with the same tools.
class Gonioreflectometer {
  public:
    Gonioreflectometer(const Heightfield& surface, const Experiment& experiment, Run& run,
                       const MeasureListener& listener)
        : surface_(surface),
          experiment_(experiment),
          run_(run),
          listener_(listener),
          preview_(listener),
          fresnel_(experiment.optics),
          detector_(experiment.detector),
          plan_(plan_batches(surface, experiment.run)) {}

    Measurement measure() {
        run_.begin("preparing", surface_.cell_count());
        Measurement m = describe();
        const bool prepared = prepare(m);
        run_.end();
        if (prepared) fill_layers(m);
        m.stopped = run_.stop_requested();
        if (m.stopped) m.notes.emplace_back("stopped before it was complete");
        return m;
    }

  private:
    /// Looks at the surface and builds the tracer; false when it was stopped.
    bool prepare(Measurement& m) {
        try {
            m.surface = statistics(surface_, run_);
            if (listener_.begun) listener_.begun(m);
            tracer_.emplace(surface_, run_);
            return true;
        } catch (const Error& error) {
            if (error.code() != ErrorCode::Stopped) throw;
            return false;
        }
    }

    void fill_layers(Measurement& m) {
        const std::vector<Incidence> light = incidences(experiment_.illumination);
        rays_ahead_ = plan_.rays * light.size();
        run_.begin("tracing", rays_ahead_);
        for (std::size_t k = 0; k < light.size() && run_.keep_going(); ++k) {
            Layer layer = named_layer(light[k]);
            if (!fill(layer, light[k], static_cast<std::uint32_t>(k), m.notes)) continue;
            if (listener_.layer) listener_.layer(layer, true);
            m.layers.push_back(std::move(layer));
        }
        run_.end();
        m.trace_seconds = run_.progress().seconds;
    }

    Measurement describe() const {
        Measurement m;
        m.experiment = experiment_;
        m.detector = detector_;
        m.channel_names = fresnel_.channel_names();
        m.surface_name = surface_.name;
        if (!surface_.tiling.empty()) m.surface_name += ", " + surface_.tiling;
        m.surface_nx = surface_.nx;
        m.surface_ny = surface_.ny;
        m.surface_dx = surface_.dx;
        m.surface_dy = surface_.dy;
        m.surface_isotropic = surface_.isotropic;
        m.threads = run_.threads();
        m.version = kVersion;
        if (experiment_.illumination.isotropic && !surface_.isotropic)
            m.notes.push_back(
                "the surface does not declare itself isotropic: layers are averages over the "
                "azimuth of the light");
        return m;
    }

    /// Fills one layer; false when it was stopped before two batches were complete.
    bool fill(Layer& layer, const Incidence& light, std::uint32_t stream,
              std::vector<std::string>& notes) {
        const KnownFacets known = known_facets(light);
        LayerSums sums(detector_.cells(), fresnel_.channels(), orders(), experiment_.run.bounces,
                       plan_.largest(), &known.light());
        std::uint64_t batches = plan_.batches;
        trace_batches(light, known, stream, 0, batches, sums);

        // Refine until the errors are small enough
        while (experiment_.run.until > 0 && run_.keep_going() && !accurate(sums)) {
            const std::uint64_t room =
                (plan_.limit - std::min(plan_.limit, sums.rays())) / plan_.largest();
            const std::uint64_t more = std::min(batches, room);
            if (more == 0) {
                notes.push_back(fmt::format(
                    "layer {} stopped refining at {} rays: the asked error was not reached",
                    light.number, sums.rays()));
                break;
            }
            rays_ahead_ += more * plan_.largest();
            run_.set_total(rays_ahead_);
            trace_batches(light, known, stream, batches, batches + more, sums);
            batches += more;
        }

        if (sums.batches() < 2) return false;
        sums.write(layer);
        return true;
    }

    /// Traces the batches [begin, end), each by one thread, and adds them to `sums`.
    void trace_batches(const Incidence& light, const KnownFacets& known, std::uint32_t stream,
                       std::uint64_t begin, std::uint64_t end, LayerSums& sums) {
        std::mutex mutex;
        const Scene scene = scene_of(light, &known);
        parallel_for(static_cast<std::size_t>(end - begin), run_.threads(), [&](std::size_t k) {
            const std::uint64_t b = begin + k;
            if (!run_.keep_going()) return;
            std::unique_ptr<Workplace> work = borrow_workplace();
            // Choose start points
            const LaunchBatch batch(surface_, static_cast<double>(tracer_->max_height()), light,
                                    experiment_.run.launch, plan_.rays_of(b), experiment_.run.seed,
                                    stream, static_cast<std::uint32_t>(b));
            // Follow the rays until they leave, and sort them by direction
            for (std::uint64_t part = 0; part < Follower::portions(batch); ++part) {
                if (!run_.keep_going()) return;
                run_.advance(work->follower.follow(scene, batch, part, work->sums));
            }
            work->follower.finish(scene, work->sums);
            // Add the batch to its layer; integers, so the order does not matter
            {
                const std::scoped_lock lock(mutex);
                sums.add(work->sums);
            }
            give_back(std::move(work));
            preview_.show(light, sums, mutex);
        });
    }

    Scene scene_of(const Incidence& light, const KnownFacets* known) const {
        return {*tracer_, fresnel_, detector_, experiment_.run.bounces, light.isotropic, known};
    }
    /// Many rays meet the same facets: what becomes of them is worked out once, where it is
    /// certain.
    KnownFacets known_facets(const Incidence& light) const {
        const bool in_rows =
            experiment_.run.launch == LaunchPattern::LowDiscrepancy && !light.isotropic;
        if (!in_rows || !KnownFacets::pay(*tracer_, plan_.rays)) return {};
        return {scene_of(light, nullptr), light, run_};
    }

    bool accurate(const LayerSums& sums) const {
        const RunSettings& run = experiment_.run;
        const LayerSums::Errors errors = sums.relative_errors();
        const double cells = run.until_cells > 0 ? run.until_cells : run.until;
        return errors.albedo <= run.until && errors.cells <= cells;
    }

    int orders() const { return std::min(experiment_.detector.orders, experiment_.run.bounces); }

    /// The working memory of a thread, used again by the next batch.
    struct Workplace {
        BatchSums sums;
        Follower follower;
    };
    std::unique_ptr<Workplace> borrow_workplace() {
        {
            const std::scoped_lock lock(spare_mutex_);
            if (!spare_.empty()) {
                auto work = std::move(spare_.back());
                spare_.pop_back();
                return work;
            }
        }
        return std::make_unique<Workplace>(Workplace{
            BatchSums(detector_.cells(), fresnel_.channels(), orders(), experiment_.run.bounces),
            Follower()});
    }
    void give_back(std::unique_ptr<Workplace> work) {
        work->sums.clear();
        const std::scoped_lock lock(spare_mutex_);
        spare_.push_back(std::move(work));
    }

    const Heightfield& surface_;
    const Experiment& experiment_;
    Run& run_;
    const MeasureListener& listener_;
    LayerPreview preview_;
    const Fresnel fresnel_;
    std::optional<WideTracer> tracer_;
    const Detector detector_;
    const BatchPlan plan_;
    std::uint64_t rays_ahead_ = 0;
    std::mutex spare_mutex_;
    std::vector<std::unique_ptr<Workplace>> spare_;
};

}  // namespace

Measurement measure(const Heightfield& surface, const Experiment& experiment, Run& run,
                    const MeasureListener& listener) {
    validate(experiment);
    validate(surface, surface.name);
    return Gonioreflectometer(surface, experiment, run, listener).measure();
}

}  // namespace asperity
