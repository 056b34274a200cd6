// SPDX-License-Identifier: Apache-2.0
#include "report.h"

#include "averages.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace asperity::bench {

namespace {

constexpr const char* kLegend =
    "/Embree, /thesis, /tuned, /plain: ours over the fastest mode of Embree (named beside it), "
    "over\n"
    "the thesis' marching as printed and tuned, over our plain tracer. Modes: triangles or grid\n"
    "geometry; 1 ray, packets\n"
    "of 4, 8, 16, streams 1M, NM, Np; c: first segments flagged coherent. same: the plain tracer\n"
    "and Embree, from the same points, differ, as a share of what independent points would; far\n"
    "below 1. own: ours, from points of its own, and Embree differ, in units of what the spread\n"
    "of the repetitions lets expect; about 1.\n\n";

/// Means and the least of the ratios of all rows of one size.
struct Summary {
    int size = 0;
    std::size_t rows = 0;
    double over_embree = 0, least_over_embree = 0, over_thesis = 0, over_tuned = 0;
};

std::vector<Summary> summaries(const std::vector<Row>& rows) {
    std::vector<int> sizes;
    for (const Row& row : rows) {
        if (std::find(sizes.begin(), sizes.end(), row.size) == sizes.end()) {
            sizes.push_back(row.size);
        }
    }
    std::vector<Summary> result;
    for (const int size : sizes) {
        std::vector<double> embree, thesis, tuned;
        for (const Row& row : rows) {
            if (row.size != size) continue;
            embree.push_back(row.over(row.best_embree()));
            thesis.push_back(row.over(row.find("thesis")));
            tuned.push_back(row.over(row.find("tuned")));
        }
        result.push_back({size, embree.size(), geometric_mean(embree),
                          *std::min_element(embree.begin(), embree.end()), geometric_mean(thesis),
                          geometric_mean(tuned)});
    }
    return result;
}

double segments_per_path(const Row& row) {
    const Tally& tally = row.own().tally();
    return static_cast<double>(tally.segments()) / static_cast<double>(tally.paths());
}

/// Rivals of all rows, in order; large surfaces have fewer.
std::vector<std::string> rivals(const std::vector<Row>& rows) {
    std::vector<std::string> names;
    for (const Row& row : rows) {
        for (const Measured& m : row.measured) {
            if (std::find(names.begin(), names.end(), m.rival) == names.end()) {
                names.push_back(m.rival);
            }
        }
    }
    return names;
}

/// What was made ready, once for each surface; modes of one geometry share theirs.
std::string made_ready(const std::vector<Row>& rows) {
    std::string text = fmt::format("{:<14}{:>6}  {:<10}{:>10}{:>10}{:>14}\n", "surface", "N",
                                   "made ready", "build s", "MiB", "bytes/sample");
    for (std::size_t r = 0; r < rows.size(); ++r) {
        const Row& row = rows[r];
        if (r > 0 && rows[r - 1].surface == row.surface && rows[r - 1].size == row.size) continue;
        std::size_t last = 0;
        for (const Measured& m : row.measured) {
            if (m.memory_bytes == last) continue;
            last = m.memory_bytes;
            const auto bytes = static_cast<double>(m.memory_bytes);
            text += fmt::format("{:<14}{:>6}  {:<10}{:>10.3f}{:>10.1f}{:>14.2f}\n", row.surface,
                                row.size, m.rival, m.build_seconds, bytes / 0x1p20,
                                bytes / row.size / row.size);
        }
    }
    return text;
}

}  // namespace

std::string table(const std::vector<Row>& rows) {
    const std::vector<std::string> names = rivals(rows);
    std::string text = fmt::format("Millions of paths per CPU second, one thread\n{:<14}{:>6}{:>6}",
                                   "surface", "N", "theta");
    text += fmt::format("{:>9}", "seg/path");
    for (const std::string& name : names) text += fmt::format("{:>9}", name);
    text += fmt::format("{:>9} {:<8}{:>8}{:>8}{:>8}{:>8}{:>7}\n", "/Embree", "best", "/thesis",
                        "/tuned", "/plain", "same", "own");
    for (const Row& row : rows) {
        text += fmt::format("{:<14}{:>6}{:>6.0f}{:>9.3f}", row.surface, row.size, row.theta_deg,
                            segments_per_path(row));
        for (const std::string& name : names) {
            const Measured* m = row.find(name);
            text += m == nullptr ? fmt::format("{:>9}", "-")
                                 : fmt::format("{:>9.3f}", m->paths_per_second / 1e6);
        }
        const Measured* best = row.best_embree();
        text +=
            fmt::format("{:>9.2f} {:<8}{:>8.2f}{:>8.2f}{:>8.2f}{:>8.3f}{:>7.2f}\n", row.over(best),
                        best == nullptr ? "-" : best->rival, row.over(row.find("thesis")),
                        row.over(row.find("tuned")), row.over(row.find("plain")),
                        row.tight_disagreement(), row.loose_disagreement());
    }
    for (const Summary& s : summaries(rows)) {
        text += fmt::format(
            "N = {}, {} rows, geometric means: /Embree {:.2f} (least {:.2f}), /thesis {:.2f}, "
            "/tuned {:.2f}\n",
            s.size, s.rows, s.over_embree, s.least_over_embree, s.over_thesis, s.over_tuned);
    }
    return text + kLegend + made_ready(rows);
}

nlohmann::ordered_json json(const std::vector<Row>& rows) {
    nlohmann::ordered_json result;
    for (const Summary& s : summaries(rows)) {
        result["means"].push_back({{"size", s.size},
                                   {"rows", s.rows},
                                   {"over_best_embree", s.over_embree},
                                   {"least_over_best_embree", s.least_over_embree},
                                   {"over_thesis", s.over_thesis},
                                   {"over_tuned", s.over_tuned}});
    }
    for (const Row& row : rows) {
        const Measured* best = row.best_embree();
        nlohmann::ordered_json entry = {{"surface", row.surface},
                                        {"size", row.size},
                                        {"theta_deg", row.theta_deg},
                                        {"segments_per_path", segments_per_path(row)},
                                        {"best_embree", best == nullptr ? "" : best->rival},
                                        {"over_best_embree", row.over(best)},
                                        {"over_thesis", row.over(row.find("thesis"))},
                                        {"over_tuned", row.over(row.find("tuned"))},
                                        {"over_plain", row.over(row.find("plain"))},
                                        {"disagreement_same_points", row.tight_disagreement()},
                                        {"disagreement_own_points", row.loose_disagreement()}};
        for (const Measured& m : row.measured) {
            const Tally& tally = m.tally();
            entry["rivals"].push_back({{"name", m.rival},
                                       {"paths", tally.paths()},
                                       {"segments", tally.segments()},
                                       {"reflections", tally.reflections()},
                                       {"truncated", tally.truncated()},
                                       {"lost", tally.lost()},
                                       {"disagreement_same_points", row.off_plain(m)},
                                       {"paths_per_second", m.paths_per_second},
                                       {"segments_per_second", m.segments_per_second},
                                       {"build_seconds", m.build_seconds},
                                       {"memory_bytes", m.memory_bytes}});
        }
        result["rows"].push_back(std::move(entry));
    }
    return result;
}

}  // namespace asperity::bench
