// SPDX-License-Identifier: Apache-2.0
// Genuine files of instruments beside what another reader (SurfaceTopography 1.27.1) made of them:
// sides, lengths, missing points, single heights and moments. The files are no part of the project;
// where the folder is not there, the test says so.
#include <asperity/formats/heights/surface_files.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace asperity::io {
namespace {

using Json = nlohmann::json;
namespace fs = std::filesystem;

const fs::path kSamples = fs::path(ASPERITY_SAMPLES) / "topography";

std::vector<fs::path> goldens() {
    std::vector<fs::path> files;
    if (fs::is_directory(kSamples / "goldens"))
        for (const auto& entry : fs::directory_iterator(kSamples / "goldens"))
            files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    return files;
}

Topography read(const std::string& file) {
    Run run;
    HeightsOptions options;
    options.channel = "1";
    return read_topography(kSamples / file, options, run);
}

bool is_missing(const Topography& t, std::size_t sample) {
    return !t.missing.empty() && t.missing[sample] != 0;
}

double metres_of(const std::string& unit) {
    return unit == "mm" ? 1e-3 : unit == "µm" ? 1e-6 : unit == "nm" ? 1e-9 : 1;
}

struct Moments {
    double mean = 0, rms = 0;  ///< about the mean
};

Moments moments_of(const Topography& t) {
    double sum = 0, squares = 0;
    const auto count = static_cast<double>(t.heights.size() - t.missing_count());
    for (std::size_t k = 0; k < t.heights.size(); ++k)
        if (!is_missing(t, k)) sum += t.heights[k];
    const double mean = sum / count;
    for (std::size_t k = 0; k < t.heights.size(); ++k)
        if (!is_missing(t, k)) squares += (t.heights[k] - mean) * (t.heights[k] - mean);
    return {mean, std::sqrt(squares / count)};
}

TEST(Goldens, AgreeWithAnotherReader) {
    const std::vector<fs::path> files = goldens();
    if (files.empty()) GTEST_SKIP() << "no genuine files in " << kSamples;
    for (const fs::path& file : files) {
        SCOPED_TRACE(file.filename().string());
        const Json golden = Json::parse(std::ifstream(file));
        const Json& channel = golden["channels"][0];
        const Topography t = read(golden["fixture"]);
        EXPECT_EQ(t.nx, channel["nb_grid_pts"][0]);
        EXPECT_EQ(t.ny, channel["nb_grid_pts"][1]);
        if (t.nx != channel["nb_grid_pts"][0] || t.ny != channel["nb_grid_pts"][1]) continue;
        const double unit = metres_of(channel["unit"]);
        const double width = unit * channel["physical_sizes"][0].get<double>();
        const double height = unit * channel["physical_sizes"][1].get<double>();
        EXPECT_NEAR(t.nx * t.dx, width, 1e-9 * width);
        EXPECT_NEAR(t.ny * t.dy, height, 1e-9 * height);
        EXPECT_EQ(t.missing_count(), channel["nb_undefined"]);
        for (const Json& probe : channel["probe_pixels"]) {
            const std::size_t x = probe["pos"][0], y = probe["pos"][1];
            const std::size_t sample = y * static_cast<std::size_t>(t.nx) + x;
            EXPECT_EQ(is_missing(t, sample), probe["value"].is_null()) << probe;
            if (is_missing(t, sample) || probe["value"].is_null()) continue;
            const double value = unit * probe["value"].get<double>();
            EXPECT_NEAR(t.heights[sample], value, 1e-12 * std::abs(value)) << probe;
        }
        const Moments moments = moments_of(t);
        const double mean = unit * channel["masked_mean"].get<double>();
        const double rms = unit * channel["masked_rms"].get<double>();
        // A mean that was taken off is rounding
        EXPECT_NEAR(moments.mean, mean, 1e-9 * std::abs(mean) + 1e-14 * rms);
        EXPECT_NEAR(moments.rms, rms, 1e-9 * rms);
    }
}

}  // namespace
}  // namespace asperity::io
