// SPDX-License-Identifier: Apache-2.0
// BSDF text of LightTools: polar angles from the normal; light comes from azimuth 90 degrees.
#include <asperity/core/directions.h>
#include <asperity/core/error.h>
#include <asperity/formats/atomic_file.h>
#include <asperity/formats/bsdfs/angle_table.h>
#include <asperity/formats/bsdfs/bsdf_format.h>
#include <asperity/formats/bsdfs/text_tokens.h>

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>

namespace asperity::io {
namespace {

constexpr int kMostAngles = 4096;
constexpr double kLight = kPi / 2;  ///< azimuth that light of isotropic data comes from
constexpr std::array kTristimulus = {"TrisX", "TrisY", "TrisZ"};

struct Block {
    double aoi = 0, poi = 90;
    int channel = 0;
    bool kept = true;  ///< of the front side and reflected
};

struct Blocks {
    AngleTable table;
    std::vector<std::vector<double>> azimuth_rows;               ///< of each kept block
    std::map<std::pair<double, int>, std::size_t> by_incidence;  ///< aoi [deg], channel
};

std::vector<double> read_angles(TextTokens& text) {
    const int count = text.count(1, kMostAngles);
    std::vector<double> angles = text.numbers(static_cast<std::size_t>(count));
    for (double& angle : angles) angle = radians(angle);
    return angles;
}

void read_header(TextTokens& text, AngleTable& table) {
    while (!text.take("DataBegin")) {
        const std::string word(text.word());
        if (word == "Symmetry") {
            const std::string_view kind = text.word();
            table.mirrored = kind == "PlaneSymmetrical";
            if (!table.mirrored && kind != "Asymmetric")
                text.fail("the symmetry is neither Asymmetric nor PlaneSymmetrical");
        } else if (word == "SpectralContent") {
            table.channels = text.word() == "XYZ" ? 3 : 1;
        } else if (word == "ScatterAzimuth") {
            table.azimuth = read_angles(text);
        } else if (word == "ScatterRadial") {
            table.polar = read_angles(text);
        } else {
            text.fail("a key that is not known");
        }
    }
    if (table.directions() == 0) text.fail("ScatterAzimuth or ScatterRadial is missing");
}

/// A block's head up to its TIS.
Block read_block_head(TextTokens& text) {
    Block block;
    for (;;) {
        const std::string word(text.word());
        if (word == "AOI") {
            block.aoi = text.number();
        } else if (word == "POI") {
            block.poi = text.number();
        } else if (word == "Side") {
            block.kept = text.word() == "Front" && block.kept;
        } else if (word == "Wavelength") {
            text.number();
        } else if (word == "ScatterType") {
            block.kept = text.word() == "BRDF" && block.kept;
        } else if (word == "TristimulusValue") {
            const std::string_view name = text.word();
            const auto found = std::find(kTristimulus.begin(), kTristimulus.end(), name);
            if (found == kTristimulus.end()) text.fail("is none of TrisX, TrisY, TrisZ");
            block.channel = static_cast<int>(found - kTristimulus.begin());
        } else if (word == "TIS") {
            text.number();
            return block;
        } else {
            text.fail("a key that is not known");
        }
    }
}

void assemble(Blocks& blocks, const std::string& path) {
    AngleTable& table = blocks.table;
    std::vector<double> incidences;
    for (const auto& [key, row] : blocks.by_incidence)
        if (incidences.empty() || incidences.back() != key.first) incidences.push_back(key.first);
    for (const double aoi : incidences) table.theta_i.push_back(radians(aoi));
    if (blocks.by_incidence.size() != incidences.size() * std::size_t(table.channels))
        throw Error(ErrorCode::InvalidInput, "lacks the block of an incidence and channel", path);
    table.f.assign(table.size(), 0.0);
    for (std::size_t t = 0; t < incidences.size(); ++t)
        for (std::size_t n = 0; n < table.directions(); ++n) {
            std::array<double, 3> values{};
            for (int c = 0; c < table.channels; ++c) {
                const std::vector<double>& rows =
                    blocks.azimuth_rows[blocks.by_incidence.at({incidences[t], c})];
                const std::size_t polar = n / table.azimuth.size(), a = n % table.azimuth.size();
                values[std::size_t(c)] = rows[a * table.polar.size() + polar];
            }
            if (table.channels == 3) values = rgb_of_xyz(values);
            for (int c = 0; c < table.channels; ++c)
                table.f[table.block(0, t, c) + n] = values[std::size_t(c)];
        }
}

std::unique_ptr<Bsdf> read(const std::string& path) {
    TextTokens text(path);
    Blocks blocks;
    blocks.table.azimuth_zero = -kLight;
    read_header(text, blocks.table);
    double azimuth = 0;
    while (!text.take("DataEnd")) {
        const Block block = read_block_head(text);
        std::vector<double> values = text.numbers(blocks.table.directions());
        if (!block.kept) continue;
        if (!blocks.azimuth_rows.empty() && block.poi != azimuth)
            text.fail("light from several azimuths (POI) is not read");
        azimuth = block.poi;
        if (!blocks.by_incidence
                 .emplace(std::pair(block.aoi, block.channel), blocks.azimuth_rows.size())
                 .second)
            text.fail("a second block for one incidence");
        blocks.azimuth_rows.push_back(std::move(values));
    }
    if (blocks.azimuth_rows.empty())
        throw Error(ErrorCode::InvalidInput, "has no reflected light of the front side", path);
    blocks.table.azimuth_zero = -radians(azimuth);
    assemble(blocks, path);
    return make_table_bsdf(std::move(blocks.table),
                           "file:" + std::filesystem::path(path).filename().string(), path);
}

std::string angles_text(const char* name, const std::vector<double>& angles) {
    std::string text = fmt::format("{} {}\n", name, angles.size());
    for (const double angle : angles) text += fmt::format("{:.6g} ", degrees(angle));
    text.back() = '\n';
    return text;
}

std::string block_text(const AngleTable& table, std::size_t theta, int channel, bool colour) {
    std::string text =
        fmt::format("AOI {:.6g}\nPOI {:.6g}\nSide Front\nWavelength 550\nScatterType BRDF\n",
                    degrees(table.theta_i[theta]), degrees(kLight));
    if (colour) text += fmt::format("TristimulusValue {}\n", kTristimulus[std::size_t(channel)]);
    text += fmt::format("TIS {:.6g}\n", integral_of(table, 0, theta, channel));
    const double* const f = &table.f[table.block(0, theta, channel)];
    for (std::size_t a = 0; a < table.azimuth.size(); ++a)
        for (std::size_t p = 0; p < table.polar.size(); ++p)
            text += fmt::format("{:.5g}{}", f[p * table.azimuth.size() + a],
                                p + 1 < table.polar.size() ? " " : "\n");
    return text;
}

BsdfFormat::Remarks write(const ExportSource& source, const FormatOptions& options,
                          const std::string& path) {
    const double step = options.number("step", 0.1, 30, 2);
    AngleTable table;
    table.azimuth_zero = -kLight;
    table.theta_i = table_thetas(source);
    table.polar = even_angles(0, 90, step);
    table.azimuth = even_angles(0, 360, std::max(2.0, step));
    const bool colour = source.channels() == 3;
    fill(table, source.isotropic_bsdf(), tristimulus_or_luminance(source), source.threads());
    AtomicFile file(path, source.watched());
    for (const std::string& line : source.provenance()) file.write("# " + line + "\n");
    file.write(
        fmt::format("Symmetry Asymmetric\nSpectralContent {}\n", colour ? "XYZ" : "Monochrome"));
    file.write(angles_text("ScatterAzimuth", table.azimuth));
    file.write(angles_text("ScatterRadial", table.polar) + "DataBegin\n");
    for (std::size_t t = 0; t < table.theta_i.size(); ++t)
        for (int c = 0; c < table.channels; ++c) file.write(block_text(table, t, c, colour));
    file.write("DataEnd\n");
    file.commit();
    BsdfFormat::Remarks remarks = {"isotropic: averaged over azimuth and mirrored"};
    if (source.channels() > 1 && !colour) remarks.emplace_back("the channels are averaged");
    return remarks;
}

}  // namespace

BsdfFormat lighttools_format() {
    return {"lighttools",
            {"bsdf"},
            "LightTools: BSDF text by polar angle and azimuth, isotropic",
            {{"step", "2", "degrees between outgoing angles"}},
            write,
            [](std::string_view head) {
                return head.find("ScatterAzimuth") != head.npos &&
                       head.find("AngleOfIncidence") == head.npos;
            },
            read};
}

}  // namespace asperity::io
