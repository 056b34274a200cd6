// SPDX-License-Identifier: Apache-2.0
// A small topography in the format of each instrument, written byte by byte from its layout: 3 x 2
// heights 1 .. 6 um, spacing 1 um x 2 um, the fourth height missing.
#pragma once

#include <asperity/formats/heights/mnt_test_file.h>
#include <asperity/formats/heights/scan_test_files.h>
#include <zlib.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <initializer_list>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace asperity::io::test {

template <typename Number>
std::string little(Number value) {
    std::string bytes(sizeof value, '\0');
    std::memcpy(bytes.data(), &value, sizeof value);
    return bytes;
}

template <typename Number>
std::string big(Number value) {
    std::string bytes = little(value);
    std::reverse(bytes.begin(), bytes.end());
    return bytes;
}

inline void set(std::string& file, std::size_t at, const std::string& bytes) {
    file.replace(at, bytes.size(), bytes);
}

inline std::string padded(std::string text, std::size_t length, char with = '\0') {
    text.resize(length, with);
    return text;
}

/// The heights as 32-bit floats, `gone` in the fourth place.
inline std::string six_floats(float gone, float scale = 1) {
    std::string bytes;
    for (int n = 1; n <= 6; ++n) bytes += little(n == 4 ? gone : scale * static_cast<float>(n));
    return bytes;
}

inline constexpr float kGone = std::numeric_limits<float>::quiet_NaN();

inline std::string sdf_text() {
    return "aISO-1.0\nNumPoints = 3\nNumProfiles = 2\nXscale = 1e-6\nYscale = 2e-6\nZscale = "
           "1e-6\nDataType = 7\n*\n1 2 3\nBAD 5 6\n*\n";
}

inline std::string sdf_binary() {
    std::string file = padded("bISO-1.0", 81);
    set(file, 42, little<std::uint16_t>(3));
    set(file, 44, little<std::uint16_t>(2));
    set(file, 46, little(1e-6) + little(2e-6) + little(1e-6));
    file[79] = 5;
    for (const int n : {1, 2, 3, -32768, 5, 6}) file += little(static_cast<std::int16_t>(n));
    return file;
}

inline std::string sur(bool compressed) {
    std::string file(512, '\0');
    set(file, 0, compressed ? "DSCOMPRESSED" : "DIGITAL SURF");
    set(file, 14, little<std::int16_t>(1) + little<std::int16_t>(1) + little<std::int16_t>(2));
    set(file, 86, little<std::int16_t>(1));
    set(file, 98, little<std::int16_t>(16) + little(1) + little(6) + little(3) + little(2));
    set(file, 120, little(1e-3f) + little(2e-3f) + little(1.0f));
    set(file, 180, "mm");
    set(file, 196, "mm");
    set(file, 212, "\xb5m");
    std::string data;
    for (const int n : {1, 2, 3, -1, 5, 6}) data += little(static_cast<std::int16_t>(n));
    if (!compressed) return file + data;
    std::string zipped(200, '\0');
    uLongf length = zipped.size();
    compress(reinterpret_cast<Bytef*>(zipped.data()), &length,
             reinterpret_cast<const Bytef*>(data.data()), data.size());
    zipped.resize(length);
    return file + little<std::uint32_t>(1) + little(static_cast<std::uint32_t>(data.size())) +
           little(static_cast<std::uint32_t>(length)) + zipped;
}

inline std::string metropro() {
    std::string file(834, '\0');
    set(file, 0, "\x88\x1b\x03\x6f");
    set(file, 6, big<std::uint32_t>(834));
    set(file, 68, big<std::uint16_t>(3) + big<std::uint16_t>(2));
    set(file, 164, big(1.0f) + big(4096e-6f));
    set(file, 176, big(1.0f));
    set(file, 184, big(1e-6f));
    for (const int n : {1, 2, 3, 2147483640, 5, 6}) file += big(n);
    return file;
}

