// SPDX-License-Identifier: Apache-2.0
#include <asperity/formats/models/model_reader.h>

#include <asperity/core/error.h>
#include <asperity/core/finite.h>
#include <asperity/core/parse_number.h>
#include <asperity/formats/models/far_coordinates.h>
#include <asperity/formats/models/model_formats.h>
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <new>
#include <span>
#include <stdexcept>
#include <system_error>
#include <utility>
#include <vector>

namespace asperity::io {
namespace {

// Single precision, and the squares of it that tracing takes, must hold both.
constexpr double kFarthest = 1e15, kSmallest = 1e-15;

using Formats = std::span<const ModelFormat>;

const ModelFormat* by_ending(Formats formats, const std::string& path) {
    std::string ending = std::filesystem::path(path).extension().string();
    std::transform(ending.begin(), ending.end(), ending.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    for (const ModelFormat& format : formats) {
        if (std::find(format.endings.begin(), format.endings.end(), ending) != format.endings.end())
            return &format;
    }
    return nullptr;
}

const ModelFormat* by_content(Formats formats, const FileStart& start) {
    const auto found = std::find_if(formats.begin(), formats.end(),
                                    [&](const ModelFormat& f) { return f.sniff(start); });
    return found == formats.end() ? nullptr : &*found;
}

std::string names_of(Formats formats) {
    std::string names;
    for (const ModelFormat& format : formats)
        names += fmt::format("{}{} ({})", names.empty() ? "" : ", ", format.name,
                             fmt::join(format.endings, ", "));
    return names;
}

/// The format of the file: content decides, then the ending.
const ModelFormat& format_of(Formats formats, ModelSource& source) {
    const ModelFormat* const named = by_ending(formats, source.path);
    const ModelFormat* const found = by_content(formats, read_start(source.path));
    if (found != nullptr && named != nullptr && found != named)
        source.remarks.push_back(fmt::format("it is {}, whatever its ending says", found->name));
    if (found != nullptr) return *found;
    if (named != nullptr) return *named;
    throw Error(
        ErrorCode::Usage,
        fmt::format("{} is no model file: {} are read", in_quotes(source.path), names_of(formats)),
        "model");
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

/// What remains far from the origin is traced in single precision there.
void remark_on_place(ModelFile& file) {
    const Bounds box = bounds(file.model);
    detail::Extent extent;
    extent.add(box.low);
    extent.add(box.high);
    constexpr double kFar = 1000;
    if (extent.farthest() > kFar * extent.across())
        file.remarks.push_back(fmt::format(
            "it stands {:.3g} from the origin and is {:.3g} across: tracing there loses "
            "precision, unless it is fitted",
            extent.farthest(), extent.across()));
}

ModelFile read_checked(const std::string& path, const ModelReadSettings& settings) {
    std::vector<ModelFormat> formats = settings.formats;
    formats.insert(formats.end(), model_formats().begin(), model_formats().end());
    ModelSource source{path, settings.limits, {}};
    ModelFile file;
    file.model = format_of(formats, source).read(source);
    detail::check_limits(file.model, source);
    detail::recentre(file.model, source.remarks);
    file.remarks = std::move(source.remarks);
    clean(file);
    if (file.model.instances.empty())
        throw Error(ErrorCode::InvalidInput, "there is no triangle to be drawn in it", path);
    file.model.name = std::filesystem::path(path).filename().string();
    for (TriangleMesh& mesh : file.model.meshes)
        set_normals(mesh, settings.normals, settings.crease_deg);
    check(file.model);
    check_extent(file.model, path);
    if (settings.fit)
        fit_to_unit_sphere(file.model);
    else
        remark_on_place(file);
    return file;
}

}  // namespace

std::span<const ModelFormat> model_formats() {
    static const std::vector<ModelFormat> kFormats = {
        detail::gltf_format(), detail::ply_format(), detail::stl_format(), detail::threeds_format(),
        detail::obj_format()};
    return kFormats;
}

bool is_model_file(const std::string& path) {
    if (by_ending(model_formats(), path) != nullptr) return true;
    std::error_code error;
    return std::filesystem::is_regular_file(path, error) &&
           by_content(model_formats(), read_start(path)) != nullptr;
}

ModelFile read_model(const std::string& path, const ModelReadSettings& settings) {
    try {
        return read_checked(path, settings);
    } catch (const std::bad_alloc&) {
        throw Error(ErrorCode::OutOfMemory, "there is not enough memory to read it", path);
    } catch (const std::length_error&) {
        throw Error(ErrorCode::OutOfMemory, "there is not enough memory to read it", path);
    }
}

}  // namespace asperity::io
