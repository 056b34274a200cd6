// SPDX-License-Identifier: Apache-2.0
// Wavefront OBJ: v, vn, f and o are read; f may be a polygon and count from the end.
#include <asperity/core/parse_number.h>
#include <asperity/formats/models/far_coordinates.h>
#include <asperity/formats/models/model_formats.h>
#include <asperity/formats/models/model_text.h>
#include <asperity/formats/models/polygon.h>
#include <asperity/formats/read_file.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <optional>
#include <set>
#include <span>
#include <system_error>
#include <unordered_map>
#include <utility>

namespace asperity::io::detail {
namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
constexpr std::size_t kMostRemarks = 20;

/// Statements of the format that add nothing to the triangles, and do no harm.
constexpr std::array kLeftOut = {
    "vt",       "vp",   "g",      "s",      "mg",         "usemtl",    "l",     "p",
    "cstype",   "deg",  "bmat",   "step",   "curv",       "curv2",     "surf",  "parm",
    "trim",     "hole", "scrv",   "sp",     "end",        "con",       "bevel", "c_interp",
    "d_interp", "lod",  "maplib", "usemap", "shadow_obj", "trace_obj", "ctech", "stech"};

/// A corner of a face; indices count from 0.
struct Corner {
    std::uint32_t position = 0, normal = kNone;
};

/// Corners of all faces of one object, one after the other.
struct Object {
    std::string name;
    std::vector<Corner> corners;
    std::vector<std::size_t> ends;  ///< of each face, in corners
    std::uint64_t triangles = 0;
};

/// Indices that were used, against how many there are in the end: a face may come before the
/// vertices it uses.
class LargestIndex {
  public:
    void use(std::int64_t index, std::uint64_t line) {
        if (records_.empty() || index > records_.back().first) records_.emplace_back(index, line);
    }
    /// Of the first use of an index that is not below `count`.
    std::optional<std::pair<std::int64_t, std::uint64_t>> first_beyond(std::size_t count) const {
        for (const auto& record : records_) {
            if (record.first >= static_cast<std::int64_t>(count)) return record;
        }
        return std::nullopt;
    }

  private:
    std::vector<std::pair<std::int64_t, std::uint64_t>> records_;  ///< growing; index and line
};

class ObjReader {
  public:
    ObjReader(ModelSource& source, std::string text)
        : source_(source), text_(std::move(text)), objects_(1) {}

    Model read() {
        const std::string_view text = without_byte_order_mark(text_, source_.path);
        Words lines(text, 1, end_of_line(text));
        while (lines.left() > 0) read_statement(lines);
        check_indices(used_positions_, positions_.size(), "vertex");
        check_indices(used_normals_, normals_.size(), "normal");
        check_indices(used_textures_, textures_, "texture coordinate");
        Extent extent;
        for (const Object& object : objects_) {
            for (const Corner& corner : object.corners) extent.add(positions_[corner.position]);
        }
        const Vec3 origin = extent.origin();
        Model model;
        for (const Object& object : objects_) {
            if (!object.ends.empty()) add_mesh(model, make_mesh(object, origin), origin);
        }
        check_limits(model, source_);
        if (std::string far = remark_on(extent); !far.empty()) remark(std::move(far));
        if (rough_polygons_ > 0) remark(remark_on_rough_polygons(rough_polygons_));
        return model;
    }

  private:
    /// Reads one statement; a backslash at its end carries a line on to the next.
    void read_statement(Words& lines) {
        line_ = lines.line();
        std::string_view line = lines.rest_of_line();
        if (!trimmed(line).ends_with('\\')) {
            read_line(line);
            return;
        }
        std::string joined;
        for (; trimmed(line).ends_with('\\'); line = lines.rest_of_line()) {
            line = trimmed(line);
            joined += std::string(line.substr(0, line.size() - 1)) + ' ';
        }
        read_line(joined + std::string(line));
    }