/// Has no word for a missing point.
inline std::string tmd() {
    std::string file = padded("Binary TrueMap Data File v2.0\r\n", 32);
    file += std::string("by hand\0", 8) + little<std::uint32_t>(3) + little<std::uint32_t>(2) +
            little(3e-3f) + little(4e-3f) + little(0.0f) + little(0.0f);
    for (int n = 1; n <= 6; ++n) file += little(static_cast<float>(n) * 1e-3f);
    return file;
}

inline std::string npy() {
    std::string header = "{'descr': '<f8', 'fortran_order': False, 'shape': (2, 3), }";
    header.resize(117, ' ');
    header += '\n';
    std::string file = "\x93NUMPY" + std::string("\x01\x00", 2) +
                       little(static_cast<std::uint16_t>(header.size())) + header;
    for (int n = 1; n <= 6; ++n) file += little(static_cast<double>(n));
    return file;
}

/// A ZIP archive of files that are stored as they are.
inline std::string zip(const std::vector<std::pair<std::string, std::string>>& entries) {
    std::string file, directory;
    for (const auto& [name, bytes] : entries) {
        const auto crc = static_cast<std::uint32_t>(crc32(
            0, reinterpret_cast<const Bytef*>(bytes.data()), static_cast<uInt>(bytes.size())));
        const auto size = little(static_cast<std::uint32_t>(bytes.size()));
        const std::string common =
            little<std::uint16_t>(0) + little<std::uint16_t>(0) + little<std::uint16_t>(0) +
            little<std::uint16_t>(0x21) + little(crc) + size + size +
            little(static_cast<std::uint16_t>(name.size())) + little<std::uint16_t>(0);
        directory += "PK\x01\x02" + little<std::uint16_t>(20) + little<std::uint16_t>(20) + common +
                     std::string(10, '\0') + little(static_cast<std::uint32_t>(file.size())) + name;
        file += "PK\x03\x04" + little<std::uint16_t>(20) + common + name + bytes;
    }
    const auto count = little(static_cast<std::uint16_t>(entries.size()));
    return file + directory + "PK\x05\x06" + std::string(4, '\0') + count + count +
           little(static_cast<std::uint32_t>(directory.size())) +
           little(static_cast<std::uint32_t>(file.size())) + std::string(2, '\0');
}

inline std::string plux() {
    return zip({{"index.xml",
                 "<?xml version=\"1.0\"?><INDEX><GENERAL><IMAGE_SIZE_X>3</IMAGE_SIZE_X>"
                 "<IMAGE_SIZE_Y>2</IMAGE_SIZE_Y><FOV_X>1</FOV_X><FOV_Y>2</FOV_Y></GENERAL>"
                 "<LAYER_0><FILENAME_Z>LAYER_0.raw</FILENAME_Z></LAYER_0></INDEX>"},
                {"LAYER_0.raw", six_floats(kGone)}});
}

/// main.xml of an X3P file; `data` is what stands behind the size of its matrix.
inline std::string x3p_document(const std::string& data, const std::string& type = "D",
                                const std::string& root = "p:ISO5436_2") {
    return "<?xml version=\"1.0\" encoding=\"UTF-8\"?><" + root +
           " xmlns:p=\"http://www.opengps.eu/2008/ISO5436_2\"><Record1><Revision>ISO5436 - 2000"
           "</Revision><FeatureType>SUR</FeatureType><Axes><CX><AxisType>I</AxisType><DataType>D"
           "</DataType><Increment>1e-006</Increment><Offset>0</Offset></CX><CY><AxisType>I"
           "</AxisType><DataType>D</DataType><Increment>2e-6</Increment></CY><CZ><AxisType>A"
           "</AxisType><DataType>" +
           type +
           "</DataType><Increment>1e-6</Increment><Offset>0</Offset></CZ></Axes></Record1><Record3>"
           "<MatrixDimension><SizeX>3</SizeX><SizeY>2</SizeY><SizeZ>1</SizeZ></MatrixDimension>" +
           data + "</Record3></" + root + ">";
}

