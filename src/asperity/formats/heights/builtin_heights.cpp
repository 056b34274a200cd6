// SPDX-License-Identifier: Apache-2.0
#include <asperity/formats/heights/builtin_heights.h>

#include <asperity/formats/heights/height_files.h>
#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <utility>

namespace asperity::io {
namespace {

template <Heightfield (*Read)(const HeightsSource&)>
Topography read_floats(const HeightsSource& source) {
    return as_topography(Read(source));
}

// A format whose reader gives the one surface of the file.
template <Topography (*Read)(const HeightsSource&)>
std::vector<HeightsChannel> open(const HeightsSource& source) {
    Topography t = Read(source);
    if (t.ours)
        t.note("as Asperity wrote it");
    else if (t.unit == "cell" && t.dx == 1 && t.dy == 1)
        t.assume("no scale in the file: spacing 1 cell, heights in cells");
    else
        t.note(t.unit == "m" ? "heights and spacing of " + length_text(t.dx) + " from the header"
                             : fmt::format("spacing {:.6g} from the header, no unit", t.dx));
    return one_surface(std::move(t));
}

bool starts_with_gsf(std::string_view head) {
    return head.starts_with("Gwyddion Simple Field 1.0");
}

bool starts_with_exr(std::string_view head) {
    return head.starts_with("\x76\x2f\x31\x01");
}

bool starts_with_png(std::string_view head) {
    return head.starts_with("\x89PNG\r\n\x1a\n");
}

}  // namespace

std::vector<HeightsChannel> one_surface(Topography topography) {
    const auto t = std::make_shared<const Topography>(std::move(topography));
    return {
        {"heights", static_cast<std::uint64_t>(t->nx), static_cast<std::uint64_t>(t->ny), {}, [t] {
             return *t;
         }}};
}

Topography as_topography(const Heightfield& surface) {
    Topography t;
    t.nx = surface.nx, t.ny = surface.ny;
    t.dx = surface.dx, t.dy = surface.dy;
    t.unit = surface.unit;
    t.name = surface.name;
    t.boundary = surface.boundary;
    t.diagonal = surface.diagonal;
    t.isotropic = surface.isotropic;
    t.heights.assign(surface.heights.begin(), surface.heights.end());
    for (std::size_t k = 0; k < t.heights.size(); ++k) {
        if (!std::isnan(t.heights[k])) continue;
        t.heights[k] = 0;
        t.mark_missing(k);
    }
    return t;
}

HeightsFormat gsf_format() {
    return {
        "gsf",           {"gsf"},        "Gwyddion Simple Field; keeps all we know of a surface",
        starts_with_gsf, open<read_gsf>, write_gsf};
}

HeightsFormat exr_format() {
    return {"exr",
            {"exr"},
            "OpenEXR: the one channel, or colours that are alike",
            starts_with_exr,
            open<read_floats<read_exr_heights>>,
            write_exr_heights};
}

HeightsFormat png_format() {
    return {"png",
            {"png"},
            "PNG: grey or colours that are alike, 8 or 16 bits",
            starts_with_png,
            open<read_floats<read_png_heights>>,
            nullptr};
}

std::vector<HeightsFormat> builtin_heights() {
    return {gsf_format(),      exr_format(),  png_format(),       sdf_format(),       x3p_format(),
            plux_format(),     sur_format(),  gwy_format(),       plu_format(),       opd_format(),
            al3d_format(),     bcr_format(),  mnt_format(),       nanoscope_format(), nms_format(),
            metropro_format(), tmd_format(),  park_tiff_format(), tiff_format(),      npy_format(),
            esri_format(),     spip_format(), text_format(),      matrix_format(),    xyz_format()};
}

}  // namespace asperity::io
