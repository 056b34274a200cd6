// SPDX-License-Identifier: Apache-2.0
#include <asperity/measured/albedo_by_angle.h>

#include <asperity/bsdf/channel_range.h>
#include <asperity/core/directions.h>

#include <algorithm>
#include <array>

namespace asperity {

AlbedoByBounce albedo_by_bounce(const Measurement& measurement, const Layer& layer, int orders,
                                int channel) {
    const auto [first, last] = detail::channel_range(channel, measurement.channels());
    const double count = last - first;
    const auto error_of = [](const std::vector<double>& errors, int k) {
        return errors.empty() ? 0.0 : errors[static_cast<std::size_t>(k)];
    };
    AlbedoByBounce result{layer.theta_i, layer.phi_i, {}, {}};
    result.order.resize(static_cast<std::size_t>(std::min(orders, measurement.bounces())));
    for (int c = first; c < last; ++c) {
        result.total.value += measurement.albedo(layer, c) / count;
        result.total.error += error_of(layer.stderr_albedo, c) / count;
        for (int order = 0; order < measurement.bounces(); ++order) {
            const std::size_t group =
                std::min(static_cast<std::size_t>(order), result.order.size() - 1);
            result.order[group].value += measurement.albedo(layer, order, c) / count;
            result.order[group].error +=
                error_of(layer.stderr_albedo_by_bounce, c * measurement.bounces() + order) / count;
        }
    }
    return result;
}

double albedo_at(const Bsdf& brdf, double theta_i, int channel) {
    const auto [first, last] = detail::channel_range(channel, brdf.channels());
    std::array<double, kMaxBsdfChannels> albedo{};
    brdf.albedo(from_spherical(theta_i, 0),
                std::span(albedo).first(static_cast<std::size_t>(brdf.channels())));
    double sum = 0;
    for (int c = first; c < last; ++c) sum += albedo[static_cast<std::size_t>(c)];
    return sum / (last - first);
}

}  // namespace asperity