inline std::string x3p_text() {
    return zip({{"main.xml",
                 x3p_document("<DataList><Datum>1</Datum><Datum>2</Datum><Datum>3</Datum><Datum/>"
                              "<Datum>5</Datum><Datum>6</Datum></DataList>")}});
}

inline std::string x3p_binary() {
    std::string data;
    for (const int n : {1, 2, 3, 77, 5, 6}) data += little(static_cast<std::int16_t>(n));
    return zip({{"a/main.xml", x3p_document("<DataLink><PointDataLink>bindata/data.bin"
                                            "</PointDataLink><ValidPointsLink>bindata/valid.bin"
                                            "</ValidPointsLink></DataLink>",
                                            "I", "ISO5436")},
                {"a/bindata/data.bin", data},
                {"a/bindata/valid.bin", "\x37"}});
}

inline std::string gwy_object(const std::string& type, const std::string& components) {
    return type + '\0' + little(static_cast<std::uint32_t>(components.size())) + components;
}

inline std::string gwy_unit(const std::string& name, const std::string& unit) {
    return name + '\0' + 'o' +
           gwy_object("GwySIUnit", std::string("unitstr") + '\0' + 's' + unit + '\0');
}

inline std::string gwy_field(const std::vector<double>& heights) {
    const auto real = [](const char* name, double value) {
        return name + std::string("\0d", 2) + little(value);
    };
    const auto whole = [](const char* name, std::int32_t value) {
        return name + std::string("\0i", 2) + little(value);
    };
    std::string data;
    for (const double h : heights) data += little(h);
    return gwy_object("GwyDataField",
                      whole("xres", 3) + whole("yres", 2) + real("xreal", 3e-6) +
                          real("yreal", 4e-6) + gwy_unit("si_unit_xy", "m") +
                          gwy_unit("si_unit_z", "m") + "data" + std::string("\0D", 2) +
                          little(static_cast<std::uint32_t>(heights.size())) + data);
}

/// With a mask over the fourth point.
inline std::string gwy() {
    const auto object = [](const std::string& name, const std::string& bytes) {
        return name + std::string("\0o", 2) + bytes;
    };
    return "GWYP" + gwy_object("GwyContainer",
                               object("/0/data", gwy_field({1e-6, 2e-6, 3e-6, 9e-6, 5e-6, 6e-6})) +
                                   "/0/data/title" + std::string("\0s", 2) + "Height" + '\0' +
                                   object("/0/mask", gwy_field({0, 0, 0, 1, 0, 0})));
}

inline std::string opd() {
    const auto entry = [](const std::string& name, std::int16_t type, std::size_t bytes) {
        return padded(name, 16) + little(type) + little(static_cast<std::int32_t>(bytes)) +
               little<std::uint16_t>(0);
    };
    std::string array =
        little<std::uint16_t>(3) + little<std::uint16_t>(2) + little<std::uint16_t>(2);
    // Column by column, from the bottom up
    for (const int n : {32767, 1, 5, 2, 6, 3}) array += little(static_cast<std::int16_t>(n));
    const std::vector<std::pair<std::string, std::string>> blocks = {
        {"RAW DATA", array},
        {"Wavelength", little(1000.0f)},
        {"Mult", little<std::uint16_t>(1)},
        {"Pixel_size", little(1e-3f)},
        {"Aspect", little(2.0f)}};
    std::string file = std::string("\x01\0", 2) + entry("Directory", 1, 24 * (blocks.size() + 1));
    std::string payloads;
    for (const auto& [name, bytes] : blocks) {
        file += entry(name, name == "RAW DATA" ? 3 : 7, bytes.size());
        payloads += bytes;
    }
    return file + payloads;
}

