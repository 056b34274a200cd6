// SPDX-License-Identifier: Apache-2.0
// One reader under libFuzzer, or all in turn; tools/fuzz runs it on each, the tests replay its
// seeds.
//
//   asperity_fuzz --list              the names of the readers, one a line
//   asperity_fuzz --seeds FOLDER      writes FOLDER/NAME/ with seeds and FOLDER/NAME.dict, and
//                                     FOLDER/all/ with the seeds of all and FOLDER/all.dict
//   ASPERITY_FUZZ=NAME asperity_fuzz  fuzzes that reader, with libFuzzer's options
//   ASPERITY_FUZZ=all asperity_fuzz   fuzzes the reader that the first byte of a file counts
#include "readers.h"

#include <asperity/formats/test_files.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <string_view>

namespace {

using asperity::test::Reader;
using asperity::test::readers;

/// The name the environment gives, "all" or one of the readers'.
std::string_view chosen() {
    const char* const name = std::getenv("ASPERITY_FUZZ");
    const std::string_view given = name == nullptr ? "" : name;
    const auto is_given = [&](const Reader& reader) { return reader.name == given; };
    if (given == "all" || std::ranges::any_of(readers(), is_given)) return given;
    std::fputs("asperity_fuzz: ASPERITY_FUZZ names no reader, see --list\n", stderr);
    std::exit(2);
}

/// The words as libFuzzer's dictionaries spell them.
std::string dictionary_of(const Reader& reader) {
    std::string text;
    for (const std::string& word : reader.words) {
        text += '"';
        for (const char c : word) text += fmt::format("\\x{:02x}", static_cast<unsigned char>(c));
        text += "\"\n";
    }
    return text;
}

void write_seeds(const std::filesystem::path& folder) {
    using asperity::io::test::put;
    std::string all_words;
    std::filesystem::create_directories(folder / "all");
    for (std::size_t r = 0; r < readers().size(); ++r) {
        const Reader& reader = readers()[r];
        std::filesystem::create_directories(folder / reader.name);
        for (std::size_t k = 0; k < reader.seeds.size(); ++k) {
            put(folder / reader.name / fmt::format("seed{}", k), reader.seeds[k]);
            put(folder / "all" / fmt::format("{}-seed{}", reader.name, k),
                static_cast<char>(r) + reader.seeds[k]);
        }
        put(folder / (reader.name + ".dict"), dictionary_of(reader));
        all_words += dictionary_of(reader);
    }
    put(folder / "all.dict", all_words);
}

/// Has the reader read a file of these bytes; ends the program when it does what none may.
void try_one(const Reader& reader, std::string_view bytes) {
    static const asperity::io::test::TemporaryFolder kFolder;
    const std::string path = kFolder / reader.file_name;
    asperity::io::test::put(path, std::string(bytes));
    const std::string fault = fault_of(reader, path);
    if (fault.empty()) return;
    std::fprintf(stderr, "%s: %s\n", reader.name.c_str(), fault.c_str());
    std::abort();
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
    readers();  // makes the seeds of all: no time of the first file's
    chosen();
    return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const std::string_view kChosen = chosen();
    const std::string_view bytes(reinterpret_cast<const char*>(data), size);
    if (kChosen != "all") {
        for (const Reader& reader : readers())
            if (reader.name == kChosen) try_one(reader, bytes);
    } else if (!bytes.empty()) {
        const std::size_t which = static_cast<unsigned char>(bytes.front()) % readers().size();
        try_one(readers()[which], bytes.substr(1));
    }
    return 0;
}
