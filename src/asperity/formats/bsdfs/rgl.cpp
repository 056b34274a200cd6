// SPDX-License-Identifier: Apache-2.0
// RGL / Mitsuba .bsdf: f cos(theta_o) over visible normals. The normals are spread by a GGX
// distribution as wide as the lobe at normal incidence: any positive one gives a correct file, a
// fitting one a smooth table.
#include <asperity/core/directions.h>
#include <asperity/core/error.h>
#include <asperity/core/parallel.h>
#include <asperity/formats/bsdfs/rgl_format.h>
#include <asperity/formats/bsdfs/rgl_warp.h>
#include <asperity/formats/results/tensor_file.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace asperity::io {
namespace {

using namespace rgl;

/// Widths of a distribution of normals.
struct Widths {
    double x = 0.3, y = 0.3;
};

/// The value below which half of the weight lies.
double weighted_median(std::vector<std::pair<double, double>> values) {
    std::sort(values.begin(), values.end());
    double total = 0, sum = 0;
    for (const auto& [value, weight] : values) total += weight;
    for (const auto& [value, weight] : values)
        if ((sum += weight) >= 0.5 * total) return value;
    return 0;
}

/// Widths of the GGX that has the medians of the lobe at normal incidence: there f cos(theta_o) dwo
/// = D cos(theta_m) dwm up to masking, half of it within tan(theta_m) = alpha, or, along one
/// axis, within alpha / sqrt(3).
Widths widths_of(const Bsdf& bsdf, const std::vector<double>& luminance, bool isotropic) {
    constexpr int kTheta = 512, kPhi = 64;
    std::vector<std::pair<double, double>> all, along_x, along_y;
    std::vector<double> f(static_cast<std::size_t>(bsdf.channels()));
    for (int i = 0; i < kTheta; ++i)
        for (int j = 0; j < kPhi; ++j) {
            const double u = (i + 0.5) / kTheta, theta_m = u * u * 0.25 * kPi;
            const double theta = 2 * theta_m, phi = 2 * kPi * (j + 0.5) / kPhi;
            bsdf.eval({0, 0, 1}, from_spherical(theta, phi), f);
            const double value = std::inner_product(f.begin(), f.end(), luminance.begin(), 0.0);
            const double weight = value * std::cos(theta) * std::sin(theta) * u;
            const double slope = std::tan(theta_m);
            all.emplace_back(slope, weight);
            along_x.emplace_back(slope * std::abs(std::cos(phi)), weight);
            along_y.emplace_back(slope * std::abs(std::sin(phi)), weight);
        }
    const auto held = [](double alpha) { return std::clamp(alpha, 0.005, 1.0); };
    if (isotropic) return {held(weighted_median(all)), held(weighted_median(all))};
    return {held(std::sqrt(3.0) * weighted_median(along_x)),
            held(std::sqrt(3.0) * weighted_median(along_y))};
}

/// D(m) of GGX [1/sr].
double ggx(Vec3 m, Widths a) {
    const double x = m.x / a.x, y = m.y / a.y, q = x * x + y * y + m.z * m.z;
    return 1 / (kPi * a.x * a.y * q * q);
}

/// Projected area of its microsurface: integral of D(m) max(0, w . m) = cos(theta) (1 + Lambda).
double projected_area(Vec3 w, Widths a) {
    return 0.5 * (w.z + std::sqrt(w.z * w.z + a.x * a.x * w.x * w.x + a.y * a.y * w.y * w.y));
}

/// Sizes of the tables.
struct Grid {
    std::vector<float> phis, thetas;
    std::size_t n = 64;         ///< nodes on a side of the values
    std::size_t normals = 128;  ///< nodes on a side of the visible normals
    std::size_t slices() const { return phis.size() * thetas.size(); }
};

/// Rising angles, more between them so that none lie further apart than `spacing`.
std::vector<double> refined(std::vector<double> nodes, double spacing) {
    std::sort(nodes.begin(), nodes.end());
    std::vector<double> fine = {nodes.front()};
    for (std::size_t k = 1; k < nodes.size(); ++k) {
        const double gap = nodes[k] - nodes[k - 1];
        if (gap < 1e-6) continue;
        const int parts = std::max(1, static_cast<int>(std::ceil(gap / spacing - 1e-9)));
        for (int p = 1; p <= parts; ++p) fine.push_back(nodes[k - 1] + gap * p / parts);
    }
    return fine;
}

Grid grid_of(const ExportSource& source, const FormatOptions& options, bool isotropic) {
    constexpr double kLast = 88, kSpacing = 4;  // [deg]
    Grid grid;
    const int columns = source.experiment().detector.resolution;
    grid.n = static_cast<std::size_t>(
        options.count("n", 4, 1024,
                      source.measurement() ? std::clamp(columns / 2, 32, isotropic ? 64 : 32)
                                           : (isotropic ? 64 : 32)));
    grid.normals = static_cast<std::size_t>(options.count("normals", 8, 2048, 128));
    const int thetas = options.count("theta", 2, 512, 0);
    std::vector<double> angles;
    if (thetas > 0) {  // closer together towards the horizon
        for (int k = 0; k < thetas; ++k)
            angles.push_back(radians(kLast) * std::sin(0.5 * kPi * k / (thetas - 1)));
    } else {
        angles = source.thetas();
        angles.insert(angles.end(), {0.0, radians(86), radians(kLast)});
        angles = refined(std::move(angles), radians(isotropic ? kSpacing : 2 * kSpacing));
    }
    grid.thetas.assign(angles.begin(), angles.end());
    if (isotropic) {
        grid.phis = {0};
        return grid;
    }
    const int phis = options.count("phi", 3, 512, 0);
    std::vector<double> azimuths;
    if (phis > 0) {
        for (int k = 0; k < phis; ++k) azimuths.push_back(kPi * (2.0 * k / (phis - 1) - 1));
    } else {
        azimuths = {-kPi, kPi};
        for (const double phi : source.phis()) azimuths.push_back(std::remainder(phi, 2 * kPi));
        azimuths = refined(std::move(azimuths), radians(22.5));
    }
    grid.phis.assign(azimuths.begin(), azimuths.end());
    return grid;
}

/// The tables of a file.
struct Tables {
    Images ndf, sigma, vndf, luminance, values;
};

constexpr std::size_t kSide = 256;  ///< nodes of the distribution and the projected area

Images image_over_sphere(std::size_t width, std::size_t height, auto&& of_direction) {
    Images image{width, height, std::vector<float>(width * height)};
    for (std::size_t r = 0; r < height; ++r)
        for (std::size_t c = 0; c < width; ++c) {
            const Point u{static_cast<double>(c) / static_cast<double>(width - 1),
                          static_cast<double>(r) / static_cast<double>(height - 1)};
            image.values[r * width + c] =
                static_cast<float>(of_direction(from_spherical(theta_of(u), phi_of(u)), u));
        }
    return image;
}

class RglBuilder {
  public:
    RglBuilder(const ExportSource& source, const Grid& grid, bool isotropic,
               std::vector<int> channels)
        : source_(source),
          bsdf_(isotropic ? source.isotropic_bsdf() : source.bsdf()),
          luminance_(source.luminance_weights()),
          grid_(grid),
          isotropic_(isotropic),
          channels_(std::move(channels)),
          widths_(widths_of(bsdf_, luminance_, isotropic)) {}

