// SPDX-License-Identifier: Apache-2.0
#include <asperity/gonio/measurement_check.h>

#include <asperity/core/energy.h>
#include <asperity/core/error.h>
#include <asperity/gonio/measurement_ranges.h>
#include <asperity/optics/fresnel.h>
#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <span>

namespace asperity {
namespace {

// Nothing when the sum does not fit 64 bits. Both halves of the numbers are summed by themselves,
// so that no addition has to be looked at.
std::optional<std::uint64_t> sum(std::span<const std::uint64_t> terms) {
    std::uint64_t low = 0, high = 0;
    for (const std::uint64_t term : terms) {
        low += term & 0xffffffff;
        high += term >> 32;
    }
    high += low >> 32;
    if (high >> 32 != 0) return std::nullopt;
    return (high << 32) | (low & 0xffffffff);
}

bool detector_fits(const Measurement& m) {
    const Detector expected(m.experiment.detector);
    if (expected.kind() != m.detector.kind() || expected.rows() != m.detector.rows() ||
        expected.columns() != m.detector.columns())
        return false;
    for (int row = 0; row <= expected.rows(); ++row)
        if (!(std::abs(expected.theta_edge(row) - m.detector.theta_edge(row)) <=
              io::kEdgeTolerance))
            return false;
    return true;
}

bool sizes_fit(const Measurement& m, const Layer& layer) {
    const SumShape shape = m.shape();
    const std::size_t channels = shape.channels, values = shape.sides * shape.values();
    const std::size_t by_bounce = values * shape.bounces, places = values * shape.cells;
    const LayerSpread& spread = layer.spread;
    const bool spread_fits =
        spread.squares.empty() ||
        (spread.squares.size() == places && spread.bounces.size() == by_bounce &&
         spread.albedo.size() == values &&
         (spread.stretched.empty() || spread.stretched.size() == places) &&
         (spread.halves.cells.empty()
              ? spread.halves.albedo.empty()
              : spread.halves.cells.size() == places && spread.halves.albedo.size() == values) &&
         (spread.exact.empty() || spread.exact.size() == places));
    const GroupSums groups(shape);
    const bool groups_fit =
        spread.reached.empty() || (spread.reached.size() == places &&
                                   spread.albedo_by_age.size() == LayerSums::kAges * values &&
                                   spread.groups.rays.size() == groups.rays.size() &&
                                   spread.groups.energy.size() == groups.energy.size());
    return layer.energy.size() == shape.orders * places && layer.escaped.size() == values &&
           layer.absorbed.size() == channels && layer.truncated.size() == channels &&
           layer.edge.size() == channels && layer.escaped_by_bounce.size() == by_bounce &&
           layer.stderr_energy.size() == places && layer.stderr_albedo.size() == values &&
           layer.stderr_albedo_by_bounce.size() == by_bounce && spread_fits && groups_fit;
}

// Energy of a value on one side over all orders and cells.
std::optional<std::uint64_t> sum_of_cells(const Layer& layer, const SumShape& shape,
                                          std::size_t side, std::size_t value) {
    std::uint64_t total = 0;
    for (std::size_t order = 0; order < shape.orders; ++order) {
        const std::size_t slice = (side * shape.orders + order) * shape.values() + value;
        const auto part = sum(std::span(layer.energy).subspan(slice * shape.cells, shape.cells));
        if (!part || __builtin_add_overflow(total, *part, &total)) return std::nullopt;
    }
    return total;
}

std::string imbalance(const Layer& layer, const SumShape& shape, std::size_t channel) {
    std::vector<std::uint64_t> fates = {layer.absorbed[channel], layer.truncated[channel],
                                        layer.edge[channel]};
    for (std::size_t side = 0; side < shape.sides; ++side) {
        const std::size_t value = channel * shape.elements, k = side * shape.values() + value;
        const std::uint64_t escaped = layer.escaped[k];
        if (sum_of_cells(layer, shape, side, value) != escaped)
            return "escaped energy is not the sum over the cells";
        if (sum(std::span(layer.escaped_by_bounce).subspan(k * shape.bounces, shape.bounces)) !=
            escaped)
            return "escaped energy is not the sum over the bounces";
        fates.push_back(escaped);
    }
    if (sum(fates) != layer.rays * kRayEnergy)
        return "launched energy is not escaped + absorbed + truncated + edge";
    return {};
}

}  // namespace

std::string imbalance(const Layer& layer, const SumShape& shape,
                      std::span<const std::string> names) {
    if (layer.rays > kMaxRaysPerLayer) return fmt::format("{} rays are too many", layer.rays);
    for (std::size_t channel = 0; channel < shape.channels; ++channel)
        if (const std::string why = imbalance(layer, shape, channel); !why.empty())
            return fmt::format("channel {}: {}",
                               names.empty() ? std::to_string(channel + 1) : names[channel], why);
    return {};
}

void check_account(const Layer& layer, const SumShape& shape) {
    if (const std::string why = imbalance(layer, shape); !why.empty())
        throw Error(ErrorCode::Account, why, fmt::format("layer {}", layer.number));
}

std::string io::contradiction(const Measurement& m) {
    if (m.channels() < 1 || m.channels() > kMaxChannels)
        return fmt::format("{} channels are not in 1 .. {}", m.channels(), kMaxChannels);
    if (!detector_fits(m)) return "the detector does not fit the experiment";
    for (const Layer& layer : m.layers) {
        const auto in_layer = [&](const std::string& why) {
            return fmt::format("layer {}: {}", layer.number, why);
        };
        if (!sizes_fit(m, layer)) return in_layer("an array has the wrong size");
        if (!(layer.theta_i >= 0 && layer.theta_i < 0.5 * kPi && std::isfinite(layer.phi_i)))
            return in_layer("no incident direction");
        if (const std::string why = imbalance(layer, m.shape(), m.channel_names); !why.empty())
            return in_layer(why);
    }
    if (std::string why = out_of_range(m); !why.empty()) return why;
    for (const Layer& layer : m.layers)
        if (!layer.spread.squares.empty() &&
            layer.spread.done.count() != static_cast<std::uint64_t>(layer.batches))
            return fmt::format("layer {}: the batches done are not as many as it has",
                               layer.number);
    return {};
}

}  // namespace asperity
