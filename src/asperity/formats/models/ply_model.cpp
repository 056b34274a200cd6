// SPDX-License-Identifier: Apache-2.0
// Stanford PLY, as text or binary: the elements vertex, face and tristrips are read, in any order.
#include <asperity/core/parse_number.h>
#include <asperity/formats/models/far_coordinates.h>
#include <asperity/formats/models/model_formats.h>
#include <asperity/formats/models/model_text.h>
#include <asperity/formats/models/ply_header.h>
#include <asperity/formats/models/polygon.h>
#include <asperity/formats/read_file.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <span>
#include <utility>
#include <vector>

namespace asperity::io::detail {
namespace {

static_assert(std::endian::native == std::endian::little);

/// The values of the body one after the other, whatever the encoding.
class Values {
  public:
    Values(std::string_view file, const PlyHeader& header, const std::string& path)
        : body_(file.substr(header.bytes)),
          start_(header.bytes),
          encoding_(header.encoding),
          words_(body_, header.lines + 1, header.end_of_line),
          path_(path) {}

    double next(PlyType type) {
        return encoding_ == PlyEncoding::Text ? next_word() : next_binary(type);
    }

    /// Bytes that are left.
    std::size_t left() const {
        return encoding_ == PlyEncoding::Text ? words_.left() : body_.size() - place_;
    }

    [[noreturn]] void fail(std::string why) const {
        if (encoding_ == PlyEncoding::Text) fail_at_line(path_, words_.line(), std::move(why));
        fail_at_byte(path_, start_ + place_, std::move(why));
    }

  private:
    double next_word() {
        const std::string_view word = words_.next();
        if (word.empty()) fail("the file ends before its last element");
        const auto number = parse_coordinate(word);
        if (!number) fail(fmt::format("{} is not a number", in_quotes(word)));
        return *number;
    }

    double next_binary(PlyType type) {
        const std::size_t size = bytes_of(type);
        if (left() < size) fail("the file ends before its last element");
        std::array<char, 8> bytes{};
        std::copy_n(body_.begin() + static_cast<std::ptrdiff_t>(place_), size, bytes.begin());
        if (encoding_ == PlyEncoding::BigEndian)
            std::reverse(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size));
        place_ += size;
        switch (type) {
            case PlyType::Int8:
                return as<std::int8_t>(bytes);
            case PlyType::Uint8:
                return as<std::uint8_t>(bytes);
            case PlyType::Int16:
                return as<std::int16_t>(bytes);
            case PlyType::Uint16:
                return as<std::uint16_t>(bytes);
            case PlyType::Int32:
                return as<std::int32_t>(bytes);
            case PlyType::Uint32:
                return as<std::uint32_t>(bytes);
            case PlyType::Float32:
                return static_cast<double>(as<float>(bytes));
            case PlyType::Float64:
                break;
        }
        return as<double>(bytes);
    }

    template <typename Number>
    static Number as(const std::array<char, 8>& bytes) {
        Number value;
        std::memcpy(&value, bytes.data(), sizeof value);
        return value;
    }

    std::string_view body_;
    std::size_t start_, place_ = 0;
    PlyEncoding encoding_;
    Words words_;
    const std::string& path_;
};

class PlyReader {
  public:
    PlyReader(ModelSource& source, std::string_view file)
        : source_(source),
          header_(read_ply_header(file, source.path)),
          values_(file, header_, source.path) {}

    Model read() {
        for (const PlyElement& element : header_.elements) {
            if (element.name == "vertex")
                read_vertices(element);
            else if (element.name == "face")
                read_lists(element, &PlyReader::read_polygon);
            else if (element.name == "tristrips")
                read_lists(element, &PlyReader::read_strips);
            else
                skip(element);
        }
        cut_waiting();
        Model model;
        if (mesh_.triangles.empty()) return model;
        Extent extent;
        for (const auto& triangle : mesh_.triangles) {
            for (const std::uint32_t v : triangle) extent.add(positions_[v]);
        }
        const Vec3 origin = extent.origin();
        mesh_.positions.reserve(positions_.size());
        for (const Vec3 p : positions_) mesh_.positions.push_back(relative_to(origin, p));
        add_mesh(model, std::move(mesh_), origin);
        if (std::string far = remark_on(extent); !far.empty())
            source_.remarks.push_back(std::move(far));
        if (rough_polygons_ > 0)
            source_.remarks.push_back(remark_on_rough_polygons(rough_polygons_));
        return model;
    }

  private:
    void read_vertices(const PlyElement& element) {
        if (!positions_.empty()) values_.fail("a second element 'vertex'");
        if (element.count > std::numeric_limits<std::uint32_t>::max())
            values_.fail("more vertices than 32 bits can count");
        const std::array<int, 6> places = {element.find("x"),  element.find("y"),
                                           element.find("z"),  element.find("nx"),
                                           element.find("ny"), element.find("nz")};
        if (std::min({places[0], places[1], places[2]}) < 0)
            values_.fail("the vertices have no x, y and z");
        const bool has_normals = std::min({places[3], places[4], places[5]}) >= 0;
        positions_.reserve(element.count);
        if (has_normals) mesh_.normals.reserve(element.count);
        for (std::uint64_t v = 0; v < element.count; ++v) {
            std::array<double, 6> found{};
            for (std::size_t i = 0; i < element.properties.size(); ++i) {
                const double value = read_value(element.properties[i]);
                for (std::size_t k = 0; k < 6; ++k) {
                    if (places[k] == static_cast<int>(i)) found[k] = value;
                }
            }
            positions_.push_back({found[0], found[1], found[2]});
            if (has_normals)
                mesh_.normals.push_back(relative_to({}, {found[3], found[4], found[5]}));
        }
    }