    Widths widths() const { return widths_; }

    Tables build(int threads) {
        Tables t;
        t.ndf = image_over_sphere(kSide, isotropic_ ? 2 : kSide,
                                  [&](Vec3 m, Point) { return ggx(m, widths_); });
        t.sigma = image_over_sphere(kSide, isotropic_ ? 2 : kSide,
                                    [&](Vec3 w, Point) { return projected_area(w, widths_); });
        const std::size_t normals = grid_.normals * grid_.normals, size = grid_.n * grid_.n;
        // Large tables: to make room for one takes as long as a stop may
        source_.check_stopped();
        t.vndf = {grid_.normals, grid_.normals, std::vector<float>(grid_.slices() * normals)};
        source_.check_stopped();
        t.luminance = {grid_.n, grid_.n, std::vector<float>(grid_.slices() * size)};
        source_.check_stopped();
        t.values = {grid_.n, grid_.n, std::vector<float>(grid_.slices() * channels_.size() * size)};
        parallel_for(grid_.slices(), threads, [&](std::size_t s) { fill_visible(t, s); });
        // Values are taken at the directions that readers will find with the numbers as written.
        const Density visible(t.vndf, [this] { source_.check_stopped(); });
        parallel_for(grid_.slices(), threads, [&](std::size_t s) { fill_values(t, visible, s); });
        return t;
    }

