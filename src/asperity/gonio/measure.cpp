// SPDX-License-Identifier: Apache-2.0
//
// The gonioreflectometer, from light to layers. docs/theory.md, "Measurement", has the equations.
#include <asperity/gonio/measure.h>

#include <asperity/core/error.h>
#include <asperity/core/parallel.h>
#include <asperity/gonio/angles_of_lobe.h>
#include <asperity/gonio/batch_plan.h>
#include <asperity/gonio/checkpoint.h>
#include <asperity/gonio/layer_in_work.h>
#include <asperity/gonio/layer_report.h>
#include <asperity/gonio/layer_schedule.h>
#include <asperity/gonio/measurement_check.h>
#include <asperity/gonio/measurement_head.h>
#include <asperity/gonio/memory_need.h>
#include <asperity/gonio/surface_class.h>
#include <asperity/tracing/engine.h>
#include <asperity/tracing/scale.h>

#include <atomic>
#include <memory>
#include <optional>
#include <utility>

namespace asperity {

namespace {

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
          head_(head_of(surface, experiment, run)),
          shape_(head_.shape()),
          plan_(surface.cell_count(), experiment.run),
          layers_(experiment, shape_, plan_),
          report_(listener, layers_.size()),
          checkpoint_clock_(listener.checkpoint_period) {}

    Measurement measure(MeasureScope scope) {
        run_.begin("preparing", surface_.cell_count());
        plan(std::move(scope));
        const bool prepared = prepare();
        run_.end();
        if (prepared) fill_layers();
        return finish();
    }

  private:
    /// Decides which batches are to do.
    void plan(MeasureScope scope) {
        note_scope(head_, scope);
        all_of_it_ = scope.parts == 1 && !(scope.so_far && scope.leave_out_so_far);
        layers_.plan(scope);
        for (std::size_t k = 0; k < layers_.size(); ++k)
            if (layers_[k].to_do().empty())
                complete(k);
            else
                open_.push_back(k);
    }

    /// Looks at the surface and builds the engine; false when it was stopped.
    bool prepare() {
        try {
            head_.surface = statistics(surface_, run_);
            if (std::string narrow = narrow_lobes(head_, layers_.theta_i()); !narrow.empty())
                head_.notes.push_back(std::move(narrow));
            check_scale(surface_, head_.surface.min_height, head_.surface.max_height,
                        layers_.theta_i());
            if (listener_.begun) listener_.begun(head_);
            EngineKind engine = find_engine(experiment_.run.engine);
            if (plan_.of_class)
                class_.emplace(setup_,
                               SurfaceClass::Settings{
                                   experiment_.surface, std::move(engine), layers_.theta_i(),
                                   open_.size() > 1 ? SurfaceClass::bytes_to_keep() : 0},
                               run_);
            else
                engine_ = engine.make(setup_, run_);
            return true;
        } catch (const Error& error) {
            if (error.code() != ErrorCode::Stopped) throw;
            return false;
        }
    }

    void fill_layers() {
        std::vector<std::uint64_t> batches;
        for (const std::size_t k : open_) {
            batches.push_back(layers_[k].to_do().size());
            for (const std::uint64_t b : layers_[k].to_do()) rays_ahead_ += plan_.rays_of(b);
        }
        LayerSchedule schedule(batches);
        run_.begin("tracing", rays_ahead_);
        // All threads prepare the first layer; each of the others is prepared by one of them while
        // the one before is traced
        if (const auto first = schedule.next())
            prepare_layer(schedule, first->layer, run_.threads());
        const auto workers = static_cast<std::size_t>(run_.threads());
        parallel_for(workers, run_.threads(), [&](std::size_t) { work(schedule); });
        run_.end();
        head_.trace_seconds += run_.progress().seconds;
    }

    /// What each thread does until all layers are complete, or the run is stopped.
    void work(LayerSchedule& schedule) {
        const LayerSchedule::Leave leave{schedule};
        const auto worker = class_ ? class_->worker() : engine_->worker();
        BatchSums sums(shape_), second(shape_);
        while (run_.keep_going()) {
            const auto piece = schedule.next();
            if (!piece) return;
            const std::size_t k = open_[piece->layer];
            if (piece->kind == LayerSchedule::Piece::Kind::Prepare) {
                prepare_layer(schedule, piece->layer, 1);
            } else if (trace(layers_[k], layers_[k].to_do()[piece->batch], *worker, sums, second)) {
                report_.grown(k, [&](Layer& grown) { return layers_[k].write(grown, 2); });
                if (schedule.traced(piece->layer)) extend_or_close(schedule, piece->layer);
                if (listener_.checkpoint) checkpoint_clock_.when_due([&] { checkpoint(); });
            }
        }
    }