    void read_line(std::string_view line) {
        Words words(line.substr(0, line.find('#')));
        const std::string_view what = words.next();
        if (what.empty()) return;
        if (what == "v")
            read_triple(words, positions_, "vertex");
        else if (what == "vn")
            read_triple(words, normals_, "normal");
        else if (what == "f" || what == "fo")
            read_face(words);
        else if (what == "o")
            start_object(trimmed(words.rest_of_line()));
        else if (what == "mtllib")
            look_for_materials(trimmed(words.rest_of_line()));
        else
            leave_out(what);
    }

    void leave_out(std::string_view what) {
        if (what == "vt") ++textures_;
        if (std::find(kLeftOut.begin(), kLeftOut.end(), what) != kLeftOut.end()) return;
        const auto is_word = [](char c) {
            return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
        };
        if (!std::all_of(what.begin(), what.end(), is_word))
            fail(fmt::format("{} is not a statement of OBJ", in_quotes(what)));
        if (unknown_.insert(std::string(what)).second)
            remark(fmt::format("line {}: statement {} is not known and left out", line_,
                               in_quotes(what)));
    }

    template <typename Triple>
    void read_triple(Words& words, std::vector<Triple>& triples, const char* what) {
        using Number = decltype(Triple::x);
        std::array<Number, 3> xyz{};
        for (Number& value : xyz) {
            const std::string_view word = words.next();
            const auto number = parse_coordinate(word);
            if (!number)
                fail(word.empty() ? fmt::format("a {} needs three numbers", what)
                                  : fmt::format("{} is not a number", in_quotes(word)));
            value = static_cast<Number>(*number);
        }
        if (triples.size() >= kNone) fail(fmt::format("too many of: {}", what));
        triples.push_back({xyz[0], xyz[1], xyz[2]});
    }

    void read_face(Words& words) {
        Object& object = objects_.back();
        const std::size_t first = object.corners.size();
        for (std::string_view word = words.next(); !word.empty(); word = words.next())
            object.corners.push_back(read_corner(word));
        const std::size_t corners = object.corners.size() - first;
        if (corners < 3) fail(fmt::format("a face of {} corners, at least 3 are needed", corners));
        object.ends.push_back(object.corners.size());
        object.triangles += corners - 2;
        triangles_ += corners - 2;
        if (triangles_ > source_.limits.triangles)
            fail(fmt::format("more than {} triangles", source_.limits.triangles));
    }

    /// "v", "v/t", "v//n" or "v/t/n"; some programs leave separators with nothing behind them.
    Corner read_corner(std::string_view word) {
        const std::vector<std::string_view> parts = split(word, '/');
        if (parts.size() > 3) fail(fmt::format("{} is not a corner", in_quotes(word)));
        Corner corner;
        corner.position = index(parts[0], positions_.size(), used_positions_);
        if (parts.size() >= 2 && !parts[1].empty()) index(parts[1], textures_, used_textures_);
        if (parts.size() == 3 && !parts[2].empty())
            corner.normal = index(parts[2], normals_.size(), used_normals_);
        return corner;
    }

    /// From 1 on, or from -1 down counted from the last there is so far; returned from 0 on.
    std::uint32_t index(std::string_view word, std::size_t count, LargestIndex& used) {
        const auto number = parse_integer<std::int64_t>(word);
        if (!number) fail(fmt::format("{} is not an index", in_quotes(word)));
        if (*number == 0) fail("index 0: indices count from 1");
        const auto there = static_cast<std::int64_t>(count);
        if (*number < -there) fail(fmt::format("index {} of {} there are so far", *number, there));
        const std::int64_t from_0 = *number > 0 ? *number - 1 : *number + there;
        if (from_0 >= std::int64_t{kNone}) fail(fmt::format("index {} is too large", *number));
        if (from_0 >= there) used.use(from_0, line_);
        return static_cast<std::uint32_t>(from_0);
    }

