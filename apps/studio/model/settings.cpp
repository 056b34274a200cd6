// SPDX-License-Identifier: Apache-2.0
#include "settings.h"

#include <cmath>

namespace asperity::studio {

namespace {

constexpr std::size_t kNumbers = 10;

bool is_unit(Vec3 v) {
    constexpr double kNearly = 1e-3;
    return std::abs(length(v) - 1) < kNearly;
}

}  // namespace

KeptCamera kept(const Camera& camera) {
    KeptCamera numbers;
    for (const Vec3 v : {camera.position, camera.forward, camera.up})
        numbers.insert(numbers.end(), {v.x, v.y, v.z});
    numbers.push_back(camera.fov_deg);
    return numbers;
}

std::optional<Camera> camera_of(const KeptCamera& kept) {
    if (kept.size() != kNumbers) return std::nullopt;
    const auto vec = [&kept](std::size_t k) { return Vec3{kept[k], kept[k + 1], kept[k + 2]}; };
    const Camera camera{vec(0), vec(3), vec(6), kept[9]};
    const bool there = std::isfinite(length(camera.position)) && is_unit(camera.forward) &&
                       is_unit(camera.up) && std::abs(dot(camera.forward, camera.up)) < 1e-3 &&
                       camera.fov_deg >= 1 && camera.fov_deg <= 170;
    return there ? std::optional(camera) : std::nullopt;
}

}  // namespace asperity::studio
