// SPDX-License-Identifier: Apache-2.0
// Surface files of Ansys Speos, text of version 8: .brdf, isotropic with wavelengths, and
// .anisotropicbsdf. Azimuth 0 is the side of the mirror direction. Programs take the shape of the
// values and the level from percentages.
#include <asperity/core/directions.h>
#include <asperity/core/error.h>
#include <asperity/formats/atomic_file.h>
#include <asperity/formats/bsdfs/angle_table.h>
#include <asperity/formats/bsdfs/bsdf_format.h>
#include <asperity/formats/bsdfs/text_tokens.h>

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

namespace asperity::io {
namespace {

constexpr const char* kBrdfHead = "OPTIS - brdf surface file v8.0";
constexpr const char* kAnisotropicHead = "OPTIS - Anisotropic BSDF surface file v8.0";
constexpr int kMostAngles = 4096;
const std::vector<double> kBlueToRed = {450, 550, 650};  ///< [nm], for blue, green and red
constexpr int kHeadLines = 5;  ///< title, 0, comment, length of the description, description

std::vector<double> read_degrees(TextTokens& text, int count) {
    std::vector<double> angles = text.numbers(static_cast<std::size_t>(count));
    for (double& angle : angles) angle = radians(angle);
    return angles;
}

/// Throws for a file without reflected light.
void read_sides(TextTokens& text, bool both) {
    const bool reflected = text.count(0, 1) == 1, transmitted = text.count(0, 1) == 1;
    if (!reflected) text.fail("is of transmitted light, which is not read");
    if (transmitted && !both) text.fail("holds transmitted light, too, which is not read");
}

/// One table: "nTheta nPhi", the azimuths, and rows of an angle and its values. `f`: [theta * phis
/// + phi]. All tables of a file must have the same angles.
std::vector<double> read_block(TextTokens& text, AngleTable& table) {
    const int rows = text.count(1, kMostAngles), columns = text.count(1, kMostAngles);
    const std::vector<double> azimuth = read_degrees(text, columns);
    std::vector<double> polar, f;
    for (int row = 0; row < rows; ++row) {
        polar.push_back(radians(text.number()));
        for (const double value : text.numbers(static_cast<std::size_t>(columns)))
            f.push_back(value);
    }
    if (table.polar.empty()) {
        table.polar = polar;
        table.azimuth = azimuth;
    } else if (polar != table.polar || azimuth != table.azimuth) {
        text.fail("tables of different angles in one file are not read");
    }
    return f;
}

void scale(AngleTable& table, std::size_t phi, std::size_t theta, int channel, double factor) {
    const std::size_t begin = table.block(phi, theta, channel);
    for (std::size_t n = begin; n < begin + table.directions(); ++n) table.f[n] *= factor;
}

std::string name_of(const std::string& path) {
    return "file:" + std::filesystem::path(path).filename().string();
}

std::unique_ptr<Bsdf> read_brdf(const std::string& path) {
    TextTokens text(path, kHeadLines);
    read_sides(text, true);
    if (text.count(0, 1) != 1) text.fail("values that are intensities are not read");
    AngleTable table;
    table.azimuth_zero = kPi;
    const int incidences = text.count(1, kMostAngles);
    table.channels = text.count(1, kMaxBsdfChannels);
    table.theta_i = read_degrees(text, incidences);
    const std::vector<double> nm = text.numbers(static_cast<std::size_t>(table.channels));
    const bool rgb = nm == kBlueToRed;
    for (std::size_t c = 0; c < nm.size() && nm.size() > 1 && !rgb; ++c)
        table.channel_names.push_back(fmt::format("{}nm", nm[c]));
    std::vector<double> shares;
    std::vector<std::vector<double>> blocks;
    for (int k = 0; k < incidences * table.channels; ++k) {
        shares.push_back(text.number() / 100);
        blocks.push_back(read_block(text, table));
    }
    // Red comes first in a Bsdf.
    for (std::size_t k = 0; rgb && k < blocks.size(); k += 3) {
        std::swap(blocks[k], blocks[k + 2]);
        std::swap(shares[k], shares[k + 2]);
    }
    for (const std::vector<double>& block : blocks)
        table.f.insert(table.f.end(), block.begin(), block.end());
    for (std::size_t t = 0; t < table.theta_i.size(); ++t)
        for (int c = 0; c < table.channels; ++c) {
            const double integral = integral_of(table, 0, t, c);
            const double share =
                shares[t * static_cast<std::size_t>(table.channels) + static_cast<std::size_t>(c)];
            scale(table, 0, t, c, integral > 0 ? share / integral : 0);
        }
    return make_table_bsdf(std::move(table), name_of(path), path);
}

std::unique_ptr<Bsdf> read_anisotropic(const std::string& path) {
    TextTokens text(path, kHeadLines);
    text.numbers(3);  // the vector that azimuths of the surface are counted from
    read_sides(text, false);
    const bool is_bsdf = text.count(0, 1) == 1;
    AngleTable table;
    table.azimuth_zero = kPi;
    table.phi_i = read_degrees(text, text.count(1, kMostAngles));
    table.theta_i = read_degrees(text, text.count(1, kMostAngles));
    const double theta = radians(text.number()), phi = radians(text.number());
    double share = 0;  // at these angles, mean over the wavelengths
    const int wavelengths = text.count(1, kMostAngles);
    for (int k = 0; k < wavelengths; ++k) {
        text.number();
        share += text.number() / (100 * wavelengths);
    }
    for (std::size_t k = 0; k < table.phi_i.size() * table.theta_i.size(); ++k)
        for (const double value : read_block(text, table)) table.f.push_back(value);
    for (std::size_t n = 0; !is_bsdf && n < table.f.size(); ++n) {
        const double cosine = std::cos(table.polar[n % table.directions() / table.azimuth.size()]);
        table.f[n] /= std::max(cosine, 1e-3);
    }
    const auto nearest = [](const std::vector<double>& angles, double angle) {
        const auto closer = [&](double a, double b) {
            return std::abs(a - angle) < std::abs(b - angle);
        };
        return static_cast<std::size_t>(std::min_element(angles.begin(), angles.end(), closer) -
                                        angles.begin());
    };
    const double integral =
        integral_of(table, nearest(table.phi_i, phi), nearest(table.theta_i, theta), 0);
    if (!(integral > 0)) text.fail("no light where its spectrum was taken");
    for (double& f : table.f) f *= share / integral;
    return make_table_bsdf(std::move(table), name_of(path), path);
}

std::string list(const std::vector<double>& values, bool as_degrees) {
    std::string text;
    for (const double value : values)
        text += fmt::format("{:.6g}\t", as_degrees ? degrees(value) : value);
    return text + "\n";
}

/// f / `unit` of one table.
std::string block_text(const AngleTable& table, std::size_t phi, std::size_t theta, int channel,
                       double unit) {
    const std::size_t columns = table.azimuth.size();
    std::string text = fmt::format("{}\t{}\n\t", table.polar.size(), columns);
    text += list(table.azimuth, true);
    const double* const f = &table.f[table.block(phi, theta, channel)];
    for (std::size_t p = 0; p < table.polar.size(); ++p) {
        text += fmt::format("{:.6g}", degrees(table.polar[p]));
        for (std::size_t a = 0; a < columns; ++a)
            text += fmt::format("\t{:.6g}", f[p * columns + a] / unit);
        text += '\n';
    }
    return text;
}

std::string head_text(const char* title, const ExportSource& source) {
    std::string description;
    for (const std::string& line : source.provenance())
        description += (description.empty() ? "" : "; ") + line;
    return fmt::format("{}\n0\nWritten by Asperity\n{}\n{}\n", title, description.size(),
                       description);
}

AngleTable angles_for(const ExportSource& source, const FormatOptions& options) {
    const double step = options.number("step", 0.1, 30, 2);
    AngleTable table;
    table.azimuth_zero = kPi;
    table.theta_i = table_thetas(source);
    table.polar = even_angles(0, 90, step);
    table.azimuth = even_angles(0, 360, std::max(2.0, step));
    return table;
}

BsdfFormat::Remarks write_brdf(const ExportSource& source, const FormatOptions& options,
                               const std::string& path) {
    AngleTable table = angles_for(source, options);
    if (table.theta_i.size() < 2)
        throw Error(ErrorCode::Usage, "takes two incident angles or more", "format");
    std::vector<double> wavelengths = source.wavelengths_nm();
    const bool guessed = wavelengths.empty();
    if (guessed && source.channels() == 1) wavelengths = {550};
    if (guessed && source.channels() == 3) wavelengths = kBlueToRed;
    if (wavelengths.empty())
        throw Error(ErrorCode::Usage, "the channels have no wavelengths", "format");
    std::vector<std::vector<double>> each(wavelengths.size(),
                                          std::vector<double>(wavelengths.size(), 0.0));
    for (std::size_t c = 0; c < each.size(); ++c) each[c][guessed ? each.size() - 1 - c : c] = 1;
    fill(table, source.isotropic_bsdf(), each, source.threads());
    AtomicFile file(path, source.watched());
    file.write(head_text(kBrdfHead, source) +
               fmt::format("1\t0\n1\n{}\t{}\n", table.theta_i.size(), table.channels));
    file.write(list(table.theta_i, true) + list(wavelengths, false));
    for (std::size_t t = 0; t < table.theta_i.size(); ++t)
        for (int c = 0; c < table.channels; ++c)
            file.write(fmt::format("{:.8g}\n", 100 * integral_of(table, 0, t, c)) +
                       block_text(table, 0, t, c, 1));
    file.write("End of file\n");
    file.commit();
    BsdfFormat::Remarks remarks = {"isotropic: averaged over azimuth and mirrored"};
    if (guessed)
        remarks.emplace_back(source.channels() == 1
                                 ? "the wavelength is not known: 550 nm is written"
                                 : "red, green and blue are written as 650, 550 and 450 nm");
    return remarks;
}

BsdfFormat::Remarks write_anisotropic(const ExportSource& source, const FormatOptions& options,
                                      const std::string& path) {
    AngleTable table = angles_for(source, options);
    if (!source.isotropic()) table.phi_i = source.phis();
    fill(table, source.isotropic() ? source.isotropic_bsdf() : source.bsdf(),
         {source.luminance_weights()}, source.threads());
    const double share = 100 * integral_of(table, 0, 0, 0);
    AtomicFile file(path, source.watched());
    file.write(head_text(kAnisotropicHead, source) + "0\t1\t0\n1\t0\n1\n");
    file.write(fmt::format("{}\n", table.phi_i.size()) + list(table.phi_i, true));
    file.write(fmt::format("{}\n", table.theta_i.size()) + list(table.theta_i, true));
    file.write(fmt::format("{:.6g}\t{:.6g}\n\n2\n350\t{:.8g}\n850\t{:.8g}\n",
                           degrees(table.theta_i[0]), degrees(table.phi_i[0]), share, share));
    for (std::size_t p = 0; p < table.phi_i.size(); ++p)
        for (std::size_t t = 0; t < table.theta_i.size(); ++t)
            file.write(block_text(table, p, t, 0, 1 / kPi));
    file.write("End of file\n");
    file.commit();
    BsdfFormat::Remarks remarks = {"values are pi f; programs take the level from the percentage"};
    if (source.channels() > 1)
        remarks.emplace_back("one table for all wavelengths: the luminance of the channels");
    return remarks;
}

}  // namespace

BsdfFormat speos_brdf_format() {
    return {"speos-brdf",
            {"brdf"},
            "Speos: isotropic, a table an incidence and wavelength",
            {{"step", "2", "degrees between outgoing angles"}},
            write_brdf,
            [](std::string_view head) { return head.starts_with("OPTIS - brdf surface file"); },
            read_brdf};
}

BsdfFormat speos_anisotropic_format() {
    return {"speos-anisotropic",
            {"anisotropicbsdf"},
            "Speos: a table an azimuth and polar angle of the light",
            {{"step", "2", "degrees between outgoing angles"}},
            write_anisotropic,
            [](std::string_view head) {
                return head.starts_with("OPTIS - Anisotropic BSDF surface file");
            },
            read_anisotropic};
}

}  // namespace asperity::io
