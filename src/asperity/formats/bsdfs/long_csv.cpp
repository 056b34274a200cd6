// SPDX-License-Identifier: Apache-2.0
// A pair of directions a line: plain CSV in degrees, and the VARS form of ASTM E1392 in radians.
// Reads both, tables of goniometers that move in the plane of incidence, and our own layers-csv.
#include <asperity/core/directions.h>
#include <asperity/core/error.h>
#include <asperity/core/parse_number.h>
#include <asperity/formats/atomic_file.h>
#include <asperity/formats/bsdfs/angle_table.h>
#include <asperity/formats/bsdfs/bsdf_format.h>
#include <asperity/formats/bsdfs/in_plane.h>
#include <asperity/formats/read_file.h>

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <optional>

namespace asperity::io {
namespace {

enum class Column { ThetaI, PhiI, ThetaO, PhiO, Value, Ignored };

/// What a heading means; none where it says nothing known. `text`: small letters, no blanks.
std::optional<Column> column_of(const std::string& text) {
    const auto is = [&](std::initializer_list<const char*> names) {
        return std::any_of(names.begin(), names.end(), [&](const char* n) { return text == n; });
    };
    if (is({"theta_i", "theta_in", "thetai", "incident_angle", "aoi", "angle_of_incidence"}))
        return Column::ThetaI;
    if (is({"phi_i", "phi_in", "phii", "incident_azimuth"})) return Column::PhiI;
    if (is({"theta_o", "theta_s", "theta_r", "theta_v", "theta_out", "thetas", "measure_angle",
            "scatter_angle", "viewing_angle"}))
        return Column::ThetaO;
    if (is({"phi_o", "phi_s", "phi_r", "phi_v", "phi_out", "phis", "scatter_azimuth"}))
        return Column::PhiO;
    if (is({"layer", "solid_angle", "wavelength"}) || text.starts_with("stderr_") ||
        text.starts_with("rays_"))
        return Column::Ignored;
    if (is({"f", "brdf", "bsdf", "r", "g", "b"}) || text.starts_with("f_")) return Column::Value;
    if (text.ends_with("nm") && parse_double(text.substr(0, text.size() - 2))) return Column::Value;
    return std::nullopt;
}

/// A heading without blanks and quotes, in small letters; a unit in it sets `unit`.
std::string heading_of(std::string_view text, std::string& unit) {
    std::string name;
    for (char c : text)
        if (c != ' ' && c != '"' && c != '\t')
            name += c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    for (const char* end : {"(deg)", "_deg", "[deg]", "(rad)", "_rad", "[rad]"})
        if (name.ends_with(end)) {
            unit = std::string_view(end).find("deg") != std::string_view::npos ? "deg" : "rad";
            name.resize(name.size() - std::string_view(end).size());
        }
    return name;
}

struct Sheet {
    std::vector<Column> columns;
    std::vector<std::string> wavelengths;  ///< "550nm", of all columns of values, or none
    std::string unit;                      ///< "deg", "rad" or empty
    std::vector<std::vector<double>> rows;
    int row_line = 0;

    bool has(Column wanted) const {
        return std::find(columns.begin(), columns.end(), wanted) != columns.end();
    }
};

class Reader {
  public:
    explicit Reader(const std::string& path) : path_(path) {}

    Sheet read() {
        constexpr std::uint64_t kLargest = 1u << 30;
        const std::string all = read_text_file(path_, kLargest);
        const std::string_view text = without_byte_order_mark(all, path_);
        Sheet sheet;
        int line = 0;
        for (std::size_t at = 0; at < text.size();) {
            const std::size_t end = std::min(text.find('\n', at), text.size());
            const std::string_view row = trimmed(text.substr(at, end - at));
            at = end + 1;
            ++line;
            if (row.empty()) continue;
            if (row.front() == '#') {
                if (row.find("degrees") != row.npos) sheet.unit = "deg";
            } else if (sheet.columns.empty()) {
                read_head(row, sheet, line);
            } else {
                read_row(row, sheet, line);
            }
        }
        if (sheet.rows.empty()) throw Error(ErrorCode::InvalidInput, "has no rows", path_);
        return sheet;
    }

  private:
    [[noreturn]] void fail(int line, const std::string& why) const {
        throw Error(ErrorCode::InvalidInput, why, fmt::format("{}:{}", path_, line));
    }

