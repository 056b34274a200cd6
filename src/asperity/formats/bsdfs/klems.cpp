// SPDX-License-Identifier: Apache-2.0
// Klems matrices in the BSDF XML of WINDOW and Radiance. A reflector is the "Reflection Back" of
// the file: the side that Radiance's +Z looks from.
#include <asperity/core/directions.h>
#include <asperity/core/error.h>
#include <asperity/core/parallel.h>
#include <asperity/core/parse_number.h>
#include <asperity/formats/atomic_file.h>
#include <asperity/formats/bsdfs/bsdf_format.h>
#include <asperity/formats/bsdfs/cosine_sampled.h>
#include <asperity/formats/bsdfs/klems_basis.h>
#include <asperity/formats/bsdfs/window_xml.h>

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <numeric>

namespace asperity::io {
namespace {

/// Mean of f over an incident and an outgoing patch, both by projected solid angle, of every
/// channel. More points where much light goes: there a lobe may be narrower than the patch.
void average(const Bsdf& bsdf, const KlemsBasis& basis, int in, int out, std::span<double> mean) {
    // Roberts 2018: steps of the generalised golden ratio of four dimensions.
    constexpr double kRatio = 1.1673039782614187;
    constexpr double kMuchLight = 1e-3;
    constexpr std::array kPoints = {32, 256};
    std::array<double, kMaxBsdfChannels> f{};
    const std::span<double> values = std::span(f).first(mean.size());
    for (const int points : kPoints) {
        std::fill(mean.begin(), mean.end(), 0.0);
        for (int k = 0; k < points; ++k) {
            std::array<double, 4> u{};
            double step = 1;
            for (double& x : u) {
                step /= kRatio;
                x = 0.5 + step * (k + 1);
                x -= std::floor(x);
            }
            const Vec3 wi = klems_incident(basis.direction(in, u[0], u[1]));
            bsdf.eval(wi, basis.direction(out, u[2], u[3]), values);
            for (std::size_t c = 0; c < mean.size(); ++c) mean[c] += values[c] / points;
        }
        if (*std::max_element(mean.begin(), mean.end()) * basis.projected_solid_angle(out) <
            kMuchLight)
            return;
    }
}

/// [(outgoing * patches + incident) * channels + channel]
std::vector<double> matrix_of(const Bsdf& bsdf, const KlemsBasis& basis, int threads) {
    const std::size_t n = static_cast<std::size_t>(basis.patches());
    const std::size_t channels = static_cast<std::size_t>(bsdf.channels());
    std::vector<double> matrix(n * n * channels);
    parallel_for(n, threads, [&](std::size_t out) {
        for (std::size_t in = 0; in < n; ++in)
            average(bsdf, basis, static_cast<int>(in), static_cast<int>(out),
                    std::span(matrix).subspan((out * n + in) * channels, channels));
    });
    return matrix;
}

std::string basis_text(const KlemsBasis& basis) {
    std::string text = fmt::format(
        "<DataDefinition>\n<IncidentDataStructure>Columns</IncidentDataStructure>\n<AngleBasis>\n"
        "<AngleBasisName>{}</AngleBasisName>\n",
        basis.name());
    for (const KlemsBasis::Ring& r : basis.rings())
        text += fmt::format(
            "<AngleBasisBlock><Theta>{}</Theta><nPhis>{}</nPhis><ThetaBounds><LowerTheta>{}"
            "</LowerTheta><UpperTheta>{}</UpperTheta></ThetaBounds></AngleBasisBlock>\n",
            r.first == 0 ? 0.0 : 0.5 * (r.low_deg + r.high_deg), r.patches, r.low_deg, r.high_deg);
    return text + "</AngleBasis>\n</DataDefinition>\n";
}

/// One block of data: the channels weighted.
std::string block_text(const KlemsBasis& basis, std::span<const double> matrix,
                       const std::vector<double>& weights, const char* wavelength,
                       const char* source, const char* detector) {
    std::string text = fmt::format(
        "<WavelengthData>\n<LayerNumber>System</LayerNumber>\n"
        "<Wavelength unit=\"Integral\">{}</Wavelength>\n<SourceSpectrum>{}</SourceSpectrum>\n"
        "<DetectorSpectrum>{}</DetectorSpectrum>\n<WavelengthDataBlock>\n"
        "<WavelengthDataDirection>Reflection Back</WavelengthDataDirection>\n"
        "<ColumnAngleBasis>{}</ColumnAngleBasis>\n<RowAngleBasis>{}</RowAngleBasis>\n"
        "<ScatteringDataType>BTDF</ScatteringDataType>\n<ScatteringData>\n",
        wavelength, source, detector, basis.name(), basis.name());
    const std::size_t n = static_cast<std::size_t>(basis.patches()), channels = weights.size();
    for (std::size_t out = 0; out < n; ++out) {
        for (std::size_t in = 0; in < n; ++in) {
            const double* f = &matrix[(out * n + in) * channels];
            text +=
                fmt::format("{:.6g}{}", std::inner_product(weights.begin(), weights.end(), f, 0.0),
                            in + 1 < n ? "," : ",\n");
        }
    }
    return text + "</ScatteringData>\n</WavelengthDataBlock>\n</WavelengthData>\n";
}

BsdfFormat::Remarks write(const ExportSource& source, const FormatOptions& options,
                          const std::string& path) {
    const KlemsBasis basis(options.word("basis", {"full", "half", "quarter"}));
    const std::vector<double> matrix = matrix_of(source.bsdf(), basis, source.threads());
    const std::vector<double> luminance = source.luminance_weights();
    const std::vector<double> alike(luminance.size(), 1.0 / static_cast<double>(luminance.size()));
    AtomicFile file(path, source.watched());
    file.write(window_opening(source) + basis_text(basis));
    file.write(block_text(basis, matrix, alike, "Solar", "CIE Illuminant D65 1nm.ssp", "None"));
    file.write(block_text(basis, matrix, luminance, "Visible", "CIE Illuminant D65 1nm.ssp",
                          "ASTM E308 1931 Y.dsp"));
    file.write(window_closing());
    file.commit();
    BsdfFormat::Remarks remarks = {fmt::format(
        "{} patches, constant within each: sharper lobes become as wide", basis.patches())};
    if (source.channels() > 1)
        remarks.emplace_back(
            "colour is not held: Visible is the luminance, Solar the mean of the "
            "channels");
    return remarks;
}

class KlemsBsdf final : public CosineSampledBsdf {
  public:
    KlemsBsdf(std::string name, KlemsBasis basis, std::vector<double> matrix)
        : name_(std::move(name)), basis_(std::move(basis)), matrix_(std::move(matrix)) {}
    int channels() const override { return 1; }
    std::string name() const override { return name_; }
    void eval(Vec3 wi, Vec3 wo, std::span<double> f) const override {
        f[0] = 0;
        if (wi.z <= 0 || wo.z <= 0) return;
        f[0] = matrix_[static_cast<std::size_t>(basis_.patch_of(wo) * basis_.patches() +
                                                basis_.patch_of(klems_incident(wi)))];
    }

