// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/surface/heightfield.h>

#include <embree3/rtcore.h>

#include <atomic>
#include <cstddef>

namespace asperity::bench {

enum class EmbreeGeometry { Triangles, Grid };

/// One tile of a surface as an Embree scene. Embree knows no periodic surface: the tile has a
/// margin of its neighbours around it.
class EmbreeScene {
  public:
    /// Throws std::runtime_error. Keeps a reference to `surface`.
    EmbreeScene(const Heightfield& surface, EmbreeGeometry geometry);
    ~EmbreeScene();
    EmbreeScene(const EmbreeScene&) = delete;
    EmbreeScene& operator=(const EmbreeScene&) = delete;

    RTCScene handle() const { return scene_; }
    std::size_t memory_bytes() const { return static_cast<std::size_t>(bytes_.load()); }
    bool has(RTCDeviceProperty property) const {
        return rtcGetDeviceProperty(device_, property) != 0;
    }

    float tile_x, tile_y, margin_x = 0, margin_y = 0;
    float top = 0;  ///< the highest point
    double build_seconds = 0;

  private:
    unsigned columns() const { return static_cast<unsigned>(surface_.nx + 2 * margin_cells_ + 1); }
    unsigned rows() const { return static_cast<unsigned>(surface_.ny + 2 * margin_cells_ + 1); }
    void add_vertices(RTCGeometry mesh) const;
    RTCGeometry new_triangles() const;
    RTCGeometry new_grid() const;

    int margin_cells_;
    const Heightfield& surface_;
    RTCDevice device_;
    RTCScene scene_ = nullptr;
    std::atomic<std::ptrdiff_t> bytes_{0};
};

}  // namespace asperity::bench
