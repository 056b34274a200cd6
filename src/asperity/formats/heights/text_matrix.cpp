// SPDX-License-Identifier: Apache-2.0
// Text: rows of numbers, with or without a header that says their scale, or points x y z.
#include <asperity/core/error.h>
#include <asperity/core/parse_number.h>
#include <asperity/formats/atomic_file.h>
#include <asperity/formats/heights/builtin_heights.h>
#include <asperity/formats/heights/height_files.h>
#include <asperity/formats/heights/point_grid.h>
#include <asperity/formats/heights/text_scale.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace asperity::io {
namespace {

constexpr std::string_view kAnnouncement = "AsciiMatrix";
constexpr std::size_t kWriteBytes = 1 << 20;
constexpr std::uint64_t kLongList = 32;  // rows of three numbers that nobody writes as a matrix

// "AsciiMatrix W H"
void check_announcement(const TextTable& table, const HeightsSource& source) {
    if (table.header.empty() || table.header.front().comment) return;
    const TextLine& line = table.header.front();
    if (!line.text.starts_with(kAnnouncement)) return;
    const std::string_view rest = trimmed(std::string_view(line.text).substr(kAnnouncement.size()));
    const std::size_t gap = std::min(rest.find_first_of(" \t"), rest.size());
    const auto width = parse_integer<std::uint64_t>(rest.substr(0, gap));
    const auto height = parse_integer<std::uint64_t>(trimmed(rest.substr(gap)));
    if (!width || !height)
        source.refuse_line(line.number, "AsciiMatrix needs a width and a height");
    if (*width != table.columns || *height != table.rows)
        source.refuse(fmt::format("{} x {} numbers are announced, {} x {} found", *width, *height,
                                  table.columns, table.rows));
}

bool is_announcement(const TextLine& line) {
    return line.text.starts_with(kAnnouncement);
}

Topography plain_matrix(TextTable table, const HeightsSource& source) {
    check_sides(table.columns, table.rows, source.path());
    Topography t;
    t.nx = static_cast<int>(table.columns);
    t.ny = static_cast<int>(table.rows);
    t.heights = std::move(table.numbers);
    for (std::size_t k = 0; k < t.heights.size(); ++k) {
        if (!std::isnan(t.heights[k])) continue;
        t.heights[k] = 0;
        t.mark_missing(k);
    }
    if (table.decimal_comma) t.note("decimal commas");
    return t;
}

void check_size(const TextScale& scale, const Topography& t, const HeightsSource& source) {
    const bool columns_differ = scale.columns && *scale.columns != t.nx;
    const bool rows_differ = scale.rows && *scale.rows != t.ny;
    if (columns_differ || rows_differ)
        source.refuse(fmt::format("the header announces {} x {} numbers, {} x {} are found",
                                  scale.columns.value_or(t.nx), scale.rows.value_or(t.ny), t.nx,
                                  t.ny));
}

void apply_scale(Topography& t, const TextScale& scale, const HeightsSource& source) {
    double dx = scale.dx.value_or(scale.width ? *scale.width / t.nx : 0);
    double dy = scale.dy.value_or(scale.height ? *scale.height / t.ny : 0);
    if (dx == 0) dx = dy;
    if (dy == 0) dy = dx;
    if (dx > 0 && !scale.z)
        source.refuse(
            fmt::format("the header gives a spacing of {}, but no unit of the heights, which may "
                        "be in the same unit or in cells: --format matrix reads the numbers "
                        "alone, --cell-size and --height-scale then decide",
                        length_text(dx)));
    if (scale.z) {
        for (double& h : t.heights) h *= *scale.z;
        if (dx > 0) {
            set_spacing(t, dx, dy, scale.z_text + " from the header", source.path());
        } else {
            set_heights_alone(t, scale.z_text + " from the header");
        }
        return;
    }
    t.assume("no scale in the file: spacing 1 cell, heights in cells");
}

// The first lines of the header that say nothing which was understood.
void note_unread(Topography& t, const std::vector<TextLine>& lines) {
    std::size_t said = 0;
    for (const TextLine& line : lines) {
        if (line.comment && line.text.starts_with("heights:")) continue;
        if (is_announcement(line) || line.text.empty() || ++said > 2) continue;
        t.assume(fmt::format("header line {} is not used: {}", line.number, in_quotes(line.text)));
    }
    if (said > 2) t.assume(fmt::format("{} more header lines are not used", said - 2));
}

// The header lines that hold the names of columns or other words alone.
void check_columns(const TextTable& table, const HeightsSource& source) {
    const bool named = std::any_of(table.header.begin(), table.header.end(), [](const auto& line) {
        return !line.comment && !is_announcement(line);
    });
    if (table.columns == 2 && named)
        source.refuse("two columns with names are a profile, not a surface");
}

PointList points_of(const TextTable& table) {
    PointList points;
    for (std::size_t k = 0; k + 2 < table.numbers.size(); k += 3) {
        points.x.push_back(table.numbers[k]);
        points.y.push_back(table.numbers[k + 1]);
        points.z.push_back(table.numbers[k + 2]);
    }
    return points;
}

Topography point_surface(const TextTable& table, const PointList& points, const PointGrid& grid,
                         const HeightsSource& source) {
    Topography t = on_grid(points, grid, source);
    t.note(fmt::format("a list of {} points x y z on a grid of {} x {}", points.x.size(), grid.nx,
                       grid.ny));
    t.note(fmt::format("spacing {:.6g} x {:.6g}", grid.dx, grid.dy));
    t.note("smallest y on top");
    if (table.decimal_comma) t.note("decimal commas");
    t.assume("x, y and z are in one unit");
    note_unread(t, table.header);
    return t;
}

// Three columns may be a matrix three wide or a list.
std::optional<PointGrid> as_list(const TextTable& table, const PointList& points,
                                 const HeightsSource& source) {
    const auto grid = grid_of(points);
    if (grid || table.rows <= kLongList) return grid;
    source.refuse(
        fmt::format("{} rows of three numbers can be points x y z, which lie on no "
                    "regular grid here, or a matrix three wide: --format matrix takes "
                    "the latter",
                    table.rows));
}

Topography read_text(const HeightsSource& source) {
    TextTable table = read_text_table(source);
    check_announcement(table, source);
    check_columns(table, source);
    if (table.columns == 3) {
        const PointList points = points_of(table);
        if (const auto grid = as_list(table, points, source))
            return point_surface(table, points, *grid, source);
    }
    const TextScale scale = read_text_scale(table.header);
    const std::vector<TextLine> header = std::move(table.header);
    Topography t = plain_matrix(std::move(table), source);
    check_size(scale, t, source);
    apply_scale(t, scale, source);
    t.note("first row on top");
    if (!scale.z)
        note_unread(t, header);
    else
        note_unread(t, scale.not_understood);
    return t;
}

Topography read_matrix(const HeightsSource& source) {
    TextTable table = read_text_table(source);
    check_announcement(table, source);
    const bool header = !table.header.empty() && !is_announcement(table.header.front());
    Topography t = plain_matrix(std::move(table), source);
    t.note("first row on top");
    t.assume(header ? "the numbers alone, whatever the header says: spacing 1 cell"
                    : "no scale in the file: spacing 1 cell, heights in cells");
    return t;
}

Topography read_xyz(const HeightsSource& source) {
    const TextTable table = read_text_table(source);
    if (table.columns != 3)
        source.refuse(fmt::format("points x y z need three columns, not {}", table.columns));
    const PointList points = points_of(table);
    const auto grid = grid_of(points);
    if (!grid) source.refuse(fmt::format("the {} points x y z lie on no regular grid", table.rows));
    return point_surface(table, points, *grid, source);
}

}  // namespace

void write_text_matrix(const Heightfield& surface, const std::string& path) {
    AtomicFile file(path);
    std::string text =
        fmt::format("# heights: {} columns (x), {} rows (y)\n", surface.nx, surface.ny);
    const auto columns = static_cast<std::size_t>(surface.nx);
    for (std::size_t k = 0; k < surface.heights.size(); ++k) {
        text += shortest(surface.heights[k]);
        text += (k + 1) % columns == 0 ? '\n' : ' ';
        if (text.size() < kWriteBytes) continue;
        file.write(text);
        text.clear();
    }
    file.write(text);
    file.commit();
}

HeightsFormat text_format() {
    return {"text",
            {"txt", "csv", "asc", "dat", "xyz"},
            "rows of numbers, with a header that says the scale or none; points x y z on a grid",
            nullptr,
            open_one<read_text>,
            write_text_matrix};
}

HeightsFormat matrix_format() {
    return {"matrix", {}, "rows of numbers whatever a header says", nullptr, open_one<read_matrix>,
            nullptr};
}

HeightsFormat xyz_format() {
    return {"xyz",
            {},
            "points x y z on a regular grid, in any order, with gaps",
            nullptr,
            open_one<read_xyz>,
            nullptr};
}

}  // namespace asperity::io
