// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/detector/illumination.h>
#include <asperity/detector/layer_sums.h>
#include <asperity/gonio/batch_plan.h>
#include <asperity/gonio/measure.h>
#include <asperity/gonio/measurement.h>
#include <asperity/tracing/engine.h>

#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace asperity {

/// A layer on its way: which of its batches are done, and which are to be done next.
///
/// Its batches come in rounds (BatchPlan); after each the layer is looked at, and goes on with
/// another if it is not accurate enough. What is done may have come from elsewhere, in any order.
class LayerInWork {
  public:
    LayerInWork(const Incidence& incidence, std::uint32_t number, const SumShape& shape,
                const BatchPlan& plan, const RunSettings& run);

    const Incidence light;
    const std::uint32_t stream;           ///< of random numbers
    std::unique_ptr<LitSurface> surface;  ///< in this light, once it is prepared
    std::vector<std::string> notes;       ///< for the reader of the result

    /// Goes on from what was done before. Throws Error(Usage, "max-rays") if that is more than the
    /// plan allows.
    void take(LayerSums so_far);
    /// The round under way, or nothing if all is done: the batches of it that were not looked at
    /// before, with those that are missing among earlier ones.
    BatchRange round();
    /// All batches of the round that was looked at last, done or not.
    BatchRange whole_round() const;
    bool has(std::uint64_t batch) const { return sums_.done.contains(batch); }
    /// Adds one to those to do.
    void plan(std::uint64_t batch) { to_do_.push_back(batch); }
    /// Leaves what was taken out of the sums; it stays known as done.
    void leave_out();
    const std::vector<std::uint64_t>& to_do() const { return to_do_; }

    /// Adds a batch that was traced. From any thread.
    void add(std::uint64_t batch, const BatchSums& sums);
    /// The same for the halves of one with a surface of its own; `first` holds both afterwards.
    void add_halves(std::uint64_t batch, BatchSums& first, const BatchSums& second);
    /// All to do is done: lists the next round, if the layer needs one, and says how many batches
    /// that adds.
    std::uint64_t refine();
    /// The layer as it stands; false if fewer batches are in it. From any thread.
    bool write(Layer& layer, std::uint64_t least_batches);
    /// Gives its memory back.
    void close();

  private:
    /// Whether errors are small enough, and whether it is not for luck that they seem to be.
    bool accurate();
    bool confirmed() const;
    bool reached();
    std::uint64_t more();

    const BatchPlan& plan_;
    const RunSettings& run_;
    std::mutex mutex_;  ///< guards the sums
    LayerSums sums_;
    std::vector<std::uint64_t> to_do_;
};

/// All layers of a measurement, in the order in which they are filled.
class LayersInWork {
  public:
    LayersInWork(const Experiment& experiment, const SumShape& shape, const BatchPlan& plan);

    std::size_t size() const { return layers_.size(); }
    LayerInWork& operator[](std::size_t k) { return layers_[k]; }
    std::vector<double> theta_i() const;

    /// Goes on from the layers of an earlier result, if the scope has one, and lists in each layer
    /// the batches of its round that are to be done.
    void plan(const MeasureScope& scope);
    /// What layers have to say to the reader of the result.
    void add_notes(std::vector<std::string>& notes) const;

  private:
    void take(const Measurement& so_far);
    /// Share number `part` of `parts`, counted over all layers one after the other, over those that
    /// are missing alone if so asked: then a share depends on what is done.
    void share_out(int part, int parts, bool of_missing);

    const SumShape shape_;
    std::deque<LayerInWork> layers_;
};

}  // namespace asperity