inline std::string plu() {
    std::string file =
        padded(padded("Fri Mar 10 16:35:59 2023", 128) + little<std::uint32_t>(0), 388);
    file += little<std::uint32_t>(2) + little<std::uint32_t>(3) + little<std::uint32_t>(1) +
            little(1.0f) + little(1.0f) + little(2.0f) + padded("", 16);
    file += little<std::uint32_t>(3) + padded("", 16) + padded("", 40);
    file += padded(std::string("\0\x01", 2), 12);
    return file + little<std::uint32_t>(2) + little<std::uint32_t>(3) + six_floats(1000001) +
           little(1.0f) + little(6.0f);
}

inline std::string al3d() {
    const auto tag = [](const char* key, const std::string& value) {
        return padded(key, 20) + padded(value, 30) + "\r\n";
    };
    const std::string head = std::string("AliconaImaging\0\r\n", 17) + tag("Version", "1") +
                             tag("TagCount", "6") + tag("Cols", "3") + tag("Rows", "2") +
                             tag("PixelSizeXMeter", "1e-06") + tag("PixelSizeYMeter", "2e-06");
    const std::string offset = std::to_string(head.size() + 2 * 52);
    std::string file = head + tag("DepthImageOffset", offset) + tag("InvalidPixelValue", "1e10");
    for (int n = 1; n <= 6; ++n) {
        file += little(n == 4 ? 1e10f : static_cast<float>(n) * 1e-6f);
        if (n % 3 == 0) file += std::string(4, '\0');  // rows are padded to 8 bytes
    }
    return file;
}

/// Has no scale: heights 1 .. 6.
inline std::string tiff() {
    std::string directory;
    std::uint16_t count = 0;
    const auto add = [&](int tag, int type, std::uint32_t value) {
        directory += little(static_cast<std::uint16_t>(tag)) +
                     little(static_cast<std::uint16_t>(type)) + little<std::uint32_t>(1) +
                     little(value);
        ++count;
    };
    constexpr std::uint32_t kData = 8;
    add(256, 4, 3), add(257, 4, 2), add(258, 3, 32), add(259, 3, 1), add(262, 3, 1);
    add(273, 4, kData), add(277, 3, 1), add(278, 4, 2), add(279, 4, 24), add(339, 3, 3);
    return std::string("II*\0", 4) + little<std::uint32_t>(kData + 24) + six_floats(kGone) +
           little(count) + directory + little<std::uint32_t>(0);
}

inline std::string esri() {
    return "NCOLS 3\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 2\nNODATA_value -9999\n"
           "1 2 3\n-9999 5 6\n";
}

inline std::string spip() {
    return "# File Format = ASCII\n# x-pixels = 3\n# y-pixels = 2\n# x-length = 3000\n"
           "# y-length = 4000\n# Bit2nm = 1000\n1 2 3\nnan 5 6\n";
}

struct HeightsTestFile {
    std::string format;  ///< name of a row of HeightsFormats
    std::string bytes;
    double scale = 1e-6;  ///< of the heights 1 .. 6
    bool missing = true;  ///< the fourth
};

/// At least one of each format that is read and not written.
inline std::vector<HeightsTestFile> heights_test_files() {
    return {{"sdf", sdf_text()},
            {"sdf", sdf_binary()},
            {"sur", sur(false)},
            {"sur", sur(true)},
            {"metropro", metropro()},
            {"tmd", tmd(), 1e-6, false},
            {"npy", npy(), 1, false},
            {"plux", plux()},
            {"x3p", x3p_text()},
            {"x3p", x3p_binary()},
            {"gwy", gwy()},
            {"opd", opd()},
            {"plu", plu()},
            {"al3d", al3d()},
            {"bcr", bcr_integers()},
            {"bcr", bcr_floats()},
            {"nms", nms(), 1e-6, false},
            {"mnt", mnt()},
            {"park-tiff", park_tiff()},
            {"nanoscope", nanoscope(), 1e-6, false},
            {"tiff", tiff(), 1},
            {"esri", esri(), 1},
            {"spip", spip()},
            {"matrix", "1 2 3\nnan 5 6\n", 1},
            {"xyz", "0 0 1\n1 0 2\n2 0 3\n1 2 5\n2 2 6\n", 1}};
}

}  // namespace asperity::io::test
