// SPDX-License-Identifier: Apache-2.0
// Every reader of the library, taken from the registries where there are such, with files to start
// from: for the damaged files of tests/faults and for libFuzzer.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace asperity::test {

struct Reader {
    std::string name;                ///< "models-stl"
    std::string file_name;           ///< with the ending its files have
    std::vector<std::string> seeds;  ///< good files, whole
    std::vector<std::string> words;  ///< that its files are made of, for the fuzzer's dictionary
    /// Reads the file. Throws what the reader throws, and std::logic_error when what it returns is
    /// not what it promises.
    std::function<void(const std::string& path)> read;
};

/// A new row of a registry is here by itself. Its seeds come from its writer or, for one that
/// cannot write, from more_seeds() in readers.cpp; without any it starts from those of its
/// neighbours.
const std::vector<Reader>& readers();

/// Has the reader read the file. "" when it was read or refused as it should be; else what was
/// wrong: another exception, an error without a place or of several lines, or of a code that no
/// content may cause.
std::string fault_of(const Reader& reader, const std::string& path);

}  // namespace asperity::test