    void start_object(std::string_view name) {
        if (!objects_.back().ends.empty()) objects_.emplace_back();
        objects_.back().name = std::string(name);
    }

    void look_for_materials(std::string_view name) {
        std::error_code error;
        const auto folder = std::filesystem::path(source_.path).parent_path();
        if (!std::filesystem::exists(folder / std::filesystem::path(name), error))
            remark(fmt::format("line {}: material file {} is missing", line_, in_quotes(name)));
    }

    void remark(std::string text) {
        if (source_.remarks.size() < kMostRemarks) source_.remarks.push_back(std::move(text));
    }

    void check_indices(const LargestIndex& used, std::size_t count, const char* what) const {
        if (const auto beyond = used.first_beyond(count))
            fail_at_line(source_.path, beyond->second,
                         fmt::format("a face refers to {} {}, the file has {}", what,
                                     beyond->first + 1, count));
    }

    /// Vertices are those of the file that the object uses, doubled where corners differ in their
    /// normal.
    TriangleMesh make_mesh(const Object& object, Vec3 origin) {
        TriangleMesh mesh;
        mesh.name = object.name;
        const bool has_normals = std::all_of(object.corners.begin(), object.corners.end(),
                                             [](const Corner& c) { return c.normal != kNone; });
        std::unordered_map<std::uint64_t, std::uint32_t> vertices;
        std::vector<Vec3> positions;  // of the vertices, as the file has them
        std::vector<std::uint32_t> indices;
        indices.reserve(object.corners.size());
        for (const Corner& corner : object.corners) {
            const std::uint32_t normal = has_normals ? corner.normal : kNone;
            const std::uint64_t key = (std::uint64_t{normal} << 32) | corner.position;
            const auto [vertex, is_new] =
                vertices.try_emplace(key, static_cast<std::uint32_t>(positions.size()));
            if (is_new) {
                positions.push_back(positions_[corner.position]);
                if (has_normals) mesh.normals.push_back(normals_[normal]);
            }
            indices.push_back(vertex->second);
        }
        mesh.triangles.reserve(object.triangles);
        std::size_t begin = 0;
        for (const std::size_t end : object.ends) {
            if (!cut_polygon(std::span(indices).subspan(begin, end - begin), positions,
                             mesh.triangles))
                ++rough_polygons_;
            begin = end;
        }
        for (const Vec3 p : positions) mesh.positions.push_back(relative_to(origin, p));
        return mesh;
    }

    [[noreturn]] void fail(std::string why) const {
        fail_at_line(source_.path, line_, std::move(why));
    }

    ModelSource& source_;
    std::string text_;
    std::uint64_t line_ = 0;
    std::vector<Vec3> positions_;
    std::vector<Vec3f> normals_;
    std::size_t textures_ = 0;
    std::vector<Object> objects_;
    std::uint64_t triangles_ = 0, rough_polygons_ = 0;
    LargestIndex used_positions_, used_normals_, used_textures_;
    std::set<std::string> unknown_;
};

Model read_obj(ModelSource& source) {
    return ObjReader(source, read_text_file(source.path, source.limits.file_bytes)).read();
}

/// A text whose first statement is one of OBJ.
bool is_obj(const FileStart& start) {
    std::string_view text = start.bytes;
    if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
    if (!is_text(text)) return false;
    constexpr std::array kFirst = {"v", "vn", "vt", "f", "o", "g", "s", "mtllib", "usemtl"};
    Words lines(text, 1, end_of_line(text));
    while (lines.left() > 0) {
        Words words(lines.rest_of_line());
        const std::string_view what = words.next();
        if (what.empty() || what.starts_with('#')) continue;
        return !words.next().empty() &&
               std::find(kFirst.begin(), kFirst.end(), what) != kFirst.end();
    }
    return false;
}

}  // namespace

ModelFormat obj_format() {
    return {"Wavefront OBJ", {".obj"}, is_obj, read_obj};
}

}  // namespace asperity::io::detail
