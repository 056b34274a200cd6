// SPDX-License-Identifier: Apache-2.0
#include <asperity/gonio/measurement_check.h>

#include <asperity/core/energy.h>
#include <asperity/optics/fresnel.h>
#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <span>

namespace asperity::io {
namespace {

std::size_t size(int count) {
    return static_cast<std::size_t>(count);
}

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
        if (!(std::abs(expected.theta_edge(row) - m.detector.theta_edge(row)) <= kEdgeTolerance))
            return false;
    return true;
}

bool sizes_fit(const Measurement& m, const Layer& layer) {
    const std::size_t channels = size(m.channels()), cells = size(m.detector.cells());
    const std::size_t by_bounce = channels * size(m.bounces());
    return layer.energy.size() == size(m.orders()) * channels * cells &&
           layer.escaped.size() == channels && layer.absorbed.size() == channels &&
           layer.truncated.size() == channels && layer.edge.size() == channels &&
           layer.escaped_by_bounce.size() == by_bounce &&
           layer.stderr_energy.size() == channels * cells &&
           layer.stderr_albedo.size() == channels &&
           layer.stderr_albedo_by_bounce.size() == by_bounce;
}

// Energy of a channel over all orders and cells.
std::optional<std::uint64_t> sum_of_cells(const Measurement& m, const Layer& layer, int channel) {
    const std::size_t cells = size(m.detector.cells());
    std::uint64_t total = 0;
    for (int order = 0; order < m.orders(); ++order) {
        const std::size_t slice = size(order) * size(m.channels()) + size(channel);
        const auto part = sum(std::span(layer.energy).subspan(slice * cells, cells));
        if (!part || __builtin_add_overflow(total, *part, &total)) return std::nullopt;
    }
    return total;
}

std::string imbalance(const Measurement& m, const Layer& layer, int channel) {
    const std::size_t c = size(channel);
    const std::uint64_t escaped = layer.escaped[c];
    const std::uint64_t fates[] = {escaped, layer.absorbed[c], layer.truncated[c], layer.edge[c]};
    if (layer.rays > kMaxRaysPerLayer) return fmt::format("{} rays are too many", layer.rays);
    if (sum(fates) != layer.rays * kRayEnergy)
        return "launched energy is not escaped + absorbed + truncated + edge";
    if (sum_of_cells(m, layer, channel) != escaped)
        return "escaped energy is not the sum over the cells";
    const auto bounces =
        std::span(layer.escaped_by_bounce).subspan(c * size(m.bounces()), size(m.bounces()));
    if (sum(bounces) != escaped) return "escaped energy is not the sum over the bounces";
    return {};
}

}  // namespace

std::string contradiction(const Measurement& m) {
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
        for (int channel = 0; channel < m.channels(); ++channel)
            if (const auto why = imbalance(m, layer, channel); !why.empty())
                return in_layer(fmt::format("channel {}: {}", m.channel_names[size(channel)], why));
    }
    return {};
}

}  // namespace asperity::io
