// SPDX-License-Identifier: Apache-2.0
// Tensor trees of Radiance in its BSDF XML, of rank 3 (isotropic) and 4. A reflector is the
// "Reflection Back" of the file, as in Klems files.
#include <asperity/core/directions.h>
#include <asperity/core/error.h>
#include <asperity/core/parallel.h>
#include <asperity/formats/atomic_file.h>
#include <asperity/formats/bsdfs/bsdf_format.h>
#include <asperity/formats/bsdfs/cosine_sampled.h>
#include <asperity/formats/bsdfs/tensor_tree.h>
#include <asperity/formats/bsdfs/window_xml.h>

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <numeric>

namespace asperity::io {
namespace {

constexpr int kPoints = 24;           ///< directions a cell
constexpr double kTolerance = 0.005;  ///< of cubes that become one

/// Luminance, averaged over the cell at these corners.
double average(const Bsdf& bsdf, const std::vector<double>& luminance, int rank, double side,
               const std::array<double, 4>& corner) {
    // Roberts 2018: steps of the generalised golden ratio of as many dimensions.
    const double ratio = rank == 4 ? 1.1673039782614187 : 1.2207440846057596;
    std::array<double, kMaxBsdfChannels> values{};
    const std::span<double> f = std::span(values).first(luminance.size());
    double sum = 0;
    for (int k = 0; k < kPoints; ++k) {
        std::array<double, 4> c{};
        double step = 1;
        for (std::size_t d = 0; d < static_cast<std::size_t>(rank); ++d) {
            step /= ratio;
            const double u = 0.5 + step * (k + 1);
            c[d] = corner[d] + side * (u - std::floor(u));
        }
        const TreeDirections w = tree_directions(rank, c);
        bsdf.eval(w.wi, w.wo, f);
        sum += std::inner_product(f.begin(), f.end(), luminance.begin(), 0.0);
    }
    return sum / kPoints;
}

std::vector<double> grid_of(const Bsdf& bsdf, const std::vector<double>& luminance, int rank,
                            int levels, int threads) {
    const std::size_t side = std::size_t{1} << levels;
    const std::size_t row = std::size_t{1} << (levels * (rank - 1));
    std::vector<double> grid(side * row, 0.0);
    // Of rank 3 the first coordinate ends at 1/2.
    parallel_for(rank == 3 ? side / 2 : side, threads, [&](std::size_t first) {
        for (std::size_t k = first * row; k < (first + 1) * row; ++k) {
            std::array<double, 4> corner{};
            for (std::size_t d = 0; d < static_cast<std::size_t>(rank); ++d)
                corner[d] = static_cast<double>(k >> ((static_cast<std::size_t>(rank) - 1 - d) *
                                                      static_cast<std::size_t>(levels)) &
                                                (side - 1)) /
                            static_cast<double>(side);
            grid[k] = average(bsdf, luminance, rank, 1.0 / static_cast<double>(side), corner);
        }
    });
    return grid;
}

/// Halvings that a lobe needs: one more where it is sharper than that of GGX of alpha 0.2.
int levels_for(const Bsdf& bsdf, const std::vector<double>& luminance, int rank) {
    if (rank == 4) return 4;
    const auto of_channels = [&](auto&& call) {
        std::array<double, kMaxBsdfChannels> values{};
        call(std::span(values).first(luminance.size()));
        return std::inner_product(luminance.begin(), luminance.end(), values.begin(), 0.0);
    };
    const Vec3 normal = {0, 0, 1};
    const double peak = of_channels([&](std::span<double> f) { bsdf.eval(normal, normal, f); });
    const double albedo = of_channels([&](std::span<double> a) { bsdf.albedo(normal, a); });
    return 4 * kPi * peak * 0.2 * 0.2 > albedo ? 7 : 6;
}

BsdfFormat::Remarks write(const ExportSource& source, const FormatOptions& options,
                          const std::string& path) {
    const int rank = options.count("rank", 3, 4, source.isotropic() ? 3 : 4);
    const Bsdf& bsdf = rank == 3 ? source.isotropic_bsdf() : source.bsdf();
    const int levels = options.count("levels", 1, rank == 3 ? 8 : 6,
                                     levels_for(bsdf, source.luminance_weights(), rank));
    const auto asked = [&] { source.check_stopped(); };
    const TensorTree tree(rank, levels,
                          grid_of(bsdf, source.luminance_weights(), rank, levels, source.threads()),
                          kTolerance, asked);
    AtomicFile file(path, source.watched());
    file.write(window_opening(source) +
               fmt::format("<DataDefinition>\n<IncidentDataStructure>TensorTree{}"
                           "</IncidentDataStructure>\n</DataDefinition>\n",
                           rank));
    file.write(
        "<WavelengthData>\n<LayerNumber>System</LayerNumber>\n"
        "<Wavelength unit=\"Integral\">Visible</Wavelength>\n"
        "<SourceSpectrum>CIE Illuminant D65 1nm.ssp</SourceSpectrum>\n"
        "<DetectorSpectrum>ASTM E308 1931 Y.dsp</DetectorSpectrum>\n<WavelengthDataBlock>\n"
        "<WavelengthDataDirection>Reflection Back</WavelengthDataDirection>\n"
        "<AngleBasis>LBNL/Shirley-Chiu</AngleBasis>\n"
        "<ScatteringDataType>BTDF</ScatteringDataType>\n<ScatteringData>\n");
    file.write(tree.text(asked) + "</ScatteringData>\n</WavelengthDataBlock>\n</WavelengthData>\n" +
               window_closing());
    file.commit();
    BsdfFormat::Remarks remarks = {
        fmt::format("cubes of 1/{} of a side, constant within each", 1 << levels)};
    if (rank == 3) remarks.emplace_back("isotropic: averaged over azimuth and mirrored");
    if (source.channels() > 1) remarks.emplace_back("colour is not held: luminance");
    return remarks;
}

class TreeBsdf final : public CosineSampledBsdf {
  public:
    TreeBsdf(std::string name, int rank, TensorTree tree)
        : name_(std::move(name)), rank_(rank), tree_(std::move(tree)) {}
    int channels() const override { return 1; }
    std::string name() const override { return name_; }
    bool isotropic() const override { return rank_ == 3; }
    void eval(Vec3 wi, Vec3 wo, std::span<double> f) const override {
        const bool above = wi.z > 0 && wo.z > 0;
        f[0] = above ? tree_.at(tree_coordinates(rank_, wi, wo)) : 0;
    }

