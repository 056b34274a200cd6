// SPDX-License-Identifier: Apache-2.0
#include <asperity/surface/surface_figures.h>

#include <array>

namespace asperity {
namespace {

constexpr std::array<SurfaceFigure, 17> kFigures = {{
    {"mean_height", &SurfaceStatistics::mean_height},
    {"min_height", &SurfaceStatistics::min_height},
    {"max_height", &SurfaceStatistics::max_height},
    {"rms_height", &SurfaceStatistics::rms_height},
    {"skewness", &SurfaceStatistics::skewness},
    {"kurtosis", &SurfaceStatistics::kurtosis},
    {"mean_slope_x", &SurfaceStatistics::mean_slope_x},
    {"mean_slope_y", &SurfaceStatistics::mean_slope_y},
    {"rms_slope_x", &SurfaceStatistics::rms_slope_x},
    {"rms_slope_y", &SurfaceStatistics::rms_slope_y},
    {"rms_gradient", &SurfaceStatistics::rms_gradient},
    {"alpha_x", &SurfaceStatistics::alpha_x},
    {"alpha_y", &SurfaceStatistics::alpha_y},
    {"slope_correlation", &SurfaceStatistics::slope_correlation},
    {"mean_tilt_deg", &SurfaceStatistics::mean_tilt_deg},
    {"max_tilt_deg", &SurfaceStatistics::max_tilt_deg},
    {"area_ratio", &SurfaceStatistics::area_ratio},
}};
static_assert(sizeof(SurfaceStatistics) == kFigures.size() * sizeof(double),
              "a figure of the surface is missing from the list");

}  // namespace

std::span<const SurfaceFigure> surface_figures() {
    return kFigures;
}

}  // namespace asperity
