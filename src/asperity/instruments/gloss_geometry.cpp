// SPDX-License-Identifier: Apache-2.0
#include <asperity/instruments/gloss_geometry.h>

#include <asperity/core/directions.h>
#include <asperity/core/error.h>
#include <asperity/optics/fresnel.h>
#include <fmt/format.h>

#include <cmath>

namespace asperity {

namespace {

/// Half the width of an aperture on a plane at distance 1.
double half_width(double full_angle_deg) {
    return std::tan(radians(0.5 * full_angle_deg));
}

constexpr Vec3 kAcross = {0, 1, 0};

}  // namespace

GlossGeometry standard_gloss_geometry(double angle_deg) {
    constexpr Aperture kSource = {0.75, 2.5};
    if (angle_deg == 20) return {20, kSource, {1.8, 3.6}, 1.9};
    if (angle_deg == 60) return {60, kSource, {4.4, 11.7}};
    if (angle_deg == 85) return {85, kSource, {4.0, 6.0}};
    throw Error(ErrorCode::Usage,
                fmt::format("{} degrees is none of the standards' 20, 60 and 85", angle_deg),
                "geometry");
}

GlossGeometry doi_geometry(const DoiSettings& settings) {
    constexpr double kAside = 0.3;
    const double widths = settings.source_deg + settings.receptor_deg;
    if (!(settings.source_deg > 0 && settings.receptor_deg > 0 && widths < 2 * kAside))
        throw Error(ErrorCode::Usage,
                    fmt::format("the widths of source and receptors must be positive and together "
                                "below {} degrees, or a perfect mirror would not have 100",
                                2 * kAside),
                    "doi");
    if (!(settings.angle_deg >= 5 && settings.angle_deg <= 80))
        throw Error(ErrorCode::Usage,
                    fmt::format("{} is not within 5 to 80 degrees", settings.angle_deg),
                    "doi-angle");
    return {settings.angle_deg, {settings.source_deg, 2.5}, {settings.receptor_deg, 5}, kAside};
}

GlossOptics::GlossOptics(const GlossGeometry& geometry)
    : geometry_(geometry), source_(axis_at(radians(geometry.angle_deg), 1)) {}

/// The axis leans to `side` of the normal, +x or -x; in_plane points away from the normal.
GlossOptics::Axis GlossOptics::axis_at(double angle, double side) {
    return {{side * std::sin(angle), 0, std::cos(angle)},
            {side * std::cos(angle), 0, -std::sin(angle)}};
}

Vec3 GlossOptics::source_direction(double u, double v) const {
    const double a = (2 * u - 1) * half_width(geometry_.source.in_plane),
                 b = (2 * v - 1) * half_width(geometry_.source.across);
    return normalize(source_.along + a * source_.in_plane + b * kAcross);
}

bool GlossOptics::receives(Vec3 wo, double off_deg) const {
    const Axis axis = axis_at(radians(geometry_.angle_deg + off_deg), -1);
    const double depth = dot(wo, axis.along);
    return depth > 0 &&
           std::abs(dot(wo, axis.in_plane)) <= depth * half_width(geometry_.receptor.in_plane) &&
           std::abs(dot(wo, kAcross)) <= depth * half_width(geometry_.receptor.across);
}

double GlossOptics::glass(double index) const {
    constexpr int kSteps = 32;
    double sum = 0;
    for (int i = 0; i < kSteps; ++i)
        for (int j = 0; j < kSteps; ++j)
            sum += fresnel_dielectric(source_direction((i + 0.5) / kSteps, (j + 0.5) / kSteps).z,
                                      index);
    return sum / (kSteps * kSteps);
}

double GlossOptics::share(const std::function<double(Vec3, Vec3)>& f, int steps) const {
    const Axis axis = axis_at(radians(geometry_.angle_deg), -1);
    const double a = half_width(geometry_.receptor.in_plane),
                 b = half_width(geometry_.receptor.across);
    const double area = 4 * a * b / (static_cast<double>(steps) * steps);
    double sum = 0;
    for (int k = 0; k < steps * steps; ++k) {
        const Vec3 wi = source_direction((k % steps + 0.5) / steps, (k / steps + 0.5) / steps);
        for (int l = 0; l < steps * steps; ++l) {
            const Vec3 on_plane = axis.along +
                                  ((2 * (l % steps) + 1.0) / steps - 1) * a * axis.in_plane +
                                  ((2 * (l / steps) + 1.0) / steps - 1) * b * kAcross;
            const Vec3 wo = normalize(on_plane);
            if (wo.z <= 0) continue;  // below the specimen's own plane
            const double distance = length(on_plane);
            sum += f(wi, wo) * wo.z * area / (distance * distance * distance);
        }
    }
    return sum / (static_cast<double>(steps) * steps);
}

}  // namespace asperity