  private:
    Vec3 light(std::size_t slice) const {
        return from_spherical(double{grid_.thetas[slice % grid_.thetas.size()]},
                              double{grid_.phis[slice / grid_.thetas.size()]});
    }

    /// Visible normals of one incidence, with a floor: rows without any cannot be inverted.
    void fill_visible(Tables& t, std::size_t slice) const {
        const Vec3 wi = light(slice);
        const Images image = image_over_sphere(grid_.normals, grid_.normals, [&](Vec3 m, Point u) {
            source_.check_stopped();
            return ggx(m, widths_) * std::max(0.0, dot(wi, m)) * 2 * kPi * kPi * u.x *
                   std::sin(theta_of(u));
        });
        const float floor = 1e-6F * *std::max_element(image.values.begin(), image.values.end());
        float* out = &t.vndf.values[slice * image.values.size()];
        for (const float v : image.values) *out++ = v + floor;
    }

    /// f cos(theta_o) 4 sigma(wi) / D(m) at every node, 0 below the horizon.
    void fill_values(Tables& t, const Density& visible, std::size_t slice) const {
        const Vec3 wi = light(slice);
        const Blend here{{slice, slice, slice, slice}, {1, 0, 0, 0}};
        const double sigma = t.sigma.eval(to_square(polar_angle(wi), std::atan2(wi.y, wi.x)), {});
        const std::size_t n = grid_.n, size = n * n, channels = channels_.size();
        std::vector<double> f(static_cast<std::size_t>(bsdf_.channels()));
        float* values = &t.values.values[slice * channels * size];
        float* luminance = &t.luminance.values[slice * size];
        for (std::size_t k = 0; k < size; ++k) {
            const Point s{static_cast<double>(k % n) / static_cast<double>(n - 1),
                          static_cast<double>(k / n) / static_cast<double>(n - 1)};
            const Point u = visible.sample(s, here).point;
            const Vec3 wo = reflect(wi, from_spherical(theta_of(u), phi_of(u)));
            if (wo.z <= 0) continue;
            bsdf_.eval(wi, wo, f);
            const double scale = wo.z * 4 * sigma / t.ndf.eval(u, {});
            for (std::size_t c = 0; c < channels; ++c)
                values[c * size + k] =
                    static_cast<float>(scale * f[static_cast<std::size_t>(channels_[c])]);
            luminance[k] = static_cast<float>(
                scale * std::inner_product(f.begin(), f.end(), luminance_.begin(), 0.0));
        }
        const float most = *std::max_element(luminance, luminance + size);
        const float floor = most > 0 ? 1e-4F * most : 1.0F;
        for (std::size_t k = 0; k < size; ++k) luminance[k] = std::max(luminance[k], floor);
    }

