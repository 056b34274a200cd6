// SPDX-License-Identifier: Apache-2.0
#include <asperity/formats/results/result_fields.h>
#include <asperity/surface/surface_figures.h>
#include <nlohmann/json.hpp>

#include <limits>
#include <utility>

namespace asperity::io {
namespace {

using Json = nlohmann::ordered_json;

// Doubles come out in the shortest form that reads back to the same bits; a name that is not UTF-8
// must not keep a result from being saved.
std::string text_of(const Json& json) {
    return json.dump(2, ' ', false, Json::error_handler_t::replace);
}

// JSON has no word for a number that is none; it is written as null.
double number_or_nan(const Json& json) {
    return json.is_null() ? std::numeric_limits<double>::quiet_NaN() : json.get<double>();
}

}  // namespace

std::string channel_names_json(const Measurement& m) {
    return text_of(Json(m.channel_names));
}

void read_channel_names_json(const std::string& text, Measurement& m) {
    m.channel_names = Json::parse(text).get<std::vector<std::string>>();
}

std::string surface_json(const Measurement& m) {
    Json figures = Json::object();
    for (const auto& [name, member] : surface_figures()) figures[name] = m.surface.*member;
    return text_of({{"name", m.surface_name},
                    {"nx", m.surface_nx},
                    {"ny", m.surface_ny},
                    {"dx", m.surface_dx},
                    {"dy", m.surface_dy},
                    {"isotropic", m.surface_isotropic},
                    {"statistics", figures}});
}

void read_surface_json(const std::string& text, Measurement& m) {
    const Json json = Json::parse(text);
    json.at("name").get_to(m.surface_name);
    json.at("nx").get_to(m.surface_nx);
    json.at("ny").get_to(m.surface_ny);
    m.surface_dx = number_or_nan(json.at("dx"));
    m.surface_dy = number_or_nan(json.at("dy"));
    json.at("isotropic").get_to(m.surface_isotropic);
    for (const auto& [name, member] : surface_figures())
        m.surface.*member = number_or_nan(json.at("statistics").at(name));
}

std::string provenance_json(const Measurement& m) {
    return text_of({{"version", m.version},
                    {"threads", m.threads},
                    {"trace_seconds", m.trace_seconds},
                    {"stopped", m.stopped},
                    {"part", m.part},
                    {"parts", m.parts},
                    {"surface_digest", m.surface_digest},
                    {"surface_cells", m.surface_cells},
                    {"notes", m.notes}});
}

void read_provenance_json(const std::string& text, Measurement& m) {
    const Json json = Json::parse(text);
    json.at("version").get_to(m.version);
    json.at("threads").get_to(m.threads);
    m.trace_seconds = number_or_nan(json.at("trace_seconds"));
    json.at("stopped").get_to(m.stopped);
    json.at("notes").get_to(m.notes);
    // Results of format 1 do not say these
    m.part = json.value("part", 1);
    m.parts = json.value("parts", 1);
    m.surface_digest = json.value("surface_digest", "");
    m.surface_cells = json.value("surface_cells", std::uint64_t{0});
}

}  // namespace asperity::io
