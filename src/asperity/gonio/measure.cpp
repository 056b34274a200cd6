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
#include <asperity/gonio/layer_report.h>
#include <asperity/gonio/layer_schedule.h>
#include <asperity/tracing/scale.h>
#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <deque>
#include <mutex>
#include <optional>
#include <vector>

namespace asperity {

namespace {

/// A batch larger than this is split: a stopped run loses the batches under way.
constexpr std::uint64_t kLargestBatch = 1 << 20;

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

/// A layer on its way.
struct LayerInWork {
    LayerInWork(const Incidence& incidence, std::uint32_t number)
        : light(incidence), stream(number) {}

    const Incidence light;
    const std::uint32_t stream;      ///< of random numbers
    KnownFacets known;               ///< once it is prepared
    std::mutex mutex;                ///< guards the sums
    std::optional<LayerSums> sums;   ///< once a batch is done, until it is complete
    std::vector<std::string> notes;  ///< for the reader of the result

    /// What the sums hold; false if that is too little to tell errors.
    bool write(Layer& layer) const {
        if (!sums || sums->batches() < 2) return false;
        layer.number = light.number;
        layer.theta_i = light.theta;
        layer.phi_i = light.phi;
        sums->write(layer);
        return true;
    }
};

/// Measures the layers, one after the other, with the same tools.
class Gonioreflectometer {
  public:
    Gonioreflectometer(const Heightfield& surface, const Experiment& experiment, Run& run,
                       const MeasureListener& listener)
        : surface_(surface),
          experiment_(experiment),
          run_(run),
          listener_(listener),
          fresnel_(experiment.optics),
          detector_(experiment.detector),
          plan_(plan_batches(surface, experiment.run)),
          layers_(layers_to_fill(experiment.illumination)),
          schedule_(layers_.size(), plan_.batches),
          report_(listener, layers_.size()) {}

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
    static std::deque<LayerInWork> layers_to_fill(const IlluminationSettings& settings) {
        std::deque<LayerInWork> layers;
        for (const Incidence& light : incidences(settings))
            layers.emplace_back(light, static_cast<std::uint32_t>(layers.size()));
        return layers;
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

    /// Looks at the surface and builds the tracer; false when it was stopped.
    bool prepare(Measurement& m) {
        try {
            m.surface = statistics(surface_, run_);
            std::vector<double> angles;
            for (const LayerInWork& layer : layers_) angles.push_back(layer.light.theta);
            check_scale(surface_, m.surface.min_height, m.surface.max_height, angles);
            if (listener_.begun) listener_.begun(m);
            tracer_.emplace(surface_, run_);
            return true;
        } catch (const Error& error) {
            if (error.code() != ErrorCode::Stopped) throw;
            return false;
        }
    }

    void fill_layers(Measurement& m) {
        rays_ahead_ = plan_.rays * layers_.size();
        run_.begin("tracing", rays_ahead_);
        // All threads prepare the first layer; each of the others is prepared by one of them while
        // the one before is traced
        if (const auto first = schedule_.next()) prepare_layer(first->layer, run_.threads());
        const auto workers = static_cast<std::size_t>(run_.threads());
        parallel_for(workers, run_.threads(), [&](std::size_t) { work(); });
        run_.end();
        m.trace_seconds = run_.progress().seconds;

        // Of a stopped run also what is there of the layers under way
        for (std::size_t k = 0; k < layers_.size(); ++k) {
            if (Layer layer; layers_[k].write(layer)) report_.complete(k, std::move(layer));
            m.notes.insert(m.notes.end(), layers_[k].notes.begin(), layers_[k].notes.end());
        }
        m.layers = report_.finish();
    }

    /// What each thread does until all layers are complete, or the run is stopped.
    void work() {
        // Nobody waits for a thread that has left
        struct Leave {
            LayerSchedule& schedule;
            ~Leave() { schedule.give_up(); }
        } const leave{schedule_};
        Follower follower;
        BatchSums sums(detector_.cells(), fresnel_.channels(), orders(), experiment_.run.bounces);
        while (run_.keep_going()) {
            const auto piece = schedule_.next();
            if (!piece) return;
            LayerInWork& layer = layers_[piece->layer];
            if (piece->kind == LayerSchedule::Piece::Kind::Prepare) {
                prepare_layer(piece->layer, 1);
            } else if (trace(layer, piece->batch, follower, sums)) {
                report_.grown(piece->layer, [&](Layer& grown) {
                    const std::scoped_lock lock(layer.mutex);
                    return layer.write(grown);
                });
                if (schedule_.traced(piece->layer)) extend_or_close(piece->layer);
            }
        }
    }

    /// Many rays meet the same facets: what becomes of them is worked out once, where it is
    /// certain.
    void prepare_layer(std::size_t k, int threads) {
        LayerInWork& layer = layers_[k];
        const bool in_rows =
            experiment_.run.launch == LaunchPattern::LowDiscrepancy && !layer.light.isotropic;
        if (in_rows && KnownFacets::pay(*tracer_, plan_.rays))
            layer.known = KnownFacets(scene_of(layer), layer.light, run_, threads);
        schedule_.prepared(k);
    }

    /// Traces a batch and adds it to its layer; false if the run was stopped before the end.
    bool trace(LayerInWork& layer, std::uint64_t b, Follower& follower, BatchSums& sums) {
        const Scene scene = scene_of(layer);
        // Choose start points
        const LaunchBatch batch(surface_, static_cast<double>(tracer_->max_height()), layer.light,
                                experiment_.run.launch, plan_.rays_of(b), experiment_.run.seed,
                                layer.stream, static_cast<std::uint32_t>(b));
        // Follow the rays until they leave, and sort them by direction
        for (std::uint64_t part = 0; part < Follower::portions(batch); ++part) {
            if (!run_.keep_going()) return false;
            run_.advance(follower.follow(scene, batch, part, sums));
        }
        follower.finish(scene, sums);
        // Add them to the layer; integers, so the order does not matter
        {
            const std::scoped_lock lock(layer.mutex);
            if (!layer.sums)
                layer.sums.emplace(detector_.cells(), fresnel_.channels(), orders(),
                                   experiment_.run.bounces, plan_.largest(), &layer.known.light());
            layer.sums->add(sums);
        }
        sums.clear();
        return true;
    }

    /// All batches so far are done: refines the layer until its errors are small enough.
    void extend_or_close(std::size_t k) {
        LayerInWork& layer = layers_[k];
        if (const std::uint64_t more = batches_to_add(layer)) {
            run_.set_total(rays_ahead_ += more * plan_.largest());
            schedule_.extend(k, more);
            return;
        }
        Layer complete;
        if (layer.write(complete)) report_.complete(k, std::move(complete));
        layer.sums.reset();
        layer.known = {};
        schedule_.close();
    }

    std::uint64_t batches_to_add(LayerInWork& layer) const {
        if (experiment_.run.until <= 0 || accurate(*layer.sums)) return 0;
        const std::uint64_t rays = layer.sums->rays();
        const std::uint64_t room = (plan_.limit - std::min(plan_.limit, rays)) / plan_.largest();
        // As many again
        const auto so_far = static_cast<std::uint64_t>(layer.sums->batches());
        if (room == 0)
            layer.notes.push_back(
                fmt::format("layer {} stopped refining at {} rays: the asked error was not reached",
                            layer.light.number, rays));
        return std::min(so_far, room);
    }

    bool accurate(const LayerSums& sums) const {
        const RunSettings& run = experiment_.run;
        const LayerSums::Errors errors = sums.relative_errors();
        const double cells = run.until_cells > 0 ? run.until_cells : run.until;
        return errors.albedo <= run.until && errors.cells <= cells;
    }

    Scene scene_of(const LayerInWork& layer) const {
        return {*tracer_,    fresnel_, detector_, experiment_.run.bounces, layer.light.isotropic,
                &layer.known};
    }
    int orders() const { return std::min(experiment_.detector.orders, experiment_.run.bounces); }

    const Heightfield& surface_;
    const Experiment& experiment_;
    Run& run_;
    const MeasureListener& listener_;
    const Fresnel fresnel_;
    std::optional<WideTracer> tracer_;
    const Detector detector_;
    const BatchPlan plan_;
    std::deque<LayerInWork> layers_;
    LayerSchedule schedule_;
    LayerReport report_;
    std::atomic<std::uint64_t> rays_ahead_ = 0;
};

}  // namespace

Measurement measure(const Heightfield& surface, const Experiment& experiment, Run& run,
                    const MeasureListener& listener) {
    validate(experiment);
    validate(surface, surface.name);
    return Gonioreflectometer(surface, experiment, run, listener).measure();
}

}  // namespace asperity
