// SPDX-License-Identifier: Apache-2.0
// MERL .binary: Matusik et al. 2003, "A data-driven reflectance model". Half and difference angles,
// three planes of doubles, isotropic.
#include <asperity/core/directions.h>
#include <asperity/core/error.h>
#include <asperity/core/parallel.h>
#include <asperity/formats/atomic_file.h>
#include <asperity/formats/bsdfs/bsdf_format.h>
#include <asperity/formats/bsdfs/cosine_sampled.h>
#include <asperity/formats/bsdfs/merl_angles.h>
#include <asperity/formats/read_file.h>

#include <fmt/format.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <filesystem>

namespace asperity::io {
namespace {

using namespace merl;

static_assert(std::endian::native == std::endian::little, "the file is little-endian");

constexpr std::size_t kCells = std::size_t{kHalf} * kDifference * kAzimuth;
constexpr std::size_t kBytes = 12 + 3 * kCells * sizeof(double);
constexpr std::array<std::int32_t, 3> kSizes = {kHalf, kDifference, kAzimuth};
constexpr std::array<double, 3> kScale = {1.0 / 1500, 1.15 / 1500, 1.66 / 1500};

class MerlBsdf final : public CosineSampledBsdf {
  public:
    explicit MerlBsdf(const std::string& path)
        : name_("file:" + std::filesystem::path(path).filename().string()) {
        const InputFile file(path);
        if (file.size() != kBytes)
            throw Error(ErrorCode::InvalidInput,
                        fmt::format("has {} bytes, a MERL file has {}", file.size(), kBytes), path);
        std::array<std::int32_t, 3> sizes{};
        file.read(0, std::as_writable_bytes(std::span(sizes)));
        if (sizes != kSizes)
            throw Error(ErrorCode::InvalidInput, "is not of 90 x 90 x 180 cells", path);
        values_.resize(3 * kCells);
        file.read(12, std::as_writable_bytes(std::span(values_)));
        for (const double v : values_)
            if (!std::isfinite(v)) throw Error(ErrorCode::InvalidInput, "holds a NaN or inf", path);
    }

    int channels() const override { return 3; }
    std::string name() const override { return name_; }
    bool isotropic() const override { return true; }

    void eval(Vec3 wi, Vec3 wo, std::span<double> f) const override {
        std::fill(f.begin(), f.end(), 0.0);
        if (wi.z <= 0 || wo.z <= 0) return;
        const std::size_t cell = cell_of(angles_of(wi, wo));
        for (std::size_t c = 0; c < 3; ++c)
            f[c] = std::max(0.0, values_[c * kCells + cell]) * kScale[c];
    }

  private:
    std::string name_;
    std::vector<double> values_;
};

/// f in the middle of a cell, the mean of both ways of the light; negative below the horizon.
void fill_cell(const Bsdf& bsdf, const std::array<int, 3>& channels, std::size_t cell,
               std::span<double> values) {
    const auto [wi, wo] = directions_of(centre_of(cell));
    for (std::size_t c = 0; c < 3; ++c) values[c * kCells + cell] = -1;
    if (wi.z <= 0 || wo.z <= 0) return;
    std::array<double, kMaxBsdfChannels> there{}, back{};
    const std::size_t n = static_cast<std::size_t>(bsdf.channels());
    bsdf.eval(wi, wo, std::span(there).first(n));
    bsdf.eval(wo, wi, std::span(back).first(n));
    for (std::size_t c = 0; c < 3; ++c) {
        const std::size_t k = static_cast<std::size_t>(channels[c]);
        values[c * kCells + cell] = 0.5 * (there[k] + back[k]) / kScale[c];
    }
}

BsdfFormat::Remarks write(const ExportSource& source, const FormatOptions&,
                          const std::string& path) {
    const std::array<int, 3> channels = source.rgb_channels();
    const Bsdf& bsdf = source.isotropic_bsdf();
    std::vector<double> values(3 * kCells);
    parallel_for(kHalf, source.threads(), [&](std::size_t half) {
        constexpr std::size_t kRow = kCells / kHalf;
        for (std::size_t k = half * kRow; k < (half + 1) * kRow; ++k)
            fill_cell(bsdf, channels, k, values);
    });
    AtomicFile file(path, source.watched());
    file.write(std::as_bytes(std::span(kSizes)));
    file.write(std::as_bytes(std::span(values)));
    file.commit();
    return {"isotropic: averaged over azimuth and mirrored at the plane of incidence",
            "reciprocal: f(wi, wo) and f(wo, wi) averaged",
            "cells without interpolation; the format has no room for a comment",
            "channels are linear red, green and blue of unstated primaries"};
}

bool recognises(std::string_view head) {
    return head.size() >= 12 && std::memcmp(head.data(), kSizes.data(), 12) == 0;
}

}  // namespace

BsdfFormat merl_format() {
    return {"merl",
            {"binary"},
            "MERL database, BRDF Explorer, Mitsuba 0.x plug-ins: isotropic, 35 MB",
            {},
            write,
            recognises,
            [](const std::string& path) { return std::make_unique<MerlBsdf>(path); }};
}

}  // namespace asperity::io
