// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "race.h"

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace asperity::bench {

/// A table for the eye, with a legend.
std::string table(const std::vector<Row>& rows);

/// All figures: the rows, and the means of their ratios for each size.
nlohmann::ordered_json json(const std::vector<Row>& rows);

}  // namespace asperity::bench
