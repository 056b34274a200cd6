// SPDX-License-Identifier: Apache-2.0
#include "report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace asperity::bench {

const Measured& Row::best() const {
    return *std::min_element(
        std::next(measured.begin()), measured.end(),
        [](const Measured& a, const Measured& b) { return a.seconds < b.seconds; });
}

double Row::disagreement() const {
    double largest = 0;
    for (const Measured& other : measured) {
        largest = std::max(largest, distance(own().tally, other.tally));
    }
    return largest / distance_of_independent_runs(own().tally);
}

std::string table(const std::vector<Row>& rows) {
    fmt::memory_buffer out;
    const auto end = std::back_inserter(out);
    fmt::format_to(end, "Millions of paths per CPU second, one thread\n{:<16}{:>6}{:>6}{:>9}",
                   "surface", "N", "theta", "seg/path");
    for (const Measured& m : rows.front().measured) fmt::format_to(end, "{:>14}", m.rival);
    fmt::format_to(end, "{:>8}{:>10}{:>10}{:>10}\n", "ratio", "Mseg/s", "best E.", "disagree");

    double product = 1;
    for (const Row& row : rows) {
        fmt::format_to(end, "{:<16}{:>6}{:>6.0f}{:>9.3f}", row.surface, row.size, row.theta_deg,
                       static_cast<double>(row.own().tally.segments()) /
                           static_cast<double>(row.own().tally.paths()));
        for (const Measured& m : row.measured) {
            fmt::format_to(end, "{:>14.3f}", m.paths_per_second() / 1e6);
        }
        fmt::format_to(end, "{:>8.2f}{:>10.2f}{:>10.2f}{:>10.3f}\n", row.ratio(),
                       row.own().segments_per_second() / 1e6,
                       row.best().segments_per_second() / 1e6, row.disagreement());
        product *= row.ratio();
    }
    fmt::format_to(
        end,
        "Geometric mean of the ratios: {:.2f}\n\n"
        "ratio: ours over the fastest of Embree's. Mseg/s: millions of segments per second, ours\n"
        "and the fastest Embree's. disagree: distance of the histograms of escape directions, in\n"
        "units of that of independent runs; far below 1, as the rivals follow the same paths.\n\n",
        std::pow(product, 1.0 / static_cast<double>(rows.size())));

    fmt::format_to(end, "{:<16}{:>6}  {:<14}{:>10}{:>10}\n", "surface", "N", "made ready",
                   "build s", "MiB");
    for (std::size_t r = 0; r < rows.size(); ++r) {
        const bool seen =
            r > 0 && rows[r - 1].surface == rows[r].surface && rows[r - 1].size == rows[r].size;
        if (seen) continue;
        for (const Measured& m : rows[r].measured) {
            fmt::format_to(end, "{:<16}{:>6}  {:<14}{:>10.3f}{:>10.1f}\n", rows[r].surface,
                           rows[r].size, m.rival, m.build_seconds,
                           static_cast<double>(m.memory_bytes) / 0x1p20);
        }
    }
    return fmt::to_string(out);
}

nlohmann::ordered_json json(const std::vector<Row>& rows) {
    auto list = nlohmann::ordered_json::array();
    for (const Row& row : rows) {
        nlohmann::ordered_json entry = {{"surface", row.surface},
                                        {"size", row.size},
                                        {"theta_deg", row.theta_deg},
                                        {"ratio", row.ratio()},
                                        {"disagreement", row.disagreement()}};
        for (const Measured& m : row.measured) {
            entry["rivals"].push_back({{"name", m.rival},
                                       {"paths", m.tally.paths()},
                                       {"segments", m.tally.segments()},
                                       {"cpu_seconds", m.seconds},
                                       {"paths_per_second", m.paths_per_second()},
                                       {"segments_per_second", m.segments_per_second()},
                                       {"mean_reflections", m.tally.mean_reflections()},
                                       {"truncated", m.tally.truncated()},
                                       {"lost", m.tally.lost()},
                                       {"build_seconds", m.build_seconds},
                                       {"memory_bytes", m.memory_bytes}});
        }
        list.push_back(std::move(entry));
    }
    return list;
}

}  // namespace asperity::bench