    /// Lines before the headings are free text in files with VARS.
    void read_head(std::string_view row, Sheet& sheet, int line) const {
        const bool vars = row.starts_with("VARS");
        if (vars) {
            row = trimmed(row.substr(4));
            sheet.unit = "rad";
        }
        std::vector<Column> columns;
        std::vector<std::string> wavelengths;
        std::string unknown;
        for (const std::string_view piece : split(row, ',')) {
            std::string heading = heading_of(piece, sheet.unit);
            const auto column = column_of(heading);
            if (!column) unknown = piece;
            if (heading.starts_with("f_")) heading.erase(0, 2);
            if (column == Column::Value && heading.ends_with("nm")) wavelengths.push_back(heading);
            columns.push_back(column.value_or(Column::Ignored));
        }
        const bool angles = std::count(columns.begin(), columns.end(), Column::ThetaI) == 1 &&
                            std::count(columns.begin(), columns.end(), Column::ThetaO) == 1;
        if (!angles && !vars) return;
        if (!angles) fail(line, "needs one column theta_i and one column theta_o or theta_s");
        if (!unknown.empty()) fail(line, in_quotes(unknown) + " is no heading that is known");
        if (std::find(columns.begin(), columns.end(), Column::Value) == columns.end())
            fail(line, "has no column of values: f, R,G,B or 550nm");
        const auto values = std::count(columns.begin(), columns.end(), Column::Value);
        if (wavelengths.size() == static_cast<std::size_t>(values) && values > 1)
            sheet.wavelengths = std::move(wavelengths);
        sheet.columns = std::move(columns);
    }

    void read_row(std::string_view row, Sheet& sheet, int line) const {
        const std::vector<std::string_view> pieces = split(row, ',');
        if (pieces.size() != sheet.columns.size())
            fail(line, fmt::format("has {} columns, not {}", pieces.size(), sheet.columns.size()));
        std::vector<double> values;
        for (std::size_t k = 0; k < pieces.size(); ++k) {
            const auto value = parse_double(pieces[k]);
            if (!value && sheet.columns[k] != Column::Ignored)
                fail(line, in_quotes(pieces[k]) + " is no number");
            values.push_back(value.value_or(0));
        }
        sheet.rows.push_back(std::move(values));
    }

