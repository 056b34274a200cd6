// SPDX-License-Identifier: Apache-2.0
// Tabular BSDF of OpticStudio: polar angles around the mirror direction, azimuth 0 towards the
// normal.
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

constexpr int kMostAngles = 4096;
constexpr std::array kTristimulus = {"TristimulusX", "TristimulusY", "TristimulusZ"};

std::vector<double> read_angles(TextTokens& text) {
    const int count = text.count(1, kMostAngles);
    std::vector<double> angles = text.numbers(static_cast<std::size_t>(count));
    for (double& angle : angles) angle = radians(angle);
    return angles;
}

/// The blocks of one channel: rows of an azimuth each.
void read_data(TextTokens& text, AngleTable& table, int channel) {
    if (!text.take("DataBegin")) text.fail("there is no DataBegin");
    for (std::size_t p = 0; p < table.phi_i.size(); ++p)
        for (std::size_t t = 0; t < table.theta_i.size(); ++t) {
            // The light that is scattered in all: may exceed the integral of the table.
            if (text.take("TIS")) text.number();
            double* const f = &table.f[table.block(p, t, channel)];
            for (std::size_t a = 0; a < table.azimuth.size(); ++a)
                for (std::size_t r = 0; r < table.polar.size(); ++r)
                    f[r * table.azimuth.size() + a] = text.number();
        }
    if (!text.take("DataEnd")) text.fail("there is more before DataEnd than the angles announce");
}

void to_rgb(AngleTable& table) {
    for (std::size_t b = 0; b < table.phi_i.size() * table.theta_i.size(); ++b)
        for (std::size_t n = 0; n < table.directions(); ++n) {
            std::array<double*, 3> f{};
            for (std::size_t c = 0; c < 3; ++c)
                f[c] = &table.f[(3 * b + c) * table.directions() + n];
            const std::array<double, 3> rgb = rgb_of_xyz({*f[0], *f[1], *f[2]});
            for (std::size_t c = 0; c < 3; ++c) *f[c] = rgb[c];
        }
}

AngleTable read_header(TextTokens& text) {
    AngleTable table;
    table.frame = AngleFrame::Specular;
    for (;;) {
        const std::string word(text.peek());
        if (word == "Monochrome" || word == kTristimulus[0]) return table;
        text.word();
        if (word == "Symmetry") {
            const std::string_view kind = text.word();
            table.mirrored = kind == "PlaneSymmetrical";
            if (!table.mirrored && kind != "Asymmetrical" && kind != "ASymmetrical4D")
                text.fail("the symmetry is none of PlaneSymmetrical, Asymmetrical, ASymmetrical4D");
        } else if (word == "SpectralContent") {
            table.channels = text.word() == "XYZ" ? 3 : 1;
        } else if (word == "ScatterType") {
            if (text.word() != "BRDF") text.fail("is of transmitted light, which is not read");
        } else if (word == "SampleRotation") {
            table.phi_i = read_angles(text);
        } else if (word == "AngleOfIncidence") {
            table.theta_i = read_angles(text);
        } else if (word == "ScatterAzimuth") {
            table.azimuth = read_angles(text);
        } else if (word == "ScatterRadial") {
            table.polar = read_angles(text);
        } else if (word != "Source") {
            text.fail("a key that is not known");
        } else {
            text.word();
        }
    }
}

std::unique_ptr<Bsdf> read(const std::string& path) {
    TextTokens text(path);
    AngleTable table = read_header(text);
    constexpr std::size_t kMostValues = 1u << 28;
    if (table.directions() == 0 || table.theta_i.empty() || table.size() > kMostValues)
        text.fail("the angles are not all given");
    table.f.assign(table.size(), 0.0);
    for (int c = 0; c < table.channels; ++c) {
        const std::string name = table.channels == 1 ? "Monochrome" : kTristimulus[std::size_t(c)];
        if (!text.take(name)) text.fail("there is no " + name);
        read_data(text, table, c);
    }
    if (table.channels == 3) to_rgb(table);
    return make_table_bsdf(std::move(table),
                           "file:" + std::filesystem::path(path).filename().string(), path);
}

