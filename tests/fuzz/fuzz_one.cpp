// SPDX-License-Identifier: Apache-2.0
// One reader under libFuzzer; tools/fuzz runs it on all.
//
//   asperity_fuzz --list              the names of the readers, one a line
//   asperity_fuzz --seeds FOLDER      writes FOLDER/NAME/ with seeds and FOLDER/NAME.dict
//   ASPERITY_FUZZ=NAME asperity_fuzz  fuzzes that reader, with libFuzzer's options
#include "readers.h"

#include <asperity/formats/test_files.h>
#include <fmt/format.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <string_view>

namespace {

using asperity::test::Reader;
using asperity::test::readers;

const Reader& chosen() {
    const char* const name = std::getenv("ASPERITY_FUZZ");
    for (const Reader& reader : readers()) {
        if (name != nullptr && reader.name == name) return reader;
    }
    std::fputs("asperity_fuzz: ASPERITY_FUZZ names no reader, see --list\n", stderr);
    std::exit(2);
}

void write_seeds(const std::filesystem::path& folder) {
    for (const Reader& reader : readers()) {
        std::filesystem::create_directories(folder / reader.name);
        for (std::size_t k = 0; k < reader.seeds.size(); ++k)
            asperity::io::test::put(folder / reader.name / fmt::format("seed{}", k),
                                    reader.seeds[k]);
        std::string words;
        for (const std::string& word : reader.words) {
            words += '"';
            for (const char c : word)
                words += fmt::format("\\x{:02x}", static_cast<unsigned char>(c));
            words += "\"\n";
        }
        asperity::io::test::put(folder / (reader.name + ".dict"), words);
    }
}

}  // namespace

extern "C" int LLVMFuzzerInitialize(int* argc, char*** argv) {
    const std::string_view first = *argc > 1 ? (*argv)[1] : "";
    if (first == "--list") {
        for (const Reader& reader : readers()) std::puts(reader.name.c_str());
        std::exit(0);
    }
    if (first == "--seeds" && *argc > 2) {
        write_seeds((*argv)[2]);
        std::exit(0);
    }
    chosen();
    return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const Reader& kReader = chosen();
    static const asperity::io::test::TemporaryFolder kFolder;
    const std::string path = kFolder / kReader.file_name;
    asperity::io::test::put(path, {reinterpret_cast<const char*>(data), size});
    const std::string fault = fault_of(kReader, path);
    if (!fault.empty()) {
        std::fprintf(stderr, "%s: %s\n", kReader.name.c_str(), fault.c_str());
        std::abort();
    }
    return 0;
}
