// SPDX-License-Identifier: Apache-2.0
#include <asperity/gonio/merge.h>

#include <asperity/core/error.h>
#include <asperity/gonio/batch_plan.h>
#include <asperity/gonio/layer_in_work.h>
#include <asperity/gonio/layer_of_sums.h>
#include <asperity/gonio/measurement_check.h>
#include <asperity/gonio/measurement_head.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <utility>

namespace asperity {

namespace {

std::string text_of(BatchRange r) {
    return r.size() == 1 ? fmt::format("batch {}", r.begin)
                         : fmt::format("batches {} to {}", r.begin, r.end - 1);
}

}  // namespace

void Merge::add(Measurement part, const std::string& name) {
    Source source{name, part.part, part.parts, {}};
    for (const Layer& layer : part.layers) source.done[layer.number] = layer.spread.done;
    if (sources_.empty()) {
        whole_ = part;
        whole_.layers.clear();
        // What is said of the surface holds for the whole
        std::erase_if(whole_.notes,
                      [](const std::string& note) { return !note.starts_with("the surface"); });
        whole_.trace_seconds = 0;
    }
    require_same_experiment(part, whole_, name);
    if (part.experiment.run.until != whole_.experiment.run.until ||
        part.experiment.run.max_rays != whole_.experiment.run.max_rays)
        throw Error(ErrorCode::InvalidInput, "it was asked for another accuracy", name);
    refuse_overlap(source);
    for (Layer& layer : part.layers) {
        LayerSums sums;
        try {
            sums = sums_of(layer, part.shape());
        } catch (const Error& error) {
            throw Error(error.code(), error.what(), name);
        }
        const auto [place, fresh] = sums_.try_emplace(layer.number, std::move(sums));
        if (!fresh) place->second += sums;
        layer = {};
    }
    whole_.trace_seconds += part.trace_seconds;
    sources_.push_back(std::move(source));
}

void Merge::refuse_overlap(const Source& source) const {
    for (const Source& other : sources_)
        for (const auto& [number, done] : source.done) {
            const auto theirs = other.done.find(number);
            if (theirs == other.done.end()) continue;
            for (const BatchRange& a : done.ranges())
                for (const BatchRange& b : theirs->second.ranges())
                    if (const BatchRange both = common(a, b); both.size() > 0)
                        throw Error(
                            ErrorCode::InvalidInput,
                            fmt::format("{} of layer {} {} in {}, too", text_of(both), number,
                                        both.size() == 1 ? "is" : "are", other.name),
                            source.name);
        }
}

std::string Merge::missing_parts() const {
    const int parts = sources_.front().parts;
    std::vector<std::string> names;
    for (int k = 1; k <= parts; ++k)
        if (std::none_of(sources_.begin(), sources_.end(),
                         [&](const Source& s) { return s.part == k && s.parts == parts; }))
            names.push_back(fmt::format("{}/{}", k, parts));
    if (names.empty()) return "a part was stopped before it was complete: go on with --resume";
    return fmt::format("{} {} {} missing", names.size() == 1 ? "part" : "parts",
                       fmt::join(names, ", "), names.size() == 1 ? "is" : "are");
}

Measurement Merge::finish() {
    if (sources_.empty()) throw Error(ErrorCode::Usage, "there is nothing to merge");
    const BatchPlan plan(whole_.surface_cells, whole_.experiment.run);
    for (const Incidence& light : incidences(whole_.experiment.illumination)) {
        const auto found = sums_.find(light.number);
        const BatchSet done = found == sums_.end() ? BatchSet() : found->second.done;
        const auto missing = done.missing(plan.round_of(done.end()).end);
        if (!missing.empty())
            throw Error(
                ErrorCode::InvalidInput,
                fmt::format("{} of layer {} {} missing: {}", text_of(missing.front()), light.number,
                            missing.front().size() == 1 ? "is" : "are", missing_parts()));
        whole_.layers.push_back(layer_of(light, found->second));
        check_account(whole_.layers.back(), whole_.shape());
        sums_.erase(found);
    }
    whole_.part = whole_.parts = 1;
    whole_.stopped = false;
    return std::move(whole_);
}

Measurement Merge::unfinished() && {
    for (const Incidence& light : incidences(whole_.experiment.illumination))
        if (const auto found = sums_.find(light.number); found != sums_.end()) {
            whole_.layers.push_back(layer_of(light, found->second));
            check_account(whole_.layers.back(), whole_.shape());
        }
    whole_.part = whole_.parts = 1;
    whole_.stopped = true;
    whole_.notes.emplace_back("stopped before it was complete");
    return std::move(whole_);
}

bool complete(Measurement& so_far) {
    const BatchPlan plan(so_far.surface_cells, so_far.experiment.run);
    LayersInWork layers(so_far.experiment, so_far.shape(), plan);
    layers.plan({.so_far = so_far});
    for (std::size_t k = 0; k < layers.size(); ++k)
        if (!layers[k].to_do().empty()) return false;
    layers.add_notes(so_far.notes);
    return true;
}

}  // namespace asperity