  private:
    std::string name_;
    KlemsBasis basis_;
    std::vector<double> matrix_;
};

std::vector<double> numbers_of(std::string_view text, std::size_t count, const std::string& path) {
    constexpr std::string_view kSeparators = " \t\r\n,";
    std::vector<double> numbers;
    for (std::size_t at = text.find_first_not_of(kSeparators); at != text.npos;
         at = text.find_first_not_of(kSeparators, at)) {
        const std::size_t end = std::min(text.find_first_of(kSeparators, at), text.size());
        const auto value = parse_double(text.substr(at, end - at));
        if (!value)
            throw Error(ErrorCode::InvalidInput,
                        in_quotes(text.substr(at, end - at)) + " is no number", path);
        if (numbers.size() == count) break;
        numbers.push_back(std::max(0.0, *value));
        at = end;
    }
    if (numbers.size() != count)
        throw Error(ErrorCode::InvalidInput,
                    fmt::format("ScatteringData has {} numbers, not {}", numbers.size(), count),
                    path);
    return numbers;
}

std::unique_ptr<Bsdf> read(const std::string& path) {
    pugi::xml_document document;
    const pugi::xml_node layer = read_window_layer(path, document);
    const std::string name =
        layer.child("DataDefinition").child("AngleBasis").child_value("AngleBasisName");
    std::string kind;
    for (const char* known : {"full", "half", "quarter"})
        if (KlemsBasis(known).name() == name) kind = known;
    if (kind.empty())
        throw Error(ErrorCode::InvalidInput, in_quotes(name) + " is no basis of Klems", path);
    KlemsBasis basis(kind);
    const std::string order = layer.child("DataDefinition").child_value("IncidentDataStructure");
    if (order != "Columns")
        throw Error(ErrorCode::InvalidInput, in_quotes(order) + " is not Columns", path);
    const std::size_t n = static_cast<std::size_t>(basis.patches());
    return std::make_unique<KlemsBsdf>("file:" + std::filesystem::path(path).filename().string(),
                                       basis,
                                       numbers_of(visible_reflection(layer, path), n * n, path));
}

}  // namespace

BsdfFormat klems_format() {
    return {"klems",
            {"xml"},
            "WINDOW, Radiance, EnergyPlus: matrix of Klems, Visible and Solar",
            {{"basis", "full", "full (145 patches), half (77) or quarter (41)"}},
            write,
            [](std::string_view head) {
                return head.find("<WindowElement") != head.npos &&
                       head.find("TensorTree") == head.npos;
            },
            read};
}

}  // namespace asperity::io
