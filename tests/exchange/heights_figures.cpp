// SPDX-License-Identifier: Apache-2.0
// heights_figures FILE HEIGHTS: what the library reads in a file of heights, before anything is
// done to it, as JSON on standard output; the heights, in metres or in the numbers of the file, as
// 64-bit floats in HEIGHTS, NaN where nothing was measured. For judge_genuine.py.
#include <asperity/core/error.h>
#include <asperity/formats/heights/heights_format.h>

#include <fstream>
#include <iostream>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>

using asperity::Topography;
using asperity::io::HeightsFormats;
using asperity::io::HeightsSource;
using Json = nlohmann::json;

namespace {

/// The first channel of heights.
Topography read_first(const HeightsFormats& formats, const std::string& path, asperity::Run& run) {
    const auto channels = formats.list(HeightsSource(path, {}, run));
    std::size_t first = 0;
    while (first + 1 < channels.size() && !channels[first].other.empty()) ++first;
    return formats.read(HeightsSource(path, {"", std::to_string(first + 1), ""}, run));
}

void write(Topography t, const std::string& path) {
    for (std::size_t k = 0; k < t.missing.size(); ++k)
        if (t.missing[k] != 0) t.heights[k] = std::numeric_limits<double>::quiet_NaN();
    std::ofstream file(path, std::ios::binary);
    file.write(reinterpret_cast<const char*>(t.heights.data()),
               static_cast<std::streamsize>(t.heights.size() * sizeof(double)));
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 3) return 2;
    Json json;
    try {
        asperity::Run run(1);
        const HeightsFormats formats;
        json["format"] = formats.for_reading(HeightsSource(argv[1], {}, run)).name;
        const Topography t = read_first(formats, argv[1], run);
        json.update({{"nx", t.nx},
                     {"ny", t.ny},
                     {"dx", t.dx},
                     {"dy", t.dy},
                     {"unit", t.unit},
                     {"found", t.found},
                     {"assumed", t.assumed}});
        write(t, argv[2]);
    } catch (const asperity::Error& error) {
        json["refused"] = error.what();
    }
    std::cout << json.dump() << '\n';
    return 0;
}
