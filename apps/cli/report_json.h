// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/core/directions.h>
#include <asperity/gonio/measurement.h>
#include <asperity/measured/compare.h>

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace asperity::cli {

/// Members stand in the order they are added.
using Json = nlohmann::ordered_json;

/// The object `info --json` prints. Energies are fractions of the launched energy; `exact` holds
/// the integers they come from, in units of 2^-32 of a ray, as texts of digits.
/// `checksum` is io::checksum(measurement).
Json to_json(const Measurement& measurement, const std::string& checksum);
Json to_json(const SurfaceStatistics& statistics);
Json to_json(const Comparison& comparison);
/// {"rays": 10000, ...}: numbers as numbers, lists as arrays, what is left open as null.
Json to_json(const Experiment& experiment);

/// null where it is not known, infinite or NaN.
Json number_or_null(double value);

/// How far the lobes of layers lie apart, of a fit or of a file written: one object each.
template <typename Layer>
Json distances_json(const std::vector<Layer>& layers) {
    Json list = Json::array();
    for (const Layer& layer : layers)
        list.push_back({{"theta_i_deg", degrees(layer.theta_i)},
                        {"phi_i_deg", degrees(layer.phi_i)},
                        {"l1", layer.l1},
                        {"noise", layer.noise},
                        {"albedo_difference", layer.albedo_difference}});
    return list;
}

/// Prints one object on standard output, indented.
void write_json(const Json& object);

}  // namespace asperity::cli
