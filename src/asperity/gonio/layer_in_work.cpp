// SPDX-License-Identifier: Apache-2.0
#include <asperity/gonio/layer_in_work.h>

#include <asperity/core/error.h>
#include <asperity/gonio/layer_of_sums.h>
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

namespace asperity {

namespace {

/// A standard error from so many batches times this is above the true one in 9 of 10 cases: the
/// root of n = batches - 1 over the 10 % quantile of chi square (Wilson & Hilferty 1931).
double upper_error(std::uint64_t batches) {
    constexpr double kNormal = -1.2815515655;
    const double a = 2 / (9 * (static_cast<double>(batches) - 1));
    return std::pow(1 - a + kNormal * std::sqrt(a), -1.5);
}

}  // namespace

LayerInWork::LayerInWork(const Incidence& incidence, std::uint32_t number, const SumShape& shape,
                         const BatchPlan& plan, const RunSettings& run)
    : light(incidence), stream(number), plan_(plan), run_(run) {
    sums_.shape = shape;
    sums_.largest_batch = plan.largest();
}

void LayerInWork::take(LayerSums so_far) {
    if (so_far.done.end() > plan_.round_of(so_far.done.end()).end)
        throw Error(ErrorCode::Usage,
                    fmt::format("layer {} has {} rays already, more than this run may give it",
                                light.number, so_far.rays),
                    "max-rays");
    sums_ = std::move(so_far);
}

BatchRange LayerInWork::round() {
    const BatchSet& done = sums_.done;
    BatchRange round = plan_.round_of(done.end());
    round.begin = std::min(round.begin, done.first_missing());
    if (done.first_missing() < round.end) return round;
    return {round.end, round.end + more()};
}

BatchRange LayerInWork::whole_round() const {
    return plan_.round_of(sums_.done.end());
}

void LayerInWork::leave_out() {
    const SumShape shape = sums_.shape;
    sums_ = {};
    sums_.shape = shape;
    sums_.largest_batch = plan_.largest();
}

void LayerInWork::add(std::uint64_t batch, const BatchSums& sums) {
    // Integers, so the order does not matter
    const std::scoped_lock lock(mutex_);
    if (sums_.energy.empty()) sums_ = LayerSums(sums_.shape, sums_.largest_batch);
    sums_.add(batch, sums);
}

void LayerInWork::add_halves(std::uint64_t batch, BatchSums& first, const BatchSums& second) {
    const std::scoped_lock lock(mutex_);
    if (sums_.energy.empty()) sums_ = LayerSums(sums_.shape, sums_.largest_batch);
    sums_.add_halves(batch, first, second);
}

std::uint64_t LayerInWork::refine() {
    const std::uint64_t end = sums_.done.end(), added = more();
    for (std::uint64_t b = end; b < end + added; ++b) to_do_.push_back(b);
    return added;
}

std::uint64_t LayerInWork::more() {
    if (run_.until <= 0 || accurate()) return 0;
    const std::uint64_t more = plan_.more(sums_.batches(), sums_.rays);
    if (more == 0)
        notes.push_back(fmt::format(
            "layer {} stopped refining at {} rays: the asked error was not {}", light.number,
            sums_.rays, reached() ? "confirmed by its first batches" : "reached"));
    return more;
}

bool LayerInWork::accurate() {
    const std::scoped_lock lock(mutex_);
    return confirmed() && reached();
}

bool LayerInWork::confirmed() const {
    // Who stops where errors look small stops where they look too small. So the first quarter of
    // the batches, or a little less, decides by itself, and the others have no say in it
    const std::uint64_t batches = sums_.batches();
    if (batches < 8) return false;
    const auto k = static_cast<unsigned>(std::bit_width(batches / 4)) - 1;
    return sums_.relative_error_told_by_first(k) * upper_error(std::uint64_t{1} << k) <= run_.until;
}

bool LayerInWork::reached() {
    sums_.settle();
    const LayerSums::Errors errors = sums_.relative_errors();
    const double cells = run_.until_cells > 0 ? run_.until_cells : run_.until;
    return errors.albedo <= run_.until && errors.cells <= cells;
}

bool LayerInWork::write(Layer& layer, std::uint64_t least_batches) {
    const std::scoped_lock lock(mutex_);
    if (sums_.batches() < least_batches) return false;
    sums_.settle();
    layer = layer_of(light, sums_);
    return true;
}

void LayerInWork::close() {
    sums_ = {};
    surface.reset();
}

LayersInWork::LayersInWork(const Experiment& experiment, const SumShape& shape,
                           const BatchPlan& plan)
    : shape_(shape) {
    for (const Incidence& light : incidences(experiment.illumination))
        layers_.emplace_back(light, static_cast<std::uint32_t>(layers_.size()), shape, plan,
                             experiment.run);
}

std::vector<double> LayersInWork::theta_i() const {
    std::vector<double> angles;
    for (const LayerInWork& layer : layers_) angles.push_back(layer.light.theta);
    return angles;
}

void LayersInWork::plan(const MeasureScope& scope) {
    if (scope.so_far) take(*scope.so_far);
    share_out(scope.part, scope.parts, scope.leave_out_so_far);
    if (scope.leave_out_so_far)
        for (LayerInWork& layer : layers_) layer.leave_out();
}

void LayersInWork::add_notes(std::vector<std::string>& notes) const {
    for (const LayerInWork& layer : layers_)
        notes.insert(notes.end(), layer.notes.begin(), layer.notes.end());
}

void LayersInWork::take(const Measurement& so_far) {
    for (const Layer& layer : so_far.layers)
        for (LayerInWork& ours : layers_)
            if (ours.light.number == layer.number) ours.take(sums_of(layer, shape_));
}

void LayersInWork::share_out(int part, int parts, bool of_missing) {
    // All batches there are to share, layer after layer
    std::vector<std::pair<std::size_t, std::uint64_t>> batches;
    for (std::size_t k = 0; k < layers_.size(); ++k) {
        // A share that goes on from its own checkpoint is the share it was before anything was done
        const BatchRange round =
            parts > 1 && !of_missing ? layers_[k].whole_round() : layers_[k].round();
        for (std::uint64_t b = round.begin; b < round.end; ++b)
            if (!of_missing || !layers_[k].has(b)) batches.emplace_back(k, b);
    }
    const auto cut = [&](int k) {
        return static_cast<std::ptrdiff_t>(batches.size() * static_cast<std::uint64_t>(k) /
                                           static_cast<std::uint64_t>(parts));
    };
    for (auto at = batches.begin() + cut(part - 1); at != batches.begin() + cut(part); ++at)
        if (!layers_[at->first].has(at->second)) layers_[at->first].plan(at->second);
}

}  // namespace asperity
