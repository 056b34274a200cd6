// SPDX-License-Identifier: Apache-2.0
#include <asperity/formats/models/far_coordinates.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace asperity::io::detail {
namespace {

constexpr double kFarthest = 1e15;  // as read_model
constexpr double kFar = 16;         // in sizes of the model: four bits of 24 are lost there
constexpr double kSinglePrecision = 0x1p-23;
constexpr double kCoarse = 1e-4;  // of the model's size, a tenth of a pixel

double largest(Vec3 v) {
    return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

template <typename Visit>
void for_each_corner(const Model& model, Visit visit) {
    for (const TriangleMesh& mesh : model.meshes) {
        for (const auto& triangle : mesh.triangles) {
            for (const std::uint32_t v : triangle) visit(to_double(mesh.positions[v]));
        }
    }
}

}  // namespace

void Extent::add(Vec3 p) {
    if (!(largest(p) <= kFarthest)) return;  // so that a NaN fails, too
    if (empty_) low_ = high_ = p;
    empty_ = false;
    low_ = {std::min(low_.x, p.x), std::min(low_.y, p.y), std::min(low_.z, p.z)};
    high_ = {std::max(high_.x, p.x), std::max(high_.y, p.y), std::max(high_.z, p.z)};
}

double Extent::farthest() const {
    return std::max(largest(low_), largest(high_));
}

double Extent::across() const {
    return largest(high_ - low_);
}

Vec3 Extent::origin() const {
    return farthest() > kFar * across() ? 0.5 * (low_ + high_) : Vec3{};
}

Vec3f relative_to(Vec3 origin, Vec3 point) {
    const Vec3 p = point - origin;
    return {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
}

void recentre(Model& model, std::vector<std::string>& remarks) {
    Extent extent;
    for_each_corner(model, [&](Vec3 p) { extent.add(p); });
    const Vec3 origin = extent.origin();
    if (origin == Vec3{}) return;
    for (TriangleMesh& mesh : model.meshes) {
        for (Vec3f& p : mesh.positions) p = relative_to(origin, to_double(p));
    }
    for (Instance& instance : model.instances)
        instance.to_world.origin = instance.to_world.point(origin);
    const double step = kSinglePrecision * extent.farthest();
    if (step > kCoarse * extent.across())
        remarks.push_back(fmt::format(
            "its coordinates reach {:.3g}, where the single precision of the file leaves steps of "
            "{:.2g} in a model {:.3g} across",
            extent.farthest(), step, extent.across()));
}

std::string remark_on(const Extent& extent) {
    if (extent.origin() == Vec3{}) return {};
    return fmt::format(
        "its coordinates reach {:.6g} and it is {:.3g} across: taken about its "
        "centre, so that no precision is lost",
        extent.farthest(), extent.across());
}

}  // namespace asperity::io::detail
