// SPDX-License-Identifier: Apache-2.0
#include "embree_scene.h"

#include "clocks.h"

#include <algorithm>
#include <stdexcept>

namespace asperity::bench {

namespace {

constexpr int kMargin = 64;  // cells; keeps ways through the side rare

/// Embree counts what it takes and gives back.
bool count_bytes(void* total, ssize_t bytes, bool) {
    static_cast<std::atomic<std::ptrdiff_t>*>(total)->fetch_add(bytes);
    return true;
}

}  // namespace

EmbreeScene::EmbreeScene(const Heightfield& surface, EmbreeGeometry geometry)
    : tile_x(static_cast<float>(surface.nx * surface.dx)),
      tile_y(static_cast<float>(surface.ny * surface.dy)),
      margin_cells_(std::min({kMargin, surface.nx, surface.ny})),
      surface_(surface),
      device_(rtcNewDevice(nullptr)) {
    if (device_ == nullptr) throw std::runtime_error("Embree gives no device");
    rtcSetDeviceMemoryMonitorFunction(device_, count_bytes, &bytes_);
    margin_x = static_cast<float>(margin_cells_ * surface.dx);
    margin_y = static_cast<float>(margin_cells_ * surface.dy);
    top = *std::max_element(surface.heights.begin(), surface.heights.end());
    const double begin = wall_seconds();
    scene_ = rtcNewScene(device_);
    rtcSetSceneBuildQuality(scene_, RTC_BUILD_QUALITY_HIGH);
    const RTCGeometry mesh = geometry == EmbreeGeometry::Grid ? new_grid() : new_triangles();
    rtcCommitGeometry(mesh);
    rtcAttachGeometry(scene_, mesh);
    rtcReleaseGeometry(mesh);
    rtcCommitScene(scene_);
    build_seconds = wall_seconds() - begin;
    if (rtcGetDeviceError(device_) != RTC_ERROR_NONE) {
        throw std::runtime_error("Embree could not build the scene");
    }
}

EmbreeScene::~EmbreeScene() {
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
}

void EmbreeScene::add_vertices(RTCGeometry mesh) const {
    auto* vertex = static_cast<float*>(rtcSetNewGeometryBuffer(mesh, RTC_BUFFER_TYPE_VERTEX, 0,
                                                               RTC_FORMAT_FLOAT3, 3 * sizeof(float),
                                                               std::size_t{columns()} * rows()));
    for (unsigned row = 0; row < rows(); ++row) {
        const int j = static_cast<int>(row) - margin_cells_;
        for (unsigned column = 0; column < columns(); ++column) {
            const int i = static_cast<int>(column) - margin_cells_;
            *vertex++ = static_cast<float>(i * surface_.dx);
            *vertex++ = static_cast<float>(j * surface_.dy);
            *vertex++ =
                surface_.at((i + surface_.nx) % surface_.nx, (j + surface_.ny) % surface_.ny);
        }
    }
}

RTCGeometry EmbreeScene::new_triangles() const {
    const RTCGeometry mesh = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    add_vertices(mesh);
    const std::size_t cells = std::size_t{columns() - 1} * (rows() - 1);
    auto* index = static_cast<unsigned*>(rtcSetNewGeometryBuffer(
        mesh, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(unsigned), 2 * cells));
    for (unsigned row = 0; row + 1 < rows(); ++row) {
        for (unsigned column = 0; column + 1 < columns(); ++column) {
            const unsigned a = row * columns() + column, b = a + 1;
            const unsigned c = a + columns(), d = c + 1;
            for (const unsigned corner : {a, b, c, b, d, c}) *index++ = corner;
        }
    }
    return mesh;
}

RTCGeometry EmbreeScene::new_grid() const {
    const RTCGeometry mesh = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_GRID);
    add_vertices(mesh);
    auto* grid = static_cast<RTCGrid*>(rtcSetNewGeometryBuffer(
        mesh, RTC_BUFFER_TYPE_GRID, 0, RTC_FORMAT_GRID, sizeof(RTCGrid), 1));
    *grid = {0, columns(), static_cast<unsigned short>(columns()),
             static_cast<unsigned short>(rows())};
    return mesh;
}

}  // namespace asperity::bench
