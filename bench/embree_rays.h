// SPDX-License-Identifier: Apache-2.0
// Embree's ways to take a batch of rays: one by one, in packets, in streams. Each class keeps the
// rays in the layout its call wants, so that nothing is copied.
#pragma once

#include "rival.h"

#include <embree3/rtcore.h>

#include <array>
#include <limits>
#include <vector>

namespace asperity::bench {

inline constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// A path between two calls of Embree.
struct EmbreePath {
    float x, y, z, dx, dy, dz;
};
/// What Embree found for it.
struct EmbreeFound {
    bool hit;
    float t, nx, ny, nz;  ///< distance; normal, not unit length
};

/// A batch in structures of single rays: rtcIntersect1 for each, or rtcIntersect1M for all.
template <bool kStream>
class SingleRays {
  public:
    static constexpr const char* kName = kStream ? "1M" : "1";
    SingleRays() : rays_(kBatch) {}

    void put(std::size_t k, const EmbreePath& p) {
        RTCRay& r = rays_[k].ray;
        r.org_x = p.x, r.org_y = p.y, r.org_z = p.z;
        r.dir_x = p.dx, r.dir_y = p.dy, r.dir_z = p.dz;
    }
    EmbreePath get(std::size_t k) const {
        const RTCRay& r = rays_[k].ray;
        return {r.org_x, r.org_y, r.org_z, r.dir_x, r.dir_y, r.dir_z};
    }
    EmbreeFound found(std::size_t k) const {
        const RTCRayHit& r = rays_[k];
        return {r.hit.geomID != RTC_INVALID_GEOMETRY_ID, r.ray.tfar, r.hit.Ng_x, r.hit.Ng_y,
                r.hit.Ng_z};
    }
    void trace(RTCScene scene, RTCIntersectContext* context, std::size_t count) {
        for (std::size_t k = 0; k < count; ++k) {
            RTCRayHit& r = rays_[k];
            r.ray.tnear = 0, r.ray.time = 0, r.ray.tfar = kInfinity;
            r.ray.mask = ~0U, r.ray.flags = 0;
            r.hit.geomID = RTC_INVALID_GEOMETRY_ID, r.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
            if constexpr (!kStream) rtcIntersect1(scene, context, &r);
        }
        if constexpr (kStream) {
            rtcIntersect1M(scene, context, rays_.data(), static_cast<unsigned>(count),
                           sizeof(RTCRayHit));
        }
    }

  private:
    std::vector<RTCRayHit> rays_;
};

/// Embree's packet of kLanes rays, and the call that traces it.
template <int kLanes>
struct Packet;
template <>
struct Packet<4> {
    using Type = RTCRayHit4;
    static constexpr const char* kName = "4";
    static constexpr auto* kIntersect = &rtcIntersect4;
};
template <>
struct Packet<8> {
    using Type = RTCRayHit8;
    static constexpr const char* kName = "8";
    static constexpr auto* kIntersect = &rtcIntersect8;
};
template <>
struct Packet<16> {
    using Type = RTCRayHit16;
    static constexpr const char* kName = "16";
    static constexpr auto* kIntersect = &rtcIntersect16;
};

/// A batch in packets of kLanes rays: one call for each, or rtcIntersectNM for all.
template <int kLanes, bool kStream = false>
class PacketRays {
  public:
    static constexpr const char* kName = kStream ? "NM" : Packet<kLanes>::kName;
    PacketRays() : packets_(kBatch / kLanes) {}

