// SPDX-License-Identifier: Apache-2.0
#include <asperity/formats/models/model_reader.h>

#include <asperity/core/error.h>
#include <asperity/core/parse_number.h>
#include <asperity/formats/models/model_formats.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <new>
#include <string_view>
#include <utility>

namespace asperity::io {
namespace {

// Single precision, and the squares of it that tracing takes, must hold both.
constexpr double kFarthest = 1e15, kSmallest = 1e-15;

struct Format {
    std::string_view ending;
    Model (*read)(detail::ModelSource&);
};

constexpr std::array<Format, 6> kFormats = {{{".obj", detail::read_obj},
                                             {".ply", detail::read_ply},
                                             {".stl", detail::read_stl},
                                             {".gltf", detail::read_gltf},
                                             {".glb", detail::read_gltf},
                                             {".3ds", detail::read_3ds}}};

const Format* format_of(const std::string& path) {
    std::string ending = std::filesystem::path(path).extension().string();
    std::transform(ending.begin(), ending.end(), ending.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    const auto* const found = std::find_if(kFormats.begin(), kFormats.end(),
                                           [&](const Format& f) { return f.ending == ending; });
    return found == kFormats.end() ? nullptr : found;
}

bool is_finite(Vec3 v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

/// Whether rays can be taken into the instance's own space.
bool has_volume(const Transform& t) {
    const double volume = dot(cross(t.x, t.y), t.z);
    const double sides = length(t.x) * length(t.y) * length(t.z);
    return is_finite(t.origin) && std::isfinite(sides) && std::abs(volume) > 1e-12 * sides;
}

/// Takes out triangles and instances that cannot be drawn, and meshes that nothing is left of.
void clean(ModelFile& file) {
    Model& model = file.model;
    std::vector<std::uint32_t> place(model.meshes.size());
    std::vector<TriangleMesh> kept;
    for (std::size_t m = 0; m < model.meshes.size(); ++m) {
        file.dropped_triangles += drop_undrawable(model.meshes[m]);
        place[m] = static_cast<std::uint32_t>(kept.size());
        if (!model.meshes[m].triangles.empty()) kept.push_back(std::move(model.meshes[m]));
    }
    std::vector<Instance> instances;
    for (Instance& instance : model.instances) {
        const std::uint32_t here = place[instance.mesh];
        const bool has_mesh = instance.mesh + 1 < place.size() ? here != place[instance.mesh + 1]
                                                               : here != kept.size();
        if (!has_mesh) continue;
        instance.mesh = here;
        if (has_volume(instance.to_world))
            instances.push_back(instance);
        else
            file.dropped_triangles += kept[here].triangles.size();
    }
    model.meshes = std::move(kept);
    model.instances = std::move(instances);
}

/// Throws unless the model is neither too large nor too small to be traced.
void check_extent(const Model& model, const std::string& path) {
    const Bounds box = bounds(model);
    const Vec3 size = box.high - box.low;
    const double farthest =
        std::max({std::abs(box.low.x), std::abs(box.low.y), std::abs(box.low.z),
                  std::abs(box.high.x), std::abs(box.high.y), std::abs(box.high.z)});
    if (farthest > kFarthest || length(size) < kSmallest)
        throw Error(ErrorCode::InvalidInput,
                    fmt::format("its coordinates reach {:.3g} and it is {:.3g} across; {:.0e} and "
                                "{:.0e} are the limits",
                                farthest, length(size), kFarthest, kSmallest),
                    path);
}

ModelFile read_checked(const Format& format, const std::string& path,
                       const ModelReadSettings& settings) {
    detail::ModelSource source{path, settings.limits, {}};
    ModelFile file;
    file.model = format.read(source);
    file.remarks = std::move(source.remarks);
    detail::check_limits(file.model, source);
    clean(file);
    if (file.model.instances.empty())
        throw Error(ErrorCode::InvalidInput, "there is no triangle to be drawn in it", path);
    file.model.name = std::filesystem::path(path).filename().string();
    for (TriangleMesh& mesh : file.model.meshes)
        set_normals(mesh, settings.normals, settings.crease_deg);
    check(file.model);
    check_extent(file.model, path);
    if (settings.fit) fit_to_unit_sphere(file.model);
    return file;
}

}  // namespace

bool is_model_file(const std::string& path) {
    return format_of(path) != nullptr;
}

ModelFile read_model(const std::string& path, const ModelReadSettings& settings) {
    const Format* const format = format_of(path);
    if (format == nullptr)
        throw Error(ErrorCode::Usage,
                    fmt::format("{} is no model file: .obj, .ply, .stl, .gltf, .glb and .3ds are "
                                "read",
                                in_quotes(path)),
                    "model");
    try {
        return read_checked(*format, path, settings);
    } catch (const std::bad_alloc&) {
        throw Error(ErrorCode::OutOfMemory, "there is not enough memory to read it", path);
    } catch (const std::length_error&) {
        throw Error(ErrorCode::OutOfMemory, "there is not enough memory to read it", path);
    }
}

}  // namespace asperity::io
