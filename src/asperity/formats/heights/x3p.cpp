// SPDX-License-Identifier: Apache-2.0
// X3P (ISO 5436-2, ISO 25178-72): a ZIP archive of main.xml and, mostly, binary data. What files
// from the field write otherwise than the standard is taken and said: folders, other root names,
// revisions, checksums of another file.
#include <asperity/formats/heights/builtin_heights.h>
#include <asperity/formats/heights/grid_reader.h>
#include <asperity/formats/heights/point_grid.h>
#include <asperity/formats/heights/x3p_document.h>

#include <cmath>
#include <limits>
#include <optional>

namespace asperity::io {
namespace {

bool recognises(std::string_view head) {
    return is_zip(head) && (head.find("main.xml") != std::string_view::npos ||
                            head.find("bindata/") != std::string_view::npos);
}

// Coordinates and z of each point, from the binary file or the <Datum> elements. An incremental
// axis that is not stored counts the columns or rows of the matrix.
PointList read_points(const X3pDocument& x3p, const HeightsSource& source) {
    const std::size_t count = static_cast<std::size_t>(x3p.points());
    const std::size_t per_point = 1u + (x3p.x.absolute ? 1u : 0u) + (x3p.y.absolute ? 1u : 0u);
    const X3pNumbers numbers = x3p.numbers(per_point);
    PointList points;
    for (auto* axis : {&points.x, &points.y, &points.z}) axis->resize(count);
    const int rows = static_cast<int>(x3p.rows());
    const std::size_t columns = count / static_cast<std::size_t>(rows);
    source.for_each_row(rows, [&](int j) {
        for (std::size_t i = 0; i < columns; ++i) {
            const std::size_t k = static_cast<std::size_t>(j) * columns + i;
            std::size_t item = 0;
            const auto next = [&](const X3pAxis& axis, double index) {
                const double raw = axis.absolute ? numbers.at(k, item++) : index;
                return raw * axis.increment + axis.offset;
            };
            points.x[k] = next(x3p.x, static_cast<double>(i));
            points.y[k] = next(x3p.y, j);
            const double raw = numbers.at(k, per_point - 1);
            points.z[k] = x3p.valid(k) ? raw * x3p.z.increment + x3p.z.offset
                                       : std::numeric_limits<double>::quiet_NaN();
        }
    });
    return points;
}

// A matrix on incremental axes: the rows are the rows of the picture.
Topography matrix(const X3pDocument& x3p, PointList points, const HeightsSource& source) {
    Topography t = empty_topography(x3p.nx, x3p.ny, source.path());
    t.heights = std::move(points.z);
    for (std::size_t k = 0; k < t.heights.size(); ++k) {
        if (std::isfinite(t.heights[k])) continue;
        t.mark_missing(k);
        t.heights[k] = 0;
    }
    set_spacing(t, x3p.x.increment, x3p.y.increment, "m, as the standard has it", source.path());
    t.note("first row on top");
    return t;
}

// Points whose coordinates are missing as well leave gaps.
void drop_placeless(PointList& points) {
    std::size_t kept = 0;
    for (std::size_t k = 0; k < points.x.size(); ++k) {
        if (!std::isfinite(points.x[k]) || !std::isfinite(points.y[k])) continue;
        points.x[kept] = points.x[k], points.y[kept] = points.y[k], points.z[kept] = points.z[k];
        ++kept;
    }
    for (auto* axis : {&points.x, &points.y, &points.z}) axis->resize(kept);
}

Topography points_on_grid(PointList points, const HeightsSource& source) {
    drop_placeless(points);
    const auto grid = grid_of(points);
    if (!grid)
        source.refuse(fmt::format("the {} points with x and y of their own lie on no regular grid",
                                  points.x.size()));
    Topography t = on_grid(points, *grid, source);
    const double dx = t.dx, dy = t.dy;
    set_spacing(t, dx, dy, "m, as the standard has it", source.path());
    t.note("points put on their grid, smallest y on top");
    return t;
}

Topography read(const HeightsSource& source) {
    const X3pDocument x3p(source);
    PointList points = read_points(x3p, source);
    Topography t = x3p.x.absolute || x3p.y.absolute || x3p.list
                       ? points_on_grid(std::move(points), source)
                       : matrix(x3p, std::move(points), source);
    for (const std::string& remark : x3p.remarks) t.assume(remark);
    return t;
}

std::vector<HeightsChannel> open(const HeightsSource& source) {
    const X3pDocument x3p(source);
    const std::string other = x3p.feature == "PRF" ? "a profile" : "";
    return {{"heights", x3p.nx, x3p.ny, other, [source] { return read(source); }}};
}

}  // namespace

HeightsFormat x3p_format() {
    return {"x3p",      {"x3p"}, "X3P (ISO 25178-72): one layer of a surface",
            recognises, open,    nullptr};
}

}  // namespace asperity::io