  private:
    std::string name_;
    int rank_;
    TensorTree tree_;
};

std::unique_ptr<Bsdf> read(const std::string& path) {
    pugi::xml_document document;
    const pugi::xml_node layer = read_window_layer(path, document);
    const std::string kind = layer.child("DataDefinition").child_value("IncidentDataStructure");
    if (kind != "TensorTree3" && kind != "TensorTree4")
        throw Error(ErrorCode::InvalidInput, "is of neither TensorTree3 nor TensorTree4", path);
    const int rank = kind.back() - '0';
    return std::make_unique<TreeBsdf>("file:" + std::filesystem::path(path).filename().string(),
                                      rank,
                                      TensorTree(rank, visible_reflection(layer, path), path));
}

}  // namespace

BsdfFormat tensor_tree_format() {
    return {"tensortree",
            {"xml"},
            "Radiance: tree of averages, finer than Klems patches, Visible",
            {{"rank", "", "3 (isotropic) or 4; as the data are"},
             {"levels", "",
              "halvings of a side at most: 6 or, for sharp lobes, 7 of rank 3, 4 of rank 4"}},
            write,
            [](std::string_view head) {
                return head.find("<WindowElement") != head.npos &&
                       head.find("TensorTree") != head.npos;
            },
            read};
}

}  // namespace asperity::io
