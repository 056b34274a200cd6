// SPDX-License-Identifier: Apache-2.0
// As heights_test_files.h: BCR, NanoFocus, Park Systems' TIFF and Nanoscope.
#pragma once

#include <cstdint>
#include <cstring>
#include <initializer_list>
#include <string>

namespace asperity::io::test {

inline std::string bytes_of(const auto& value) {
    std::string bytes(sizeof value, '\0');
    std::memcpy(bytes.data(), &value, sizeof value);
    return bytes;
}

/// Every letter as two bytes.
inline std::string wide_letters(const std::string& text) {
    std::string wide;
    for (const char c : text) wide += {c, '\0'};
    return wide;
}

/// 16-bit integers, the high byte first; 2 nm a count.
inline std::string bcr_integers() {
    std::string file =
        "fileformat = bcrstm\n# by hand\nxpixels = 3\nypixels = 2\nxlength = 3000\nylength = 4000\n"
        "intelmode = 0\nbit2nm = 2\n";
    file.resize(2048, ' ');
    for (const int n : {500, 1000, 1500, 32767, 2500, 3000})
        file += {static_cast<char>(n >> 8), static_cast<char>(n & 255)};
    return file;
}

/// 32-bit floats behind a header of 16-bit letters, which is longer than usual.
inline std::string bcr_floats() {
    std::string head =
        "fileformat = bcrf_unicode\n%\nheadersize = 2100\nxpixels = 3\nypixels = 2\n"
        "xlength = 3000\nylength = 4\n xunit = nm\n yunit = um\n zunit = um\n";
    head.resize(2100, ' ');
    std::string file = wide_letters(head);
    for (const float n : {1.0f, 2.0f, 3.0f, 3.402823e38f, 5.0f, 6.0f}) file += bytes_of(n);
    return file;
}

/// Counts of 1/65534 of the 65.534 um from 0 on. Has no word for a missing point.
inline std::string nms() {
    std::string file(3468, '\0');
    const auto set = [&](std::size_t at, const std::string& bytes) {
        file.replace(at, bytes.size(), bytes);
    };
    set(16, bytes_of(0.0) + bytes_of(65.534));
    set(32, "OM_MS_2.0");
    set(1368, bytes_of(3) + bytes_of(2) + bytes_of(1000.0) + bytes_of(2000.0));
    for (int n = 1; n <= 6; ++n) file += bytes_of(static_cast<std::uint16_t>(1000 * n));
    return file;
}

/// Floats, the bottom line first: heights are 2 (1 n + 0.5) nm. A picture of 1 x 1 stands in front.
inline std::string park_tiff() {
    std::string header(360, '\0');
    const auto set = [&](std::size_t at, const std::string& bytes) {
        header.replace(at, bytes.size(), bytes);
    };
    set(4, wide_letters("Height"));
    set(100, bytes_of(3) + bytes_of(2));
    set(140, bytes_of(3.0) + bytes_of(4.0));
    set(220, bytes_of(2.0) + bytes_of(1.0) + bytes_of(0.5));
    set(244, wide_letters("nm"));
    set(348, bytes_of(2));
    std::string data;
    for (const float n : {0.0f, 2499.5f, 2999.5f, 499.5f, 999.5f, 1499.5f}) data += bytes_of(n);
    const std::uint32_t gone = 0x7fc00000;
    data.replace(0, 4, bytes_of(gone));

    std::string directory;
    std::uint16_t count = 0;
    const auto add = [&](int tag, int type, std::uint32_t many, std::uint32_t value) {
        directory += bytes_of(static_cast<std::uint16_t>(tag)) +
                     bytes_of(static_cast<std::uint16_t>(type)) + bytes_of(many) + bytes_of(value);
        ++count;
    };
    constexpr std::uint32_t kFirst = 12;  // behind the picture
    add(256, 4, 1, 1), add(257, 4, 1, 1), add(258, 3, 1, 8), add(259, 3, 1, 1), add(262, 3, 1, 1);
    add(273, 4, 1, 8), add(277, 3, 1, 1), add(278, 4, 1, 1), add(279, 4, 1, 1);
    add(50432, 4, 1, 0x0e031301), add(50433, 4, 1, 0x01000002);
    add(50434, 1, 24, kFirst + 360), add(50435, 7, 360, kFirst);
    return std::string("II*\0", 4) + bytes_of(kFirst + 360 + 24) + std::string(4, '\0') + header +
           data + bytes_of(count) + directory + std::string(4, '\0');
}

/// Two images: 16-bit heights, the bottom line first, 2000 V / 65536 x 32.768 um/V = 1 um a count,
/// and a phase. Has no word for a missing point.
inline std::string nanoscope() {
    const auto image = [](const std::string& at, const std::string& scale) {
        return "\\*Ciao image list\r\n\\Data offset: " + at +
               "\r\n\\Data length: 12\r\n\\Bytes/pixel: 2\r\n\\Samps/line: 3\r\n"
               "\\Number of lines: 2\r\n\\Scan Size: 3 4 ~m\r\n" +
               scale + "\r\n";
    };
    std::string file =
        "\\*File list\r\n\\Version: 0x05120130\r\n\\*Scanner list\r\n"
        "\\@Sens. Zsens: V 32.768 um/V\r\n\\*Ciao scan list\r\n\\Scan Size: 3000 nm\r\n" +
        image("2048",
              "\\@2:Image Data: S [Height] \"Height\"\r\n"
              "\\@2:Z scale: V [Sens. Zsens] (0.03 V/LSB) 2000000 mV") +
        image("2060",
              "\\@2:Image Data: S [Phase] \"Phase\"\r\n"
              "\\@2:Z scale: V [Sens. Phase] (0.0055 deg(a)/LSB) 360 deg") +
        "\\*File list end\r\n\x1a";
    file.resize(2048, '\0');
    for (const int n : {4, 5, 6, 1, 2, 3, 7, 7, 7, 7, 7, 7})
        file += bytes_of(static_cast<std::int16_t>(n));
    return file;
}

}  // namespace asperity::io::test
