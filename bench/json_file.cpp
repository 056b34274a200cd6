// SPDX-License-Identifier: Apache-2.0
#include "json_file.h"

#include <fstream>
#include <stdexcept>

namespace asperity::bench {

namespace {

/// A line of /proc/cpuinfo, such as "model name".
std::string processor(const std::string& key) {
    std::ifstream file("/proc/cpuinfo");
    for (std::string line; std::getline(file, line);) {
        const std::size_t colon = line.find(": ");
        if (line.starts_with(key) && colon != std::string::npos) return line.substr(colon + 2);
    }
    return "unknown";
}

/// The widest registers, as the processor says.
std::string registers() {
    const std::string flags = " " + processor("flags") + " ";
    for (const char* name : {"avx512f", "avx2", "avx", "sse4_1"}) {
        if (flags.find(" " + std::string(name) + " ") != std::string::npos) return name;
    }
    return "sse2";
}

}  // namespace

void add_to_json(const std::string& path, const std::string& section,
                 const nlohmann::ordered_json& figures) {
    nlohmann::ordered_json all;
    if (std::ifstream old(path); old) all = nlohmann::ordered_json::parse(old);
    all["processor"] = {{"name", processor("model name")}, {"registers", registers()}};
    all[section] = figures;
    std::ofstream file(path);
    file << all.dump(2) << '\n';
    if (!file.flush()) throw std::runtime_error(path + ": cannot be written");
}

}  // namespace asperity::bench
