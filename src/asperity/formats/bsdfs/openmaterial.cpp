// SPDX-License-Identifier: Apache-2.0
// Look-up table of ASAM OpenMATERIAL 3D: JSON, isotropic, a row a wavelength and pair of
// directions.
#include <asperity/core/directions.h>
#include <asperity/core/error.h>
#include <asperity/formats/atomic_file.h>
#include <asperity/formats/bsdfs/angle_table.h>
#include <asperity/formats/bsdfs/bsdf_format.h>
#include <asperity/formats/read_file.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>
#include <map>

namespace asperity::io {
namespace {

constexpr double kMostTheta = 1.570796, kMostPhi = 6.283185;  ///< as the schema writes them

/// A name that stays the same for the same data, in the form of a UUID: FNV-1a, twice.
std::string uuid_of(const std::vector<std::string>& lines) {
    std::array<std::uint64_t, 2> hash = {0xcbf29ce484222325u, 0x84222325cbf29ce4u};
    for (const std::string& line : lines)
        for (const char c : line)
            for (std::uint64_t& h : hash) h = (h ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
    const std::string digits = fmt::format("{:016x}{:016x}", hash[0], hash[1]);
    return digits.substr(0, 8) + "-" + digits.substr(8, 4) + "-" + digits.substr(12, 4) + "-" +
           digits.substr(16, 4) + "-" + digits.substr(20);
}

/// Of the channels [nm], and what to say when they had to be named.
std::vector<double> wavelengths_of(const ExportSource& source, BsdfFormat::Remarks& remarks) {
    std::vector<double> wavelengths = source.wavelengths_nm();
    if (!wavelengths.empty()) return wavelengths;
    if (source.channels() == 3) {
        remarks.emplace_back("red, green and blue are written as 650, 550 and 450 nm");
        return {650, 550, 450};
    }
    if (source.channels() != 1)
        throw Error(ErrorCode::Usage, "the channels have no wavelengths", "format");
    remarks.emplace_back("the wavelength is not known: 550 nm is written");
    return {550};
}

nlohmann::ordered_json metadata_of(const ExportSource& source, const FormatOptions& options) {
    std::string description;
    for (const std::string& line : source.provenance())
        description += (description.empty() ? "" : "; ") + line;
    const std::string& name = options.text("name");
    return {{"name", name.empty() ? "Simulated surface" : name},
            {"description", description},
            {"uuid", uuid_of(source.provenance())},
            {"materialVersion", "1.0.0"},
            {"openMaterial3dVersion", "1.0.0"},
            {"copyrights", {options.text("copyright")}},
            {"license", options.text("license")},
            {"authors", {options.text("author")}},
            {"sources", source.measurement() ? "simulated" : "model"}};
}

/// All rows of one wavelength [m], of which `first` begins the table.
void write_rows(AtomicFile& file, const AngleTable& table, double wavelength, int channel,
                bool first) {
    for (std::size_t t = 0; t < table.theta_i.size(); ++t)
        for (std::size_t p = 0; p < table.polar.size(); ++p) {
            std::string text;
            for (std::size_t a = 0; a < table.azimuth.size(); ++a) {
                text += fmt::format(
                    "{}[{:.6g},{:.7g},{:.7g},{:.7g},{:.6g}]", first ? "\n" : ",\n", wavelength,
                    std::min(table.theta_i[t], kMostTheta), std::min(table.polar[p], kMostTheta),
                    std::min(table.azimuth[a], kMostPhi),
                    table.f[table.block(0, t, channel) + p * table.azimuth.size() + a]);
                first = false;
            }
            file.write(text);
        }
}

BsdfFormat::Remarks write(const ExportSource& source, const FormatOptions& options,
                          const std::string& path) {
    BsdfFormat::Remarks remarks = {"isotropic: averaged over azimuth and mirrored"};
    const std::vector<double> wavelengths = wavelengths_of(source, remarks);
    const double step = options.number("step", 0.5, 45, 5);
    AngleTable table;
    table.theta_i = table_thetas(source);
    table.polar = even_angles(0, 90, step);
    table.azimuth = even_angles(0, 360 - step, step);
    // Rows stand in the order of rising wavelength.
    std::vector<std::size_t> order(wavelengths.size());
    for (std::size_t k = 0; k < order.size(); ++k) order[k] = k;
    std::sort(order.begin(), order.end(),
              [&](std::size_t a, std::size_t b) { return wavelengths[a] < wavelengths[b]; });
    std::vector<std::vector<double>> each(order.size(), std::vector<double>(order.size(), 0.0));
    for (std::size_t k = 0; k < order.size(); ++k) each[k][order[k]] = 1;
    fill(table, source.isotropic_bsdf(), each, source.threads());

    nlohmann::ordered_json sorted = nlohmann::ordered_json::array();
    for (const std::size_t k : order) sorted.push_back(wavelengths[k] * 1e-9);
    AtomicFile file(path, source.watched());
    file.write("{\"metadata\": " + metadata_of(source, options).dump(2) +
               ",\n\"brdf\": {\"wavelengths\": " + sorted.dump() + ",\n\"lookupTable\": [");
    for (std::size_t k = 0; k < order.size(); ++k)
        write_rows(file, table, wavelengths[order[k]] * 1e-9, static_cast<int>(k), k == 0);
    file.write("\n]}}\n");
    file.commit();
    return remarks;
}

double number_in(const nlohmann::ordered_json& row, std::size_t k, const std::string& path) {
    if (!row.is_array() || row.size() != 5 || !row[k].is_number())
        throw Error(ErrorCode::InvalidInput, "a row of lookupTable is not of five numbers", path);
    return row[k].get<double>();
}

/// Which channel a wavelength [m] is; red, that is the longest, comes first where there are three.
using Channels = std::map<double, std::size_t>;

Channels channels_of(const nlohmann::ordered_json& list, const std::string& path) {
    Channels channels;
    for (const auto& row : list) channels.emplace(number_in(row, 0, path), 0);
    std::size_t next = 0;
    for (auto& [wavelength, channel] : channels)
        channel = channels.size() == 3 ? 2 - next++ : next++;
    return channels;
}

/// Names of the channels; none for a single one, and where they are written for those of a colour.
std::vector<std::string> names_of(const Channels& channels) {
    if (channels.size() == 1) return {};
    std::vector<std::string> names(channels.size());
    for (const auto& [wavelength, channel] : channels)
        names[channel] = fmt::format("{:.6g}nm", 1e9 * wavelength);
    if (names == std::vector<std::string>{"650nm", "550nm", "450nm"}) return {};
    return names;
}

/// Rows of all wavelengths together.
std::vector<AngleRow> rows_of(const nlohmann::ordered_json& list, const Channels& channels,
                              const std::string& path) {
    std::map<std::array<double, 3>, std::vector<double>> values;
    for (const auto& row : list) {
        auto& f =
            values[{number_in(row, 1, path), number_in(row, 2, path), number_in(row, 3, path)}];
        f.resize(channels.size(), std::numeric_limits<double>::quiet_NaN());
        f[channels.at(number_in(row, 0, path))] = number_in(row, 4, path);
    }
    std::vector<AngleRow> rows;
    for (auto& [angles, f] : values) {
        if (std::any_of(f.begin(), f.end(), [](double x) { return std::isnan(x); }))
            throw Error(ErrorCode::InvalidInput, "lacks rows of some wavelength", path);
        rows.push_back({0, angles[0], angles[1], angles[2], std::move(f)});
    }
    return rows;
}

std::unique_ptr<Bsdf> read(const std::string& path) {
    constexpr std::uint64_t kLargest = 1u << 30;
    const auto json = nlohmann::ordered_json::parse(read_text_file(path, kLargest), nullptr, false);
    if (json.is_discarded()) throw Error(ErrorCode::InvalidInput, "is no JSON", path);
    const nlohmann::ordered_json::json_pointer place("/brdf/lookupTable");
    if (!json.is_object() || !json.contains(place) || !json.at(place).is_array())
        throw Error(ErrorCode::InvalidInput, "has no brdf with a lookupTable", path);
    const Channels channels = channels_of(json.at(place), path);
    AngleTable table = table_of_rows(rows_of(json.at(place), channels, path), path);
    table.channel_names = names_of(channels);
    return make_table_bsdf(std::move(table),
                           "file:" + std::filesystem::path(path).filename().string(), path);
}

}  // namespace

BsdfFormat openmaterial_format() {
    return {"openmaterial",
            {"json"},
            "ASAM OpenMATERIAL 3D: look-up table for simulations of sensors, isotropic",
            {{"step", "5", "degrees between outgoing angles and azimuths"},
             {"name", "", "of the material"},
             {"license", "NOASSERTION", "SPDX identifier"},
             {"author", "unknown", "name or company"},
             {"copyright", "not stated", "line of copyright"}},
            write,
            [](std::string_view head) {
                return head.find("\"openMaterial3dVersion\"") != head.npos ||
                       head.find("\"lookupTable\"") != head.npos;
            },
            read};
}

}  // namespace asperity::io
