// SPDX-License-Identifier: Apache-2.0
// 3D Studio .3ds: chunks within chunks, each an id (2 bytes), its length with these six (4 bytes)
// and its content. The walk writes a copy that holds the triangles of the file and nothing else,
// every index and length in it checked; assimp reads the copy.
#include <asperity/core/error.h>
#include <asperity/formats/models/assimp_import.h>
#include <asperity/formats/models/model_formats.h>
#include <asperity/formats/read_file.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
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
constexpr float kFarthest = 1e15f;  // as read_model

template <typename Number>
void append(std::string& bytes, Number value) {
    std::array<char, sizeof value> raw;
    std::memcpy(raw.data(), &value, sizeof value);
    bytes.append(raw.data(), raw.size());
}

std::string chunk(std::uint16_t id, const std::string& content) {
    std::string bytes;
    append(bytes, id);
    append(bytes, static_cast<std::uint32_t>(kHead + content.size()));
    return bytes + content;
}

/// A stretch of the file.
struct Span {
    std::size_t begin = 0, end = 0;
    std::size_t size() const { return end - begin; }
};

class Walk {
  public:
    Walk(const ModelSource& source, std::string_view file) : source_(source), file_(file) {}

    std::string clean_copy() {
        if (file_.size() < kHead || number<std::uint16_t>({0, file_.size()}, 0) != kMain)
            fail(0, "not a 3DS file (wrong first chunk)");
        std::string objects;
        for_each_chunk({0, file_.size()}, [&](std::uint16_t main_id, Span main) {
            if (main_id != kMain) return;
            for_each_chunk(main, [&](std::uint16_t id, Span editor) {
                if (id == kEditor) objects += read_editor(editor);
            });
        });
        return chunk(kMain, chunk(kEditor, objects));
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

    std::string read_editor(Span editor) {
        std::string objects;
        for_each_chunk(editor, [&](std::uint16_t id, Span object) {
            if (id == kObject) objects += read_object(object);
        });
        return objects;
    }

    std::string read_object(Span object) {
        const std::size_t end = file_.find('\0', object.begin);
        if (end >= object.end) fail(object.begin, "the name of an object does not end");
        if (end - object.begin > kLongestName) fail(object.begin, "the name is too long");
        const std::string name(file_.substr(object.begin, end + 1 - object.begin));
        std::string copy;
        for_each_chunk({end + 1, object.end}, [&](std::uint16_t id, Span triangles) {
            const std::string content = id == kTriangles ? read_triangles(triangles) : "";
            if (!content.empty()) copy += chunk(kObject, name + chunk(kTriangles, content));
        });
        return copy;
    }

    std::string read_triangles(Span triangles) {
        Span vertices, faces;
        for_each_chunk(triangles, [&](std::uint16_t id, Span content) {
            if (id == kVertices) vertices = content;
            if (id == kFaces) faces = content;
        });
        if (vertices.size() == 0 || faces.size() == 0) return {};
        const std::size_t count = counted(vertices, kVertex);
        std::vector<bool> finite;
        const std::string vertex_copy = copy_vertices(vertices, count, finite);
        return chunk(kVertices, vertex_copy) + chunk(kFaces, copy_faces(faces, finite));
    }

    /// Vertices that are not finite become the origin: assimp sorts vertices by place.
    std::string copy_vertices(Span span, std::size_t count, std::vector<bool>& finite) const {
        std::string copy;
        append(copy, static_cast<std::uint16_t>(count));
        for (std::size_t v = 0; v < count; ++v) {
            const std::size_t place = 2 + v * kVertex;
            Vec3f p{number<float>(span, place), number<float>(span, place + 4),
                    number<float>(span, place + 8)};
            finite.push_back(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z));
            if (!finite.back()) p = {};
            const float farthest = std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
            if (farthest > kFarthest)
                fail(span.begin + place, fmt::format("a coordinate of {:.3g}, {:.0e} is the limit",
                                                     farthest, kFarthest));
            append(copy, p);
        }
        return copy;
    }

    std::string copy_faces(Span span, const std::vector<bool>& finite) {
        const std::size_t count = counted(span, kFace);
        triangles_ += count;
        if (triangles_ > source_.limits.triangles)
            fail(span.begin, fmt::format("more than {} triangles", source_.limits.triangles));
        std::string copy;
        append(copy, static_cast<std::uint16_t>(count));
        for (std::size_t f = 0; f < count; ++f) {
            const std::size_t place = 2 + f * kFace;
            std::array<std::uint16_t, 4> face{};
            bool drawable = true;
            for (std::size_t k = 0; k < 3; ++k) {
                face[k] = number<std::uint16_t>(span, place + 2 * k);
                if (face[k] >= finite.size())
                    fail(span.begin + place + 2 * k,
                         fmt::format("a face refers to vertex {}, the object has {}", face[k],
                                     finite.size()));
                drawable = drawable && finite[face[k]];
            }
            // One without area is found and counted later.
            append(copy, drawable ? face : std::array<std::uint16_t, 4>{});
        }
        return copy + copy_smoothing({span.begin + 2 + count * kFace, span.end}, count);
    }

    std::string copy_smoothing(Span rest, std::size_t faces) const {
        std::string copy;
        for_each_chunk(rest, [&](std::uint16_t id, Span groups) {
            if (id != kSmoothing || !copy.empty()) return;
            if (groups.size() < faces * kGroups)
                fail(groups.begin, fmt::format("smoothing groups in {} bytes for {} faces",
                                               groups.size(), faces));
            copy = chunk(kSmoothing, std::string(file_.substr(groups.begin, faces * kGroups)));
        });
        return copy;
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
    std::uint64_t triangles_ = 0;
};

}  // namespace

Model read_3ds(ModelSource& source) {
    const std::string file = read_text_file(source.path, source.limits.file_bytes);
    const std::string copy = Walk(source, file).clean_copy();
    constexpr std::size_t kEmpty = 2 * kHead;
    if (copy.size() == kEmpty)
        throw Error(ErrorCode::InvalidInput, "there is no triangle in it", source.path);
    Model model = import_with_assimp({{"model.3ds", copy}}, source.path);
    // assimp gives every corner a vertex of its own.
    for (TriangleMesh& mesh : model.meshes) join_equal_vertices(mesh);
    return model;
}

}  // namespace asperity::io::detail
