// SPDX-License-Identifier: Apache-2.0
#include <asperity/surface/generators/profile.h>

#include <asperity/core/directions.h>
#include <asperity/core/error.h>
#include <asperity/surface/blocks.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace asperity::generators {

namespace {

[[noreturn]] void refuse_period(std::string why) {
    throw Error(ErrorCode::Usage, std::move(why), "period");
}

std::vector<double> heights(const Profile& profile, int count, double step) {
    std::vector<double> line(static_cast<std::size_t>(count), 0.0);
    if (profile)
        for (int i = 0; i < count; ++i) line[static_cast<std::size_t>(i)] = profile(i, step);
    return line;
}

void fill_sum(Heightfield& surface, const Profile& x, const Profile& y, Run& run) {
    const std::vector<double> along_x = heights(x, surface.nx, surface.dx);
    const std::vector<double> along_y = heights(y, surface.ny, surface.dy);
    for_blocks(surface.ny, kRowsPerBlock, run, [&](int first, int last) {
        for (auto j = static_cast<std::size_t>(first); j < static_cast<std::size_t>(last); ++j)
            for (std::size_t i = 0; i < along_x.size(); ++i)
                surface.heights[j * along_x.size() + i] =
                    static_cast<float>(along_x[i] + along_y[j]);
        run.advance(static_cast<std::uint64_t>(last - first));
    });
}

}  // namespace

void fill_one_way(Heightfield& surface, const SurfaceSettings& settings, const Profile& profile,
                  Run& run) {
    fill_sum(surface, settings.along_y ? Profile() : profile,
             settings.along_y ? profile : Profile(), run);
}

void fill_both_ways(Heightfield& surface, const Profile& profile, Run& run) {
    fill_sum(surface, profile, profile, run);
}

double slope_of_tilt(const SurfaceSettings& settings) {
    return std::tan(radians(settings.tilt_deg));
}

int to_valley(int i, int period) {
    const int phase = i % period;
    return std::min(phase, period - phase);
}

void check_period(const SurfaceSettings& s) {
    if (s.size % s.period != 0)
        refuse_period(fmt::format("{} does not divide the size, {}", s.period, s.size));
}

void check_even_period(const SurfaceSettings& s) {
    check_period(s);
    if (s.period % 2 != 0)
        refuse_period(fmt::format("{} is odd: the ridge would fall between two samples", s.period));
}

void check_wave(const SurfaceSettings& s) {
    check_period(s);
    if (s.period < 4) refuse_period(fmt::format("a wave needs at least 4 cells, not {}", s.period));
}

}  // namespace asperity::generators
