// SPDX-License-Identifier: Apache-2.0
// 3D Studio .3ds: chunks within chunks, each an id (2 bytes), its length with these six (4 bytes)
// and its content. Meshes are read, with their smoothing groups; z is up in them.
#include <asperity/formats/models/model_formats.h>
#include <asperity/formats/models/model_text.h>
#include <asperity/formats/models/smoothing_groups.h>
#include <asperity/formats/read_file.h>
#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <cstring>
#include <string_view>
#include <utility>
#include <vector>

namespace asperity::io::detail {
namespace {

enum ChunkId : std::uint16_t {
    kMain = 0x4d4d,
    kEditor = 0x3d3d,
    kObject = 0x4000,
    kTriangles = 0x4100,
    kVertices = 0x4110,
    kFaces = 0x4120,
    kSmoothing = 0x4150,
};

constexpr std::size_t kHead = 6;     // bytes of id and length
constexpr std::size_t kVertex = 12;  // three floats
constexpr std::size_t kFace = 8;     // three vertices and flags
constexpr std::size_t kGroups = 4;   // smoothing groups of a face, a bit each
constexpr std::size_t kLongestName = 64;

/// A stretch of the file.
struct Span {
    std::size_t begin = 0, end = 0;
    std::size_t size() const { return end - begin; }
};

class ThreedsReader {
  public:
    ThreedsReader(const ModelSource& source, std::string_view file)
        : source_(source), file_(file) {}

    Model read() {
        for_each_chunk({0, file_.size()}, [&](std::uint16_t main_id, Span main) {
            if (main_id != kMain) return;
            for_each_chunk(main, [&](std::uint16_t id, Span editor) {
                if (id == kEditor) read_editor(editor);
            });
        });
        return std::move(model_);
    }

  private:
    template <typename Visit>
    void for_each_chunk(Span span, Visit visit) const {
        while (span.size() > 0) {
            if (span.size() < kHead) fail(span.begin, "the file ends inside a chunk");
            const auto id = number<std::uint16_t>(span, 0);
            const auto length = number<std::uint32_t>(span, 2);
            if (length < kHead || length > span.size())
                fail(span.begin, fmt::format("chunk {:04x} claims {} bytes, {} are left", id,
                                             length, span.size()));
            visit(id, Span{span.begin + kHead, span.begin + length});
            span.begin += length;
        }
    }

    void read_editor(Span editor) {
        for_each_chunk(editor, [&](std::uint16_t id, Span object) {
            if (id == kObject) read_object(object);
        });
    }

    void read_object(Span object) {
        const std::size_t end = file_.substr(0, object.end).find('\0', object.begin);
        if (end >= object.end) fail(object.begin, "the name of an object does not end");
        if (end - object.begin > kLongestName) fail(object.begin, "the name is too long");
        const std::string name(file_.substr(object.begin, end - object.begin));
        for_each_chunk({end + 1, object.end}, [&](std::uint16_t id, Span triangles) {
            if (id == kTriangles) read_triangles(triangles, name);
        });
    }

    void read_triangles(Span triangles, const std::string& name) {
        Span vertices, faces;
        for_each_chunk(triangles, [&](std::uint16_t id, Span content) {
            if (id == kVertices) vertices = content;
            if (id == kFaces) faces = content;
        });
        if (vertices.size() == 0 || faces.size() == 0) return;
        TriangleMesh mesh;
        mesh.name = name;
        read_vertices(vertices, mesh);
        read_faces(faces, mesh);
        if (mesh.triangles.empty()) return;
        add_mesh(model_, std::move(mesh));
        check_limits(model_, source_);
    }

    void read_vertices(Span span, TriangleMesh& mesh) const {
        const std::size_t count = counted(span, kVertex);
        for (std::size_t v = 0; v < count; ++v) {
            const std::size_t place = 2 + v * kVertex;
            const Vec3f p{number<float>(span, place), number<float>(span, place + 4),
                          number<float>(span, place + 8)};
            mesh.positions.push_back({p.x, p.z, -p.y});  // z up becomes y up
        }
    }

    void read_faces(Span span, TriangleMesh& mesh) const {
        const std::size_t count = counted(span, kFace), vertices = mesh.positions.size();
        for (std::size_t f = 0; f < count; ++f) {
            const std::size_t place = 2 + f * kFace;
            std::array<std::uint32_t, 3> face{};
            for (std::size_t k = 0; k < 3; ++k) {
                face[k] = number<std::uint16_t>(span, place + 2 * k);
                if (face[k] >= vertices)
                    fail(span.begin + place + 2 * k,
                         fmt::format("a face refers to vertex {}, the object has {}", face[k],
                                     vertices));
            }
            mesh.triangles.push_back(face);
        }
        join_equal_vertices(mesh);
        const auto groups = smoothing_groups({span.begin + 2 + count * kFace, span.end}, count);
        if (!groups.empty()) apply_smoothing_groups(mesh, groups);
    }

    /// One set of groups a face, a bit each; empty when the object has none.
    std::vector<std::uint32_t> smoothing_groups(Span rest, std::size_t faces) const {
        std::vector<std::uint32_t> groups;
        for_each_chunk(rest, [&](std::uint16_t id, Span content) {
            if (id != kSmoothing || !groups.empty()) return;
            if (content.size() < faces * kGroups)
                fail(content.begin, fmt::format("smoothing groups in {} bytes for {} faces",
                                                content.size(), faces));
            for (std::size_t f = 0; f < faces; ++f)
                groups.push_back(number<std::uint32_t>(content, f * kGroups));
        });
        return groups;
    }

    /// The count a list starts with, when its span holds as many.
    std::size_t counted(Span span, std::size_t each) const {
        const std::size_t count = number<std::uint16_t>(span, 0);
        if (count * each > span.size() - 2)
            fail(span.begin, fmt::format("{} entries in {} bytes", count, span.size() - 2));
        return count;
    }

    template <typename Number>
    Number number(Span span, std::size_t place) const {
        if (span.size() < place + sizeof(Number)) fail(span.begin, "the file ends inside a chunk");
        Number value;
        std::memcpy(&value, file_.data() + span.begin + place, sizeof value);
        return value;
    }

    [[noreturn]] void fail(std::size_t byte, std::string why) const {
        fail_at_byte(source_.path, byte, std::move(why));
    }

    const ModelSource& source_;
    std::string_view file_;
    Model model_;
};

bool is_3ds(const FileStart& start) {
    return start.bytes.size() >= kHead && start.bytes.starts_with("MM") &&
           !is_text(start.bytes.substr(0, kHead));
}

Model read_3ds(ModelSource& source) {
    const std::string file = read_text_file(source.path, source.limits.file_bytes);
    if (!is_3ds({file.substr(0, kHead), file.size()}))
        fail_at_byte(source.path, 0, "not a 3DS file (wrong first chunk)");
    return ThreedsReader(source, file).read();
}

}  // namespace

ModelFormat threeds_format() {
    return {"3D Studio", {".3ds"}, is_3ds, read_3ds};
}

}  // namespace asperity::io::detail
