// SPDX-License-Identifier: Apache-2.0
// As heights_test_files.h: a document of Mountains.
#pragma once

#include <asperity/formats/heights/scan_test_files.h>
#include <zlib.h>

#include <string>

namespace asperity::io::test {

inline std::string entry(int tag, const std::string& data) {
    return bytes_of(static_cast<std::uint16_t>(tag)) + bytes_of(std::uint64_t{data.size()}) + data;
}

inline std::string packed_block(std::uint64_t first, std::uint32_t items, const std::string& data) {
    std::string zipped(200, '\0');
    uLongf length = zipped.size();
    compress(reinterpret_cast<Bytef*>(zipped.data()), &length,
             reinterpret_cast<const Bytef*>(data.data()), data.size());
    zipped.resize(length);
    return bytes_of(first) + bytes_of(items) + bytes_of(static_cast<std::uint32_t>(length)) +
           zipped;
}

/// A compound file with one stream of at least 4096 bytes, in sectors of 512.
inline std::string compound_file(const std::string& name, const std::string& stream) {
    constexpr std::uint32_t kEnd = 0xfffffffe;
    const auto sectors = static_cast<std::uint32_t>((stream.size() + 511) / 512);
    std::string header(512, '\0'), table(512, '\xff'), directory(512, '\0');
    const auto set = [](std::string& part, std::size_t at, const std::string& bytes) {
        part.replace(at, bytes.size(), bytes);
    };
    set(header, 0, "\xd0\xcf\x11\xe0\xa1\xb1\x1a\xe1");
    set(header, 30, bytes_of(std::uint16_t{9}) + bytes_of(std::uint16_t{6}));
    set(header, 44, bytes_of(1) + bytes_of(1));
    set(header, 56, bytes_of(4096) + bytes_of(kEnd) + bytes_of(0) + bytes_of(kEnd) + bytes_of(0));
    set(header, 76, bytes_of(0) + std::string(108 * 4, '\xff'));
    set(table, 0, bytes_of(0xfffffffd) + bytes_of(kEnd));
    for (std::uint32_t k = 0; k < sectors; ++k)
        set(table, 4 * (k + 2), bytes_of(k + 1 == sectors ? kEnd : k + 3));
    set(directory, 0, wide_letters("Root Entry"));
    set(directory, 64, bytes_of(std::uint16_t{22}) + "\x05");
    set(directory, 128, wide_letters(name));
    set(directory, 128 + 64, bytes_of(static_cast<std::uint16_t>(2 * name.size() + 2)) + "\x02");
    set(directory, 128 + 116, bytes_of(2) + bytes_of(std::uint64_t{stream.size()}));
    std::string data = stream;
    data.resize(std::size_t{512} * sectors, '\0');
    return header + table + directory + data;
}

/// The heights in two blocks, the second one first; 0.5 um a count from 0.5 um on. The fourth point
/// is masked.
inline std::string mnt() {
    constexpr int kBase = 0xffff;
    const auto letters = [](const std::string& text) { return "\x04" + wide_letters(text); };
    const auto object = [](int kind, const std::string& body) {
        return entry(1, entry(1, bytes_of(kind))) + entry(2, body);
    };
    const auto scale = [&](double step, double origin) {
        return entry(kBase, entry(1, bytes_of(step)) + entry(2, letters("mm")) +
                                entry(3, letters("\xb5m")) + entry(5, bytes_of(origin)));
    };
    const auto lateral = [&](double step, int points) {
        return entry(kBase, scale(step, 0) + entry(1, bytes_of(points)));
    };
    const auto array = [&](int kind, int items, const std::string& data) {
        return object(kind, entry(1, bytes_of(items)) + entry(2, data));
    };
    std::string counts, mask(20, '\x16');
    for (const int n : {1, 3, 5, 0, 9, 11}) counts += bytes_of(n);
    for (const int k : {6, 7, 8, 12, 13}) mask[static_cast<std::size_t>(k)] = '\x09';
    const std::string heights = bytes_of(std::uint64_t{24}) +
                                packed_block(3, 3, counts.substr(12)) +
                                packed_block(0, 3, counts.substr(0, 12));
    const std::string hidden = object(
        9056,
        entry(1, bytes_of(3)) + entry(2, bytes_of(2)) +
            entry(5, array(9048, 20, bytes_of(std::uint64_t{20}) + packed_block(0, 20, mask))));
    const std::string title = entry(kBase, entry(kBase, entry(1, letters("By hand"))));
    const std::string grid = entry(
        kBase, title + entry(1, lateral(1e-3, 3)) + entry(2, lateral(2e-3, 2)) + entry(3, hidden));
    const std::string data =
        entry(kBase, grid + entry(1, array(9049, 6, heights)) + entry(2, scale(0.5e-3, 0.5)));
    const std::string item = entry(1, object(9012, entry(1, object(9062, data))));
    const std::string other = entry(1, object(4711, ""));
    const std::string list =
        bytes_of(std::uint64_t{other.size()}) + other + bytes_of(std::uint64_t{item.size()}) + item;
    const std::string tree =
        entry(1, entry(0xc8, std::string(4096, '\0')) +
                     entry(0x2bd, entry(1, "\x02") + entry(2, entry(1, list))));
    return compound_file("ScopedContents", bytes_of(std::uint64_t{tree.size()}) + tree);
}

}  // namespace asperity::io::test