    /// Works out what all batches of a layer have in common.
    void prepare_layer(LayerSchedule& schedule, std::size_t number, int threads) {
        LayerInWork& layer = layers_[open_[number]];
        // Each surface of a class is lit when its turn comes
        if (!class_)
            layer.surface =
                engine_->light(layer.light, experiment_.run.launch, plan_.rays, run_, threads);
        schedule.prepared(number);
    }

    /// Traces a batch and adds it to its layer; false if the run was stopped before the end.
    bool trace(LayerInWork& layer, std::uint64_t b, Worker& worker, BatchSums& sums,
               BatchSums& second) {
        const BatchRequest batch{experiment_.run.launch, plan_.rays_of(b), experiment_.run.seed,
                                 layer.stream, static_cast<std::uint32_t>(b)};
        if (class_) {
            if (!class_->trace(layer.light, batch, worker, sums, second, run_)) return false;
            layer.add_halves(b, sums, second);
            second.clear();
        } else {
            if (!layer.surface->trace(batch, worker, sums, run_)) return false;
            layer.add(b, sums);
        }
        sums.clear();
        return true;
    }

    /// All batches so far are done: refines the layer until its errors are small enough.
    void extend_or_close(LayerSchedule& schedule, std::size_t number) {
        const std::size_t k = open_[number];
        if (const std::uint64_t more = all_of_it_ ? layers_[k].refine() : 0) {
            run_.set_total(rays_ahead_ += more * plan_.largest());
            schedule.extend(number, more);
            return;
        }
        complete(k);
        schedule.close();
    }

    /// Hands the layer over, if it holds enough to tell errors: what is a part whatever it holds.
    void complete(std::size_t k) {
        Layer layer;
        if (layers_[k].write(layer, all_of_it_ ? 2 : 1)) {
            check_account(layer, shape_);
            report_.complete(k, std::move(layer));
        }
        layers_[k].close();
    }

    /// The result; of a stopped run also what is there of the layers under way.
    Measurement finish() {
        for (std::size_t k = 0; k < layers_.size(); ++k) complete(k);
        layers_.add_notes(head_.notes);
        head_.layers = report_.finish();
        head_.stopped = run_.stop_requested();
        if (head_.stopped) head_.notes.emplace_back("stopped before it was complete");
        return std::move(head_);
    }

    /// Shows all that is done so far, while other threads go on.
    void checkpoint() {
        Measurement so_far = checkpoint_of(head_, layers_, report_);
        so_far.trace_seconds += run_.progress().seconds;
        listener_.checkpoint(so_far);
    }

    const Heightfield& surface_;
    const Experiment& experiment_;
    Run& run_;
    const MeasureListener& listener_;
    const Fresnel fresnel_;
    const Detector detector_;
    const EngineSetup setup_;
    Measurement head_;
    const SumShape shape_;
    std::unique_ptr<Engine> engine_;
    std::optional<SurfaceClass> class_;  ///< in place of the engine: more surfaces than one
    const BatchPlan plan_;
    LayersInWork layers_;
    std::vector<std::size_t> open_;  ///< layers in which something is to do
    bool all_of_it_ = true;          ///< what comes out is not to be added to anything
    LayerReport report_;
    CheckpointClock checkpoint_clock_;
    std::atomic<std::uint64_t> rays_ahead_ = 0;
};

/// The experiment with the angles of its light; nothing when the run was stopped before they were
/// known.
std::optional<Experiment> decide(const Heightfield& surface, const Experiment& experiment,
                                 const Run& run) {
    try {
        return with_angles(surface, experiment, run);
    } catch (const Error& error) {
        if (error.code() != ErrorCode::Stopped) throw;
        return std::nullopt;
    }
}

Measurement stopped_before(const Heightfield& surface, const Experiment& experiment,
                           const Run& run) {
    Measurement nothing = head_of(surface, experiment, run);
    nothing.stopped = true;
    nothing.notes.emplace_back("stopped before it was complete");
    return nothing;
}

}  // namespace

Measurement measure(const Heightfield& surface, const Experiment& experiment, Run& run,
                    const MeasureListener& listener, MeasureScope scope) {
    validate(experiment);
    validate(surface, surface.name);
    check(scope);
    const std::optional<Experiment> decided = decide(surface, experiment, run);
    if (!decided) return stopped_before(surface, experiment, run);
    require_memory_for(surface, *decided);
    return Gonioreflectometer(surface, *decided, run, listener).measure(std::move(scope));
}

}  // namespace asperity
