// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/formats/heights/binary_view.h>
#include <asperity/formats/heights/heights_source.h>
#include <asperity/formats/heights/zip_archive.h>

#include <pugixml.hpp>

#include <string>
#include <vector>

namespace asperity::io {

struct X3pAxis {
    bool absolute = false;  ///< each point has its own coordinate
    NumberType type = NumberType::F64;
    double increment = 1, offset = 0;
};

/// The stored numbers of a document, by point and by item within a point.
class X3pNumbers {
  public:
    std::vector<double> texts;     ///< from <Datum>; NaN where missing
    std::vector<std::byte> bytes;  ///< else the binary file
    std::vector<NumberType> types;
    std::string path;

    double at(std::size_t point, std::size_t item) const;
    std::size_t point_bytes() const;
};

/// main.xml of an X3P file with what it points to. The constructor throws Error(InvalidInput,
/// path); sizes are compared with the data before anything of that size is allocated.
class X3pDocument {
  public:
    explicit X3pDocument(const HeightsSource& source);

    std::string feature;  ///< SUR, PRF, PCL
    X3pAxis x, y, z;
    std::uint64_t nx = 0, ny = 0;  ///< of a list: its length and 1
    bool list = false;
    std::vector<std::string> remarks;  ///< on what is not as the standard has it

    std::uint64_t points() const { return nx * ny; }
    std::uint64_t rows() const { return ny; }
    bool valid(std::size_t point) const;
    X3pNumbers numbers(std::size_t per_point) const;

  private:
    void read_axes(const pugi::xml_node& record);
    X3pAxis read_axis(const pugi::xml_node& axes, const char* name, bool is_z) const;
    void read_size(const pugi::xml_node& record);
    void read_validity(const pugi::xml_node& link);
    std::string entry(const std::string& name) const;
    std::vector<double> read_datums(const pugi::xml_node& list, std::size_t per_point) const;
    [[noreturn]] void refuse(const std::string& why) const;

    std::string path_, folder_;
    ZipArchive archive_;
    pugi::xml_document xml_;
    std::vector<std::byte> valid_;
};

}  // namespace asperity::io
