// SPDX-License-Identifier: Apache-2.0
// STL, as text or binary. Corners at one place are made one vertex; the normals of the file say no
// more than its facets and are left out.
#include <asperity/core/parse_number.h>
#include <asperity/formats/models/far_coordinates.h>
#include <asperity/formats/models/model_formats.h>
#include <asperity/formats/models/model_text.h>
#include <asperity/formats/read_file.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

namespace asperity::io::detail {
namespace {

constexpr std::size_t kHeader = 80, kCount = 4;  // bytes before the triangles of a binary file
constexpr std::size_t kStart = 4096;             // bytes that tell text from binary
constexpr std::size_t kNormal = 12, kFacet = 50;

/// "solid", then facets of three vertices each, then "endsolid"; any number of times, in small
/// letters or capitals.
class StlTextReader {
  public:
    StlTextReader(ModelSource& source, std::string_view file)
        : source_(source), words_(file, 1, end_of_line(file)) {}

    Model read() {
        for (std::string_view word = words_.next(); !word.empty(); word = words_.next()) {
            if (!same_word(word, "solid")) fail(word, "solid");
            solids_.push_back({std::string(trimmed(words_.rest_of_line())), {}});
            read_facets(solids_.back().corners);
            if (solids_.back().corners.empty()) solids_.pop_back();
            if (solids_.size() > source_.limits.meshes)
                fail_at_line(source_.path, words_.line(),
                             fmt::format("more than {} meshes", source_.limits.meshes));
        }
        return make_model();
    }

  private:
    struct Solid {
        std::string name;
        std::vector<Vec3> corners;  ///< three a facet
    };

    void read_facets(std::vector<Vec3>& corners) {
        for (std::string_view word = words_.next(); !same_word(word, "endsolid");
             word = words_.next()) {
            if (!same_word(word, "facet")) fail(word, "facet");
            expect("normal");
            read_triple();
            expect("outer");
            expect("loop");
            for (int k = 0; k < 3; ++k) {
                expect("vertex");
                corners.push_back(read_triple());
                extent_.add(corners.back());
            }
            expect("endloop");
            expect("endfacet");
            if (++triangles_ > source_.limits.triangles)
                fail_at_line(source_.path, words_.line(),
                             fmt::format("more than {} triangles", source_.limits.triangles));
        }
        words_.rest_of_line();  // its name
    }

    Model make_model() {
        const Vec3 origin = extent_.origin();
        Model model;
        for (const Solid& solid : solids_) {
            TriangleMesh mesh;
            mesh.name = solid.name;
            for (const Vec3 p : solid.corners) mesh.positions.push_back(relative_to(origin, p));
            for (std::uint32_t v = 0; v < mesh.positions.size(); v += 3)
                mesh.triangles.push_back({v, v + 1, v + 2});
            join_equal_vertices(mesh);
            add_mesh(model, std::move(mesh), origin);
        }
        if (std::string far = remark_on(extent_); !far.empty())
            source_.remarks.push_back(std::move(far));
        return model;
    }

    void expect(std::string_view wanted) {
        const std::string_view word = words_.next();
        if (!same_word(word, wanted)) fail(word, wanted);
    }

    Vec3 read_triple() {
        std::array<double, 3> xyz{};
        for (double& value : xyz) {
            const std::string_view word = words_.next();
            const auto number = parse_coordinate(word);
            if (!number) fail(word, "a number");
            value = *number;
        }
        return {xyz[0], xyz[1], xyz[2]};
    }

    [[noreturn]] void fail(std::string_view found, std::string_view wanted) const {
        fail_at_line(source_.path, words_.line(),
                     found.empty()
                         ? fmt::format("the file ends where {} should follow", wanted)
                         : fmt::format("{} where {} should be", in_quotes(found), wanted));
    }

    ModelSource& source_;
    Words words_;
    std::vector<Solid> solids_;
    Extent extent_;
    std::uint64_t triangles_ = 0;
};

template <typename Number>
Number number_at(std::string_view file, std::size_t place) {
    Number value;
    std::memcpy(&value, file.data() + place, sizeof value);
    return value;
}

Model read_binary(const ModelSource& source, std::string_view file) {
    if (file.size() < kHeader + kCount)
        fail_at_byte(source.path, file.size(), "not an STL file: it is shorter than a header");
    const std::uint64_t count = number_at<std::uint32_t>(file, kHeader);
    const std::uint64_t held = (file.size() - kHeader - kCount) / kFacet;
    if (count > held)
        fail_at_byte(source.path, kHeader,
                     fmt::format("{} triangles are announced, the file holds {}", count, held));
    if (count > source.limits.triangles)
        fail_at_byte(source.path, kHeader,
                     fmt::format("more than {} triangles", source.limits.triangles));
    TriangleMesh mesh;
    mesh.positions.reserve(3 * count);
    mesh.triangles.reserve(count);
    for (std::uint64_t t = 0; t < count; ++t) {
        const std::size_t place = kHeader + kCount + t * kFacet + kNormal;
        const auto first = static_cast<std::uint32_t>(3 * t);
        for (std::size_t k = 0; k < 3; ++k)
            mesh.positions.push_back(number_at<Vec3f>(file, place + k * sizeof(Vec3f)));
        mesh.triangles.push_back({first, first + 1, first + 2});
    }
    join_equal_vertices(mesh);
    Model model;
    if (!mesh.triangles.empty()) add_mesh(model, std::move(mesh));
    return model;
}

/// Whether the size of the file is that of the triangles a binary one would announce.
bool has_binary_size(const FileStart& start) {
    if (start.bytes.size() < kHeader + kCount) return false;
    const std::uint64_t count = number_at<std::uint32_t>(start.bytes, kHeader);
    return start.size == kHeader + kCount + count * kFacet;
}

/// Many binary files start with "solid", too: their size tells, and zeros among their bytes.
bool is_text_stl(const FileStart& start) {
    std::string_view text = start.bytes;
    if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
    return !has_binary_size(start) && is_text(text) && same_word(Words(text).next(), "solid");
}

bool is_stl(const FileStart& start) {
    return has_binary_size(start) || is_text_stl(start);
}

Model read_stl(ModelSource& source) {
    const std::string file = read_text_file(source.path, source.limits.file_bytes);
    const FileStart start{file.substr(0, kStart), file.size()};
    if (!has_binary_size(start)) {
        const std::string_view text = without_byte_order_mark(file, source.path);
        if (is_text_stl(start)) return StlTextReader(source, text).read();
    }
    return read_binary(source, file);
}

}  // namespace

ModelFormat stl_format() {
    return {"STL", {".stl"}, is_stl, read_stl};
}

}  // namespace asperity::io::detail