    void put(std::size_t k, const EmbreePath& p) {
        auto& r = packets_[k / kLanes].ray;
        const std::size_t lane = k % kLanes;
        r.org_x[lane] = p.x, r.org_y[lane] = p.y, r.org_z[lane] = p.z;
        r.dir_x[lane] = p.dx, r.dir_y[lane] = p.dy, r.dir_z[lane] = p.dz;
    }
    EmbreePath get(std::size_t k) const {
        const auto& r = packets_[k / kLanes].ray;
        const std::size_t lane = k % kLanes;
        return {r.org_x[lane], r.org_y[lane], r.org_z[lane],
                r.dir_x[lane], r.dir_y[lane], r.dir_z[lane]};
    }
    EmbreeFound found(std::size_t k) const {
        const auto& p = packets_[k / kLanes];
        const std::size_t lane = k % kLanes;
        return {p.hit.geomID[lane] != RTC_INVALID_GEOMETRY_ID, p.ray.tfar[lane], p.hit.Ng_x[lane],
                p.hit.Ng_y[lane], p.hit.Ng_z[lane]};
    }
    void trace(RTCScene scene, RTCIntersectContext* context, std::size_t count) {
        for (std::size_t first = 0; first < count; first += kLanes) {
            auto& p = packets_[first / kLanes];
            alignas(64) int valid[kLanes];
            for (std::size_t lane = 0; lane < kLanes; ++lane) {
                const bool used = first + lane < count;
                valid[lane] = used ? -1 : 0;
                p.ray.tnear[lane] = 0, p.ray.time[lane] = 0;
                p.ray.tfar[lane] = used ? kInfinity : -kInfinity;  // below tnear: inactive
                p.ray.mask[lane] = ~0U, p.ray.flags[lane] = 0;
                p.hit.geomID[lane] = RTC_INVALID_GEOMETRY_ID;
                p.hit.instID[0][lane] = RTC_INVALID_GEOMETRY_ID;
            }
            if constexpr (!kStream) Packet<kLanes>::kIntersect(valid, scene, context, &p);
        }
        if constexpr (kStream) {
            using Type = typename Packet<kLanes>::Type;
            rtcIntersectNM(scene, context, reinterpret_cast<RTCRayHitN*>(packets_.data()), kLanes,
                           static_cast<unsigned>((count + kLanes - 1) / kLanes), sizeof(Type));
        }
    }

  private:
    std::vector<typename Packet<kLanes>::Type> packets_;
};

/// A batch in one array per component: rtcIntersectNp.
class ArrayRays {
  public:
    static constexpr const char* kName = "Np";

    void put(std::size_t k, const EmbreePath& p) {
        x_[k] = p.x, y_[k] = p.y, z_[k] = p.z;
        dx_[k] = p.dx, dy_[k] = p.dy, dz_[k] = p.dz;
    }
    EmbreePath get(std::size_t k) const { return {x_[k], y_[k], z_[k], dx_[k], dy_[k], dz_[k]}; }
    EmbreeFound found(std::size_t k) const {
        return {geometry_[k] != RTC_INVALID_GEOMETRY_ID, far_[k], nx_[k], ny_[k], nz_[k]};
    }
    void trace(RTCScene scene, RTCIntersectContext* context, std::size_t count) {
        for (std::size_t k = 0; k < count; ++k) {
            near_[k] = 0, time_[k] = 0, far_[k] = kInfinity, mask_[k] = ~0U, flags_[k] = 0;
            geometry_[k] = RTC_INVALID_GEOMETRY_ID, instance_[k] = RTC_INVALID_GEOMETRY_ID;
        }
        RTCRayHitNp rays{};
        rays.ray = {x_.data(),   y_.data(),    z_.data(),   near_.data(),
                    dx_.data(),  dy_.data(),   dz_.data(),  time_.data(),
                    far_.data(), mask_.data(), ids_.data(), flags_.data()};
        rays.hit = {nx_.data(), ny_.data(),        nz_.data(),       u_.data(),
                    v_.data(),  primitive_.data(), geometry_.data(), {instance_.data()}};
        rtcIntersectNp(scene, context, &rays, static_cast<unsigned>(count));
    }

  private:
    // Embree reads whole registers
    template <typename Value>
    struct alignas(64) Array : std::array<Value, kBatch> {};
    Array<float> x_{}, y_{}, z_{}, dx_{}, dy_{}, dz_{}, near_{}, far_{}, time_{};
    Array<float> nx_{}, ny_{}, nz_{}, u_{}, v_{};
    Array<unsigned> mask_{}, ids_{}, flags_{}, primitive_{}, geometry_{}, instance_{};
};

}  // namespace asperity::bench