    using ReadList = void (PlyReader::*)(const PlyProperty&);

    /// The lists of corners of an element, each by the function given.
    void read_lists(const PlyElement& element, ReadList read_list) {
        int place = element.find("vertex_indices");
        if (place < 0) place = element.find("vertex_index");
        if (place < 0 || !element.properties[static_cast<std::size_t>(place)].is_list)
            values_.fail(fmt::format("element '{}' has no list 'vertex_indices'", element.name));
        for (std::uint64_t f = 0; f < element.count; ++f) {
            for (std::size_t i = 0; i < element.properties.size(); ++i) {
                if (static_cast<int>(i) == place)
                    (this->*read_list)(element.properties[i]);
                else
                    read_value(element.properties[i]);
            }
        }
    }

    void read_polygon(const PlyProperty& property) {
        const std::uint64_t corners = list_length(property);
        if (corners < 3)
            values_.fail(fmt::format("a face of {} corners, at least 3 are needed", corners));
        polygon_.clear();
        for (std::uint64_t k = 0; k < corners; ++k)
            polygon_.push_back(vertex(values_.next(property.type)));
        add_polygon();
    }

    /// Strips of triangles one after the other, -1 between them; every second triangle of a strip
    /// turns the other way.
    void read_strips(const PlyProperty& property) {
        std::uint64_t in_strip = 0;
        std::array<std::uint32_t, 3> last{};
        for (std::uint64_t n = list_length(property); n > 0; --n) {
            const double index = values_.next(property.type);
            if (index == -1) {
                in_strip = 0;
                continue;
            }
            last = {last[1], last[2], vertex(index)};
            if (++in_strip < 3) continue;
            const auto [a, b, c] = last;
            if (a == b || b == c || c == a) continue;  // only leads on
            polygon_ = in_strip % 2 == 1 ? std::vector{a, b, c} : std::vector{b, a, c};
            add_polygon();
        }
    }

    std::uint32_t vertex(double index) const {
        // Written so that a NaN is refused as well.
        const auto most = static_cast<double>(number_of_vertices());
        if (!(index >= 0 && index < most) || index != std::floor(index))
            values_.fail(fmt::format("a face refers to vertex {}, the file has {}", index,
                                     number_of_vertices()));
        return static_cast<std::uint32_t>(index);
    }

    /// By the header: the vertices may come after the faces.
    std::uint64_t number_of_vertices() const {
        for (const PlyElement& element : header_.elements) {
            if (element.name == "vertex")
                return std::min<std::uint64_t>(element.count,
                                               std::numeric_limits<std::uint32_t>::max());
        }
        return 0;
    }

    /// Cuts `polygon_` into triangles, at once where its vertices are known.
    void add_polygon() {
        triangles_ += polygon_.size() - 2;
        if (triangles_ > source_.limits.triangles)
            values_.fail(fmt::format("more than {} triangles", source_.limits.triangles));
        if (positions_.empty()) {
            waiting_.push_back(static_cast<std::uint32_t>(polygon_.size()));
            waiting_.insert(waiting_.end(), polygon_.begin(), polygon_.end());
        } else if (!cut_polygon(polygon_, positions_, mesh_.triangles)) {
            ++rough_polygons_;
        }
    }

    void cut_waiting() {
        for (std::size_t at = 0; at < waiting_.size();) {
            const std::span corners = std::span(waiting_).subspan(at + 1, waiting_[at]);
            polygon_.assign(corners.begin(), corners.end());
            at += 1 + corners.size();
            if (!cut_polygon(polygon_, positions_, mesh_.triangles)) ++rough_polygons_;
        }
    }

    std::uint64_t list_length(const PlyProperty& property) {
        const double length = values_.next(property.count_type);
        // A value takes a byte or more, so nothing longer than the file is believed.
        if (!(length >= 0 && length <= static_cast<double>(values_.left())) ||
            length != std::floor(length))
            values_.fail(fmt::format("a list of {} values in {} bytes", length, values_.left()));
        return static_cast<std::uint64_t>(length);
    }

    /// Reads past the property; returns its value when it is not a list.
    double read_value(const PlyProperty& property) {
        if (!property.is_list) return values_.next(property.type);
        for (std::uint64_t n = list_length(property); n > 0; --n) values_.next(property.type);
        return 0;
    }

    void skip(const PlyElement& element) {
        for (std::uint64_t i = 0; i < element.count; ++i) {
            for (const PlyProperty& property : element.properties) read_value(property);
        }
    }

    ModelSource& source_;
    PlyHeader header_;
    Values values_;
    std::vector<Vec3> positions_;
    TriangleMesh mesh_;  ///< its positions come last
    std::vector<std::uint32_t> polygon_;
    std::vector<std::uint32_t> waiting_;  ///< polygons read before the vertices: corners, indices
    std::uint64_t triangles_ = 0;
    std::uint64_t rough_polygons_ = 0;
};

Model read_ply(ModelSource& source) {
    const std::string file = read_text_file(source.path, source.limits.file_bytes);
    return PlyReader(source, without_byte_order_mark(file, source.path)).read();
}

bool is_ply(const FileStart& start) {
    std::string_view bytes = start.bytes;
    if (bytes.starts_with(kByteOrderMark)) bytes.remove_prefix(kByteOrderMark.size());
    return bytes.starts_with("ply\n") || bytes.starts_with("ply\r");
}

}  // namespace

ModelFormat ply_format() {
    return {"Stanford PLY", {".ply"}, is_ply, read_ply};
}

}  // namespace asperity::io::detail