    const ExportSource& source_;
    const Bsdf& bsdf_;
    std::vector<double> luminance_;
    const Grid& grid_;
    bool isotropic_;
    std::vector<int> channels_;
    Widths widths_;
};

/// Wavelengths and channels of a spectral file. A grey source has the same value at both ends.
std::vector<float> wavelengths_of(const ExportSource& source, std::vector<int>& channels) {
    if (source.channels() == 1) {
        channels = {0, 0};
        return {360, 830};
    }
    const std::vector<double> known = source.wavelengths_nm();
    if (known.empty())
        throw Error(ErrorCode::Usage,
                    "spectral needs channels that are wavelengths (simulate --wavelengths), or one",
                    "colour");
    channels.resize(known.size());
    std::iota(channels.begin(), channels.end(), 0);
    std::sort(channels.begin(), channels.end(), [&](int a, int b) {
        return known[static_cast<std::size_t>(a)] < known[static_cast<std::size_t>(b)];
    });
    std::vector<float> wavelengths;
    for (const int c : channels)
        wavelengths.push_back(static_cast<float>(known[static_cast<std::size_t>(c)]));
    return wavelengths;
}

TensorBlock block(std::string name, std::vector<std::uint64_t> shape,
                  const std::vector<float>& values) {
    return {std::move(name), TensorType::F32, std::move(shape), {std::as_bytes(std::span(values))}};
}

void check_size(const Grid& grid, std::size_t channels) {
    constexpr double kMost = 2e9;  // bytes; readers hold the file in memory
    const double slice =
        static_cast<double>(grid.normals * grid.normals + (channels + 1) * grid.n * grid.n) *
        sizeof(float);
    if (slice * static_cast<double>(grid.slices()) > kMost)
        throw Error(ErrorCode::Usage, "the file would exceed 2 GB: ask for smaller grids",
                    "format");
}

BsdfFormat::Remarks write(const ExportSource& source, const FormatOptions& options,
                          const std::string& path) {
    const std::string azimuth = options.word("azimuth", {"auto", "isotropic", "anisotropic"});
    const bool isotropic = azimuth == "isotropic" || (azimuth == "auto" && source.isotropic());
    const bool spectral = options.word("colour", {"rgb", "spectral"}) == "spectral";
    std::vector<int> channels;
    std::vector<float> wavelengths;
    if (spectral) {
        wavelengths = wavelengths_of(source, channels);
    } else {
        for (const int c : source.rgb_channels()) channels.push_back(c);
    }
    const Grid grid = grid_of(source, options, isotropic);
    check_size(grid, channels.size());

    RglBuilder builder(source, grid, isotropic, channels);
    const Tables t = builder.build(source.threads());
    std::string description;
    for (const std::string& line : source.provenance()) description += line + "\n";
    const std::uint8_t jacobian = 1;
    const std::uint64_t p = grid.phis.size(), q = grid.thetas.size(), n = grid.n;
    std::vector<TensorBlock> blocks = {
        {"description",
         TensorType::U8,
         {description.size()},
         {std::as_bytes(std::span(description))}},
        {"jacobian", TensorType::U8, {1}, {std::as_bytes(std::span(&jacobian, 1))}},
        block("phi_i", {p}, grid.phis),
        block("theta_i", {q}, grid.thetas),
        block("ndf", {t.ndf.height, t.ndf.width}, t.ndf.values),
        block("sigma", {t.sigma.height, t.sigma.width}, t.sigma.values),
        block("vndf", {p, q, grid.normals, grid.normals}, t.vndf.values),
        block("luminance", {p, q, n, n}, t.luminance.values)};
    if (spectral) blocks.push_back(block("wavelengths", {wavelengths.size()}, wavelengths));
    blocks.push_back(
        block(spectral ? "spectra" : "rgb", {p, q, channels.size(), n, n}, t.values.values));
    write_tensor_file(path, blocks, source.watched());

    BsdfFormat::Remarks remarks;
    if (isotropic)
        remarks.emplace_back(
            "isotropic: averaged over azimuth and mirrored at the plane of "
            "incidence");
    remarks.push_back(fmt::format("{} azimuths x {} angles, values {} x {}, normals {} x {}", p, q,
                                  n, n, grid.normals, grid.normals));
    return remarks;
}

}  // namespace

BsdfFormat rgl_format() {
    return {"rgl",
            {"bsdf"},
            "Mitsuba 3 (measured), pbrt-v4 (colour=spectral), powitacq, Tekari",
            {{"colour", "rgb", "rgb or spectral"},
             {"azimuth", "auto", "auto, isotropic or anisotropic"},
             {"n", "", "nodes on a side of the values, 4 .. 1024"},
             {"theta", "", "incident polar angles, 2 .. 512; auto: the layers and between them"},
             {"phi", "", "incident azimuths when anisotropic, 3 .. 512"},
             {"normals", "", "nodes on a side of the visible normals, 8 .. 2048"}},
            write,
            looks_like_rgl,
            read_rgl};
}

}  // namespace asperity::io