std::string angles_text(const char* name, const std::vector<double>& angles) {
    std::string text = fmt::format("{} {}\r\n", name, angles.size());
    for (const double angle : angles) text += fmt::format("{:.6g}\t", degrees(angle));
    text.back() = '\r';
    return text + "\n";
}

/// Line by line: a table may be a hundred megabytes, and who asks to stop need not wait for it.
void write_data(AtomicFile& file, const AngleTable& table, int channel) {
    file.write("DataBegin\r\n");
    for (std::size_t p = 0; p < table.phi_i.size(); ++p)
        for (std::size_t t = 0; t < table.theta_i.size(); ++t) {
            file.write(fmt::format("TIS {:.6g}\r\n", integral_of(table, p, t, channel)));
            const double* const f = &table.f[table.block(p, t, channel)];
            for (std::size_t a = 0; a < table.azimuth.size(); ++a) {
                std::string line;
                for (std::size_t r = 0; r < table.polar.size(); ++r)
                    line += fmt::format("{:.4E}{}", f[r * table.azimuth.size() + a],
                                        r + 1 < table.polar.size() ? "\t" : "\r\n");
                file.write(line);
            }
        }
    file.write("DataEnd\r\n");
}

BsdfFormat::Remarks write(const ExportSource& source, const FormatOptions& options,
                          const std::string& path) {
    const double step = options.number("step", 0.1, 30, 2);
    AngleTable table;
    table.frame = AngleFrame::Specular;
    table.mirrored = source.isotropic();
    table.theta_i = table_thetas(source);
    if (!source.isotropic()) table.phi_i = source.phis();
    // Finer about the mirror direction, where the peak is.
    for (double r = 0; r < 5 * step - 1e-9; r += 0.25 * step) table.polar.push_back(radians(r));
    for (double r = 5 * step; r < 180; r += step) table.polar.push_back(radians(r));
    table.azimuth = even_angles(0, table.mirrored ? 180 : 360, std::max(5.0, step));
    const bool colour = source.channels() == 3;
    fill(table, source.isotropic() ? source.isotropic_bsdf() : source.bsdf(),
         tristimulus_or_luminance(source), source.threads());
    AtomicFile file(path, source.watched());
    for (const std::string& line : source.provenance()) file.write("#" + line + "\r\n");
    file.write(fmt::format(
        "Source  Measured\r\nSymmetry  {}\r\nSpectralContent  {}\r\n"
        "ScatterType  BRDF\r\n",
        table.mirrored ? "PlaneSymmetrical" : "Asymmetrical", colour ? "XYZ" : "Monochrome"));
    file.write(angles_text("SampleRotation ", table.phi_i));
    file.write(angles_text("AngleOfIncidence ", table.theta_i));
    file.write(angles_text("ScatterAzimuth", table.azimuth));
    file.write(angles_text("ScatterRadial", table.polar) + "\r\n");
    for (int c = 0; c < table.channels; ++c) {
        file.write(std::string(colour ? kTristimulus[std::size_t(c)] : "Monochrome") + "\r\n");
        write_data(file, table, c);
    }
    file.commit();
    BsdfFormat::Remarks remarks = {
        "polar angles are around the mirror direction; what lies below "
        "the surface is 0"};
    if (table.phi_i.size() > 1)
        remarks.emplace_back("SampleRotation is the azimuth of the light; old programs take one");
    if (std::filesystem::path(path).filename().string().size() > 60)
        remarks.emplace_back("OpticStudio takes names of at most 60 characters");
    if (source.channels() > 1 && !colour) remarks.emplace_back("the channels are averaged");
    return remarks;
}

}  // namespace

BsdfFormat zemax_format() {
    return {"zemax",
            {"bsdf"},
            "OpticStudio: tabular BSDF around the mirror direction",
            {{"step", "2", "degrees between polar angles, four times finer at the peak"}},
            write,
            [](std::string_view head) {
                return head.find("AngleOfIncidence") != head.npos &&
                       head.find("ScatterAzimuth") != head.npos;
            },
            read};
}

}  // namespace asperity::io
