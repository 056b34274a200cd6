// SPDX-License-Identifier: Apache-2.0
//
// The gonioreflectometer, from light to layers. docs/theory.md, "Measurement", has the equations.
#include <asperity/gonio/measure.h>

#include <asperity/core/error.h>
#include <asperity/core/parallel.h>
#include <asperity/core/version.h>
#include <asperity/detector/layer_sums.h>
#include <asperity/gonio/batch_plan.h>
#include <asperity/gonio/layer_of_sums.h>
#include <asperity/gonio/layer_report.h>
#include <asperity/gonio/layer_schedule.h>
#include <asperity/gonio/measurement_check.h>
#include <asperity/tracing/engine.h>
#include <asperity/tracing/scale.h>
#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

namespace asperity {

namespace {

/// A layer on its way.
struct LayerInWork {
    LayerInWork(const Incidence& incidence, std::uint32_t number)
        : light(incidence), stream(number) {}

    const Incidence light;
    const std::uint32_t stream;           ///< of random numbers
    std::unique_ptr<LitSurface> surface;  ///< in this light, once it is prepared
    std::mutex mutex;                     ///< guards the sums
    std::optional<LayerSums> sums;        ///< once a batch is done, until it is complete
    std::vector<std::string> notes;       ///< for the reader of the result

    /// What the sums hold; false if that is too little to tell errors.
    bool write(Layer& layer) {
        if (!sums || sums->batches < 2) return false;
        sums->settle();
        layer = layer_of(light, *sums);
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
          setup_{surface, fresnel_, detector_, experiment.run.bounces},
          shape_(shape()),
          plan_(surface.cell_count(), experiment.run),
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

    /// Looks at the surface and builds the engine; false when it was stopped.
    bool prepare(Measurement& m) {
        try {
            m.surface = statistics(surface_, run_);
            std::vector<double> angles;
            for (const LayerInWork& layer : layers_) angles.push_back(layer.light.theta);
            check_scale(surface_, m.surface.min_height, m.surface.max_height, angles);
            if (listener_.begun) listener_.begun(m);
            engine_ = find_engine(experiment_.run.engine).make(setup_, run_);
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
            if (Layer layer; layers_[k].write(layer)) {
                check_account(layer, shape_);
                report_.complete(k, std::move(layer));
            }
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
        const auto worker = engine_->worker();
        BatchSums sums(shape_);
        while (run_.keep_going()) {
            const auto piece = schedule_.next();
            if (!piece) return;
            LayerInWork& layer = layers_[piece->layer];
            if (piece->kind == LayerSchedule::Piece::Kind::Prepare) {
                prepare_layer(piece->layer, 1);
            } else if (trace(layer, piece->batch, *worker, sums)) {
                report_.grown(piece->layer, [&](Layer& grown) {
                    const std::scoped_lock lock(layer.mutex);
                    return layer.write(grown);
                });
                if (schedule_.traced(piece->layer)) extend_or_close(piece->layer);
            }
        }
    }

    /// Works out what all batches of a layer have in common.
    void prepare_layer(std::size_t k, int threads) {
        layers_[k].surface =
            engine_->light(layers_[k].light, experiment_.run.launch, plan_.rays, run_, threads);
        schedule_.prepared(k);
    }

    /// Traces a batch and adds it to its layer; false if the run was stopped before the end.
    bool trace(LayerInWork& layer, std::uint64_t b, Worker& worker, BatchSums& sums) {
        const BatchRequest batch{experiment_.run.launch, plan_.rays_of(b), experiment_.run.seed,
                                 layer.stream, static_cast<std::uint32_t>(b)};
        if (!layer.surface->trace(batch, worker, sums, run_)) return false;
        // Integers, so the order does not matter
        {
            const std::scoped_lock lock(layer.mutex);
            if (!layer.sums) layer.sums.emplace(shape_, plan_.largest());
            *layer.sums += sums;
        }
        sums.clear();
        return true;
    }

    /// All batches so far are done: refines the layer until its errors are small enough.
    void extend_or_close(std::size_t k) {
        LayerInWork& layer = layers_[k];
        layer.sums->settle();
        if (const std::uint64_t more = batches_to_add(layer)) {
            run_.set_total(rays_ahead_ += more * plan_.largest());
            schedule_.extend(k, more);
            return;
        }
        Layer complete;
        if (layer.write(complete)) {
            check_account(complete, shape_);
            report_.complete(k, std::move(complete));
        }
        layer.sums.reset();
        layer.surface.reset();
        schedule_.close();
    }

    std::uint64_t batches_to_add(LayerInWork& layer) const {
        if (experiment_.run.until <= 0 || accurate(*layer.sums)) return 0;
        const std::uint64_t more = plan_.more(layer.sums->batches, layer.sums->rays);
        if (more == 0)
            layer.notes.push_back(
                fmt::format("layer {} stopped refining at {} rays: the asked error was not reached",
                            layer.light.number, layer.sums->rays));
        return more;
    }

    bool accurate(const LayerSums& sums) const {
        const RunSettings& run = experiment_.run;
        const LayerSums::Errors errors = sums.relative_errors();
        const double cells = run.until_cells > 0 ? run.until_cells : run.until;
        return errors.albedo <= run.until && errors.cells <= cells;
    }

    SumShape shape() const {
        Measurement m;
        m.experiment = experiment_;
        m.detector = detector_;
        m.channel_names = fresnel_.channel_names();
        return m.shape();
    }

    const Heightfield& surface_;
    const Experiment& experiment_;
    Run& run_;
    const MeasureListener& listener_;
    const Fresnel fresnel_;
    const Detector detector_;
    const EngineSetup setup_;
    const SumShape shape_;
    std::unique_ptr<Engine> engine_;
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