    std::string path_;
};

bool is_angle(Column column) {
    return column != Column::Value && column != Column::Ignored;
}

/// Whether angles are degrees: said, or larger than radians can be.
bool in_degrees(const Sheet& sheet, const std::string& path) {
    if (!sheet.unit.empty()) return sheet.unit == "deg";
    double largest = 0;
    for (const std::vector<double>& row : sheet.rows)
        for (std::size_t k = 0; k < row.size(); ++k)
            if (is_angle(sheet.columns[k])) largest = std::max(largest, std::abs(row[k]));
    if (largest > 2 * kPi + 1e-3) return true;
    throw Error(ErrorCode::InvalidInput,
                "does not say whether its angles are degrees or radians: name a column "
                "theta_i_deg or theta_i_rad",
                path);
}

/// With phi_o relative to the light.
std::vector<AngleRow> rows_of(const Sheet& sheet, double unit) {
    std::vector<AngleRow> rows;
    for (const std::vector<double>& values : sheet.rows) {
        AngleRow row;
        for (std::size_t k = 0; k < values.size(); ++k) {
            const double angle = values[k] * unit;
            switch (sheet.columns[k]) {
                case Column::ThetaI:
                    row.theta_i = angle;
                    break;
                case Column::PhiI:
                    row.phi_i = angle;
                    break;
                case Column::ThetaO:
                    row.theta_o = angle;
                    break;
                case Column::PhiO:
                    row.phi_o = angle;
                    break;
                case Column::Value:
                    row.f.push_back(values[k]);
                    break;
                case Column::Ignored:
                    break;
            }
        }
        if (row.phi_i != 0) row.phi_o = std::remainder(row.phi_o - row.phi_i, 2 * kPi);
        rows.push_back(std::move(row));
    }
    return rows;
}

std::unique_ptr<Bsdf> read(const std::string& path) {
    const Sheet sheet = Reader(path).read();
    const double unit = in_degrees(sheet, path) ? kPi / 180 : 1;
    const std::string name = "file:" + std::filesystem::path(path).filename().string();
    std::vector<AngleRow> rows = rows_of(sheet, unit);
    if (!sheet.has(Column::PhiO)) {
        if (sheet.has(Column::PhiI))
            throw Error(ErrorCode::InvalidInput, "has phi_i and no phi_o", path);
        return make_in_plane_bsdf(std::move(rows), sheet.wavelengths, name, path);
    }
    AngleTable table = table_of_rows(std::move(rows), path);
    table.channel_names = sheet.wavelengths;
    return make_table_bsdf(std::move(table), name, path);
}

struct Shape {
    AngleTable table;
    std::vector<std::vector<double>> each;
};

Shape shape_of(const ExportSource& source, const FormatOptions& options) {
    const double step = options.number("step", 0.5, 45, 5);
    Shape shape;
    AngleTable& table = shape.table;
    table.theta_i = table_thetas(source);
    if (!source.isotropic()) table.phi_i = source.phis();
    table.polar = even_angles(0, 90, step);
    table.azimuth = even_angles(0, 360 - step, step);
    for (int c = 0; c < source.channels(); ++c) {
        shape.each.emplace_back(static_cast<std::size_t>(source.channels()), 0.0);
        shape.each.back()[static_cast<std::size_t>(c)] = 1;
    }
    fill(table, source.isotropic() ? source.isotropic_bsdf() : source.bsdf(), shape.each,
         source.threads());
    return shape;
}

/// Lines of one incidence and outgoing polar angle; angles times `unit`.
std::string lines_of(const AngleTable& table, double unit, std::size_t p, std::size_t t,
                     std::size_t polar) {
    std::string text;
    for (std::size_t a = 0; a < table.azimuth.size(); ++a) {
        const double phi_o = std::fmod(table.phi_i[p] + table.azimuth[a], 2 * kPi);
        text += fmt::format("{:.8g},{:.8g},{:.8g},{:.8g}", table.theta_i[t] * unit,
                            table.phi_i[p] * unit, table.polar[polar] * unit, phi_o * unit);
        const std::size_t n = polar * table.azimuth.size() + a;
        for (int c = 0; c < table.channels; ++c)
            text += fmt::format(",{:.6g}", table.f[table.block(p, t, c) + n]);
        text += '\n';
    }
    return text;
}

void write_lines(AtomicFile& file, const AngleTable& table, double unit) {
    for (std::size_t p = 0; p < table.phi_i.size(); ++p)
        for (std::size_t t = 0; t < table.theta_i.size(); ++t)
            for (std::size_t polar = 0; polar < table.polar.size(); ++polar)
                file.write(lines_of(table, unit, p, t, polar));
}

BsdfFormat::Remarks write_csv(const ExportSource& source, const FormatOptions& options,
                              const std::string& path) {
    const AngleTable table = shape_of(source, options).table;
    AtomicFile file(path, source.watched());
    for (const std::string& line : source.provenance()) file.write("# " + line + "\n");
    std::string head = "# degrees; f in 1/sr without a cosine\ntheta_i,phi_i,theta_o,phi_o";
    for (const std::string& channel : source.channel_names()) head += ",f_" + channel;
    file.write(head + "\n");
    write_lines(file, table, 180 / kPi);
    file.commit();
    return {};
}

BsdfFormat::Remarks write_astm(const ExportSource& source, const FormatOptions& options,
                               const std::string& path) {
    const AngleTable table = shape_of(source, options).table;
    AtomicFile file(path, source.watched());
    file.write("ASTM E1392-like table of BSDF in 1/sr, angles in radians\n");
    for (const std::string& line : source.provenance()) file.write("# " + line + "\n");
    std::string head = "VARS theta_i,phi_i,theta_s,phi_s";
    for (const std::string& channel : source.channel_names())
        head += "," + (source.channels() == 1 ? "f" : channel);
    file.write(head + "\n");
    write_lines(file, table, 1);
    file.commit();
    return {};
}

const std::vector<FormatOption> kOptions = {
    {"step", "5", "degrees between outgoing angles and azimuths"}};

}  // namespace

BsdfFormat csv_format() {
    return {"csv",
            {"csv"},
            "any program: f at a grid of angles, a line a pair of directions, degrees",
            kOptions,
            write_csv,
            {},
            read};
}

BsdfFormat astm_format() {
    return {"astm",
            {"astm"},
            "ALTA, BSDFProcessor: the same with VARS in radians",
            kOptions,
            write_astm,
            [](std::string_view head) { return head.find("\nVARS ") != head.npos; },
            read};
}

}  // namespace asperity::io
