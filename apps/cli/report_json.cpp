// SPDX-License-Identifier: Apache-2.0
#include "report_json.h"

#include "console.h"
#include "report.h"

#include <asperity/core/directions.h>
#include <asperity/core/energy.h>
#include <asperity/formats/results/result_file.h>
#include <asperity/gonio/experiment_params.h>
#include <asperity/gonio/noise_shares.h>
#include <asperity/surface/surface_figures.h>

#include <cmath>
#include <span>

namespace asperity::cli {

namespace {

Json fractions(const std::vector<std::uint64_t>& energy, std::uint64_t rays) {
    Json list = Json::array();
    for (std::uint64_t e : energy) list.push_back(energy_fraction(e, rays));
    return list;
}

Json digits(const std::vector<std::uint64_t>& energy) {
    Json list = Json::array();
    for (std::uint64_t e : energy) list.push_back(std::to_string(e));
    return list;
}

/// [channel][order] from figures in the order channel * orders + order.
template <typename Figure>
Json by_channel(int channels, int orders, Figure figure) {
    Json list = Json::array();
    for (int c = 0; c < channels; ++c) {
        Json row = Json::array();
        for (int k = 0; k < orders; ++k) row.push_back(figure(c, k));
        list.push_back(row);
    }
    return list;
}

Json layer_json(const Measurement& m, const Layer& layer) {
    const int channels = m.channels();
    Json albedo = Json::array();
    for (int c = 0; c < channels; ++c) albedo.push_back(m.albedo(layer, c));

    Json json;
    json["number"] = layer.number;
    json["theta_deg"] = degrees(layer.theta_i);
    json["phi_deg"] = nullptr;
    if (!m.experiment.illumination.isotropic) json["phi_deg"] = degrees(layer.phi_i);
    json["launched"] = layer.rays;
    json["albedo"] = albedo;
    json["albedo_stderr"] = layer.stderr_albedo;
    json["albedo_by_bounce"] =
        by_channel(channels, m.bounces(), [&](int c, int k) { return m.albedo(layer, k, c); });
    json["albedo_by_bounce_stderr"] = by_channel(channels, m.bounces(), [&](int c, int k) {
        return layer.stderr_albedo_by_bounce[static_cast<std::size_t>(c * m.bounces() + k)];
    });
    json["absorbed"] = fractions(layer.absorbed, layer.rays);
    json["truncated"] = fractions(layer.truncated, layer.rays);
    json["edge"] = fractions(layer.edge, layer.rays);
    json["mean_bounces"] = mean_bounces(layer);
    json["segments"] = layer.segments;
    json["reflections"] = layer.reflections;
    json["stuck"] = layer.stuck;
    json["batches"] = layer.batches;
    if (const auto shares = shares_of_rays(std::span(&layer, 1))) {
        Json of_rays = Json::array();
        for (int c = 0; c < channels; ++c) of_rays.push_back(albedo_error_of_rays(layer, c));
        json["surfaces"] = layer.batches;
        json["albedo_stderr_rays"] = of_rays;
        json["share_of_rays"] = {{"albedo", shares->albedo}, {"cells", shares->cells}};
    }
    json["exact"] = {{"launched", std::to_string(layer.rays * kRayEnergy)},
                     {"escaped", digits(layer.escaped)},
                     {"absorbed", digits(layer.absorbed)},
                     {"truncated", digits(layer.truncated)},
                     {"edge", digits(layer.edge)}};
    return json;
}

// A setting that is left open is null.
Json json_of(std::monostate) {
    return nullptr;
}

template <typename Value>
Json json_of(const Value& value) {
    return value;
}

}  // namespace

Json to_json(const SurfaceStatistics& s) {
    Json json = Json::object();
    for (const auto& [name, value] : surface_figures()) json[name] = s.*value;
    return json;
}

Json to_json(const Experiment& experiment) {
    Json json = Json::object();
    for (const Param<Experiment>& param : experiment_params()) {
        if (param.info.written_where_used && !param.used(experiment)) continue;
        Json& member = json[param.info.name];
        std::visit([&](const auto& value) { member = json_of(value); }, param.get(experiment));
    }
    return json;
}

Json to_json(const Measurement& m, const std::string& checksum) {
    Json surface = to_json(m.surface);
    surface["name"] = m.surface_name;
    surface["nx"] = m.surface_nx;
    surface["ny"] = m.surface_ny;
    surface["dx"] = m.surface_dx;
    surface["dy"] = m.surface_dy;
    surface["isotropic"] = m.surface_isotropic;

    Json json;
    json["version"] = m.version;
    json["checksum"] = checksum;
    json["stopped"] = m.stopped;
    json["launched_total"] = launched_total(m);
    json["rays_per_second"] = rays_per_second(m);
    json["trace_seconds"] = m.trace_seconds;
    json["threads"] = m.threads;
    json["seed"] = m.experiment.run.seed;
    json["channels"] = m.channel_names;
    json["detector"] = {
        {"kind", m.detector.kind() == DetectorKind::LatLong ? "latlong" : "equal-area"},
        {"rows", m.detector.rows()},
        {"columns", m.detector.columns()},
        {"orders", m.orders()}};
    json["surface"] = surface;
    json["experiment"] = to_json(m.experiment);
    json["notes"] = m.notes;
    json["layers"] = Json::array();
    for (const Layer& layer : m.layers) json["layers"].push_back(layer_json(m, layer));
    return json;
}

Json number_or_null(double value) {
    return std::isfinite(value) ? Json(value) : Json();
}

Json to_json(const Comparison& comparison) {
    Json json;
    json["a"] = comparison.name_a;
    json["b"] = comparison.name_b;
    json["mean_l1"] = comparison.mean_l1;
    json["mean_l1_stderr"] = number_or_null(comparison.mean_l1_error);
    json["mean_rms"] = comparison.mean_rms;
    json["mean_rms_stderr"] = number_or_null(comparison.mean_rms_error);
    json["max_albedo_difference"] = comparison.max_albedo_difference;
    json["layers"] = Json::array();
    for (const LayerComparison& layer : comparison.layers) {
        json["layers"].push_back(
            {{"number", layer.number},
             {"theta_deg", degrees(layer.theta_i)},
             {"phi_deg", degrees(layer.phi_i)},
             {"albedo_a", layer.albedo_a},
             {"albedo_b", layer.albedo_b},
             {"albedo_difference", layer.albedo_difference},
             {"albedo_difference_stderr", number_or_null(layer.albedo_difference_error)},
             {"l1", layer.l1},
             {"l1_stderr", number_or_null(layer.l1_error)},
             {"l1_noise", layer.l1_noise},
             {"rms", layer.rms},
             {"rms_stderr", number_or_null(layer.rms_error)}});
    }
    return json;
}

void write_json(const Json& object) {
    // Names of files need not be UTF-8: what is not becomes a replacement character.
    write_out(object.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
}

}  // namespace asperity::cli
