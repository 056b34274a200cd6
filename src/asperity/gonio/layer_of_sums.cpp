// SPDX-License-Identifier: Apache-2.0
#include <asperity/gonio/layer_of_sums.h>

#include <asperity/core/error.h>
#include <asperity/detector/cell_estimates.h>

namespace asperity {

namespace {

/// Calls work(out, place) for every place of a list of sums and where it stands in a Layer: there
/// each value has its cells side by side, [(side * values + value) * cells + cell].
template <class Work>
void for_places(const SumShape& shape, Work work) {
    const std::size_t values = shape.values();
    for (std::size_t side = 0; side < shape.sides; ++side)
        for (std::size_t cell = 0; cell < shape.cells; ++cell)
            for (std::size_t v = 0; v < values; ++v)
                work((side * values + v) * shape.cells + cell,
                     (side * shape.cells + cell) * values + v);
}

/// The same for energies: in a Layer [((side * orders + order) * values + value) * cells + cell].
template <class Work>
void for_energies(const SumShape& shape, Work work) {
    const std::size_t values = shape.values();
    for (std::size_t order = 0; order < shape.orders; ++order)
        for (std::size_t side = 0; side < shape.sides; ++side)
            for (std::size_t cell = 0; cell < shape.cells; ++cell)
                for (std::size_t v = 0; v < values; ++v)
                    work(((side * shape.orders + order) * values + v) * shape.cells + cell,
                         ((order * shape.sides + side) * shape.cells + cell) * values + v);
}

void require_spread(const LayerSpread& spread) {
    if (!spread.squares.empty() && !spread.reached.empty()) return;
    throw Error(ErrorCode::InvalidInput,
                "it does not hold what its errors come from (results of older versions do not): "
                "measure it anew");
}

}  // namespace

std::vector<float> errors_of(const LayerSums& sums) {
    const std::vector<LayerSums::Estimate> cells = cell_estimates(sums);
    std::vector<float> errors(cells.size());
    for_places(sums.shape, [&](std::size_t out, std::size_t place) {
        errors[out] = static_cast<float>(cells[place].error);
    });
    return errors;
}

std::vector<float> errors_of(const Layer& layer, const SumShape& shape) {
    const LayerSpread& spread = layer.spread;
    if (shape.sides > 1 || shape.elements > 1) return errors_of(sums_of(layer, shape));
    require_spread(spread);
    // Each channel by itself, where its cells stand side by side already. Errors know nothing of
    // orders, groups and reflections.
    LayerSums sums;
    sums.shape = {.cells = shape.cells, .columns = shape.columns};
    sums.largest_batch = spread.largest_batch;
    sums.done = spread.done;
    std::vector<float> errors;
    errors.reserve(spread.squares.size());
    for (std::size_t channel = 0; channel < shape.channels; ++channel) {
        const auto part_of = [&](const auto& numbers, auto& part) {
            if (numbers.empty()) return;
            const auto begin = numbers.begin() + static_cast<std::ptrdiff_t>(channel * shape.cells);
            part.assign(begin, begin + static_cast<std::ptrdiff_t>(shape.cells));
        };
        part_of(layer.energy, sums.energy);
        for (std::size_t order = 1; order < shape.orders; ++order) {
            const std::uint64_t* energy =
                layer.energy.data() + (order * shape.channels + channel) * shape.cells;
            for (std::size_t cell = 0; cell < shape.cells; ++cell)
                sums.energy[cell] += energy[cell];
        }
        part_of(spread.squares, sums.squares);
        part_of(spread.reached, sums.reached);
        part_of(spread.stretched, sums.stretched);
        part_of(spread.exact, sums.exact);
        for (const LayerSums::Estimate& e : cell_estimates(sums))
            errors.push_back(static_cast<float>(e.error));
    }
    return errors;
}

Layer layer_of(const Incidence& light, const LayerSums& sums) {
    if (!sums.settled()) {
        LayerSums whole = sums;
        whole.settle();
        return layer_of(light, whole);
    }
    const SumShape& shape = sums.shape;
    Layer layer;
    layer.number = light.number;
    layer.theta_i = light.theta;
    layer.phi_i = light.phi;
    layer.rays = sums.rays;
    layer.segments = sums.segments;
    layer.reflections = sums.reflections;
    layer.stuck = sums.stuck;
    layer.batches = static_cast<int>(sums.batches());
    layer.absorbed = sums.absorbed;
    layer.truncated = sums.truncated;
    layer.edge = sums.edge;
    layer.escaped_by_bounce = sums.escaped_by_bounce;

    layer.energy.resize(sums.energy.size());
    layer.escaped.assign(sums.albedo.size(), 0);
    for_energies(
        shape, [&](std::size_t out, std::size_t place) { layer.energy[out] = sums.energy[place]; });
    for (std::size_t k = 0; k < sums.escaped_by_bounce.size(); ++k)
        layer.escaped[k / shape.bounces] += sums.escaped_by_bounce[k];

    layer.stderr_energy = errors_of(sums);
    LayerSpread& spread = layer.spread;
    spread.done = sums.done;
    spread.largest_batch = sums.largest_batch;
    spread.squares.resize(sums.squares.size());
    spread.stretched.resize(sums.stretched.size());
    spread.halves.cells.resize(sums.halves.cells.size());
    spread.halves.albedo = sums.halves.albedo;
    spread.exact.resize(sums.exact.size());
    spread.reached.resize(sums.reached.size());
    for_places(shape, [&](std::size_t out, std::size_t place) {
        if (!spread.halves.cells.empty()) spread.halves.cells[out] = sums.halves.cells[place];
        spread.squares[out] = sums.squares[place];
        spread.reached[out] = sums.reached[place];
        if (!spread.stretched.empty()) spread.stretched[out] = sums.stretched[place];
        if (!spread.exact.empty()) spread.exact[out] = sums.exact[place];
    });
    spread.bounces = sums.bounces;
    spread.albedo = sums.albedo;
    spread.albedo_by_age = sums.albedo_by_age;
    spread.groups = sums.groups;
    for (const LayerSums::Spread& s : sums.albedo)
        layer.stderr_albedo.push_back(sums.estimate(s).error);
    for (const LayerSums::Spread& s : sums.bounces)
        layer.stderr_albedo_by_bounce.push_back(sums.estimate(s).error);
    return layer;
}

LayerSums sums_of(const Layer& layer, const SumShape& shape) {
    const LayerSpread& spread = layer.spread;
    require_spread(spread);
    LayerSums sums(shape, spread.largest_batch);
    sums.done = spread.done;
    sums.rays = layer.rays;
    sums.segments = layer.segments;
    sums.reflections = layer.reflections;
    sums.stuck = layer.stuck;
    sums.absorbed = layer.absorbed;
    sums.truncated = layer.truncated;
    sums.edge = layer.edge;
    sums.escaped_by_bounce = layer.escaped_by_bounce;
    for_energies(
        shape, [&](std::size_t out, std::size_t place) { sums.energy[place] = layer.energy[out]; });
    sums.stretched.resize(spread.stretched.size());
    sums.halves.cells.resize(spread.halves.cells.size());
    sums.halves.albedo = spread.halves.albedo;
    sums.exact.resize(spread.exact.size());
    for_places(shape, [&](std::size_t out, std::size_t place) {
        sums.squares[place] = spread.squares[out];
        sums.reached[place] = spread.reached[out];
        if (!sums.halves.cells.empty()) sums.halves.cells[place] = spread.halves.cells[out];
        if (!spread.stretched.empty()) sums.stretched[place] = spread.stretched[out];
        if (!spread.exact.empty()) sums.exact[place] = spread.exact[out];
    });
    sums.bounces = spread.bounces;
    sums.albedo = spread.albedo;
    sums.albedo_by_age = spread.albedo_by_age;
    sums.groups = spread.groups;
    return sums;
}

}  // namespace asperity
