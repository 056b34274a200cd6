// SPDX-License-Identifier: Apache-2.0
// STL, as text or binary. Corners at one place are made one vertex; the normals of the file say no
// more than its facets and are left out.
#include <asperity/core/parse_number.h>
#include <asperity/formats/models/model_formats.h>
#include <asperity/formats/models/model_text.h>
#include <asperity/formats/read_file.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <utility>

namespace asperity::io::detail {
namespace {

constexpr std::size_t kHeader = 80, kCount = 4;  // bytes before the triangles of a binary file
constexpr std::size_t kNormal = 12, kFacet = 50;

/// "solid", then facets of three vertices each, then "endsolid"; any number of times.
class StlTextReader {
  public:
    StlTextReader(const ModelSource& source, std::string_view file)
        : source_(source), words_(file) {}

    Model read() {
        Model model;
        for (std::string_view word = words_.next(); !word.empty(); word = words_.next()) {
            if (word != "solid") fail(word, "solid");
            TriangleMesh mesh;
            mesh.name = std::string(trimmed(words_.rest_of_line()));
            read_facets(mesh);
            join_equal_vertices(mesh);
            if (!mesh.triangles.empty()) add_mesh(model, std::move(mesh));
            check_limits(model, source_);
        }
        return model;
    }

  private:
    void read_facets(TriangleMesh& mesh) {
        for (std::string_view word = words_.next(); word != "endsolid"; word = words_.next()) {
            if (word != "facet") fail(word, "facet");
            expect("normal");
            read_triple();
            expect("outer");
            expect("loop");
            const auto first = static_cast<std::uint32_t>(mesh.positions.size());
            for (int k = 0; k < 3; ++k) {
                expect("vertex");
                mesh.positions.push_back(read_triple());
            }
            expect("endloop");
            expect("endfacet");
            mesh.triangles.push_back({first, first + 1, first + 2});
            if (mesh.triangles.size() > source_.limits.triangles)
                fail_at_line(source_.path, words_.line(),
                             fmt::format("more than {} triangles", source_.limits.triangles));
        }
        words_.rest_of_line();  // its name
    }

    void expect(std::string_view wanted) {
        const std::string_view word = words_.next();
        if (word != wanted) fail(word, wanted);
    }

    Vec3f read_triple() {
        std::array<float, 3> xyz{};
        for (float& value : xyz) {
            const std::string_view word = words_.next();
            const auto number = parse_coordinate(word);
            if (!number) fail(word, "a number");
            value = static_cast<float>(*number);
        }
        return {xyz[0], xyz[1], xyz[2]};
    }

    [[noreturn]] void fail(std::string_view found, std::string_view wanted) const {
        fail_at_line(source_.path, words_.line(),
                     found.empty()
                         ? fmt::format("the file ends where {} should follow", wanted)
                         : fmt::format("{} where {} should be", in_quotes(found), wanted));
    }

    const ModelSource& source_;
    Words words_;
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

/// Many binary files start with "solid", too: their size tells.
bool is_binary(std::string_view file) {
    if (file.size() >= kHeader + kCount) {
        const std::uint64_t count = number_at<std::uint32_t>(file, kHeader);
        if (file.size() == kHeader + kCount + count * kFacet) return true;
    }
    return !trimmed(file.substr(0, kHeader)).starts_with("solid");
}

}  // namespace

Model read_stl(ModelSource& source) {
    const std::string file = read_text_file(source.path, source.limits.file_bytes);
    return is_binary(file) ? read_binary(source, file) : StlTextReader(source, file).read();
}

}  // namespace asperity::io::detail
