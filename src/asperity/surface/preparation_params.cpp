// SPDX-License-Identifier: Apache-2.0
#include <asperity/surface/preparation_params.h>

#include <asperity/core/parse_number.h>
#include <asperity/params/fields.h>
#include <asperity/surface/heightfield.h>

#include <fmt/format.h>

#include <array>

namespace asperity {

namespace {

using P = Preparation;

constexpr Names<Fill, 4> kFills = {{
    {"auto", Fill::Auto},
    {"none", Fill::None},
    {"nearest", Fill::Nearest},
    {"smooth", Fill::Smooth},
}};
constexpr Names<Level, 6> kLevels = {{
    {"auto", Level::Auto},
    {"none", Level::None},
    {"mean", Level::Mean},
    {"plane", Level::Plane},
    {"order2", Level::Order2},
    {"order3", Level::Order3},
}};

/// A length from 0 on: with its unit, or in that of the surface.
Length length_of(const ParamInfo& info, std::string_view text) {
    const auto length = parse_length(text);
    if (!length) refuse(info, in_quotes(text) + " is no length such as 2.5um");
    if (length->value < 0) refuse(info, in_quotes(text) + " is below 0");
    return *length;
}

Param<P> cutoff_row(std::optional<Length> P::*member, ParamInfo info) {
    info.metavar = "LENGTH";
    info.absent = "none";
    return {info,
            [member](const P& p) {
                return p.*member ? ParamValue(text_of(*(p.*member))) : ParamValue();
            },
            [member, info](P& p, const ParamValue& v) {
                const auto* text = std::get_if<std::string>(&v);
                if (text == nullptr)
                    (p.*member).reset();
                else
                    p.*member = length_of(info, *text);
            }};
}

Crop crop_of(const ParamInfo& info, std::string_view text) {
    const std::vector<std::string_view> parts = split(text, ',');
    if (parts.size() != 4) refuse(info, in_quotes(text) + " is not x,y,width,height");
    std::array<Length, 4> all;
    for (std::size_t k = 0; k < 4; ++k) all[k] = length_of(info, parts[k]);
    for (Length& length : all)
        if (length.unit.empty()) length.unit = all[3].unit;
    return {all[0], all[1], all[2], all[3]};
}

Param<P> crop_row() {
    const ParamInfo info = {
        .name = "crop",
        .metavar = "X,Y,W,H",
        .absent = "none",
        .doc =
            "a part of W x H, X from the left and Y from the top: 10,10,50,50um; one unit "
            "after the last counts for all"};
    return {info,
            [](const P& p) {
                if (!p.crop) return ParamValue();
                return ParamValue(fmt::format("{},{},{},{}", text_of(p.crop->x), text_of(p.crop->y),
                                              text_of(p.crop->width), text_of(p.crop->height)));
            },
            [info](P& p, const ParamValue& v) {
                const auto* text = std::get_if<std::string>(&v);
                if (text == nullptr)
                    p.crop.reset();
                else
                    p.crop = crop_of(info, *text);
            }};
}

Param<P> resample_row() {
    return field(&P::resample,
                 {.name = "resample",
                  .range = {2, kMaxSurfaceSide},
                  .absent = "none",
                  .doc = "samples along x; along y as many as keep the shape of a "
                         "cell: means over the new cells of the lines between the old "
                         "ones"});
}

}  // namespace

ParamTable<P> preparation_params() {
    ParamTable<P> table = {
        field(&P::outliers,
              {.name = "outliers",
               .metavar = "SIGMA",
               .range = {0, 1e6},
               .doc = "points further than SIGMA deviations from the median of the 5 x 5 points "
                      "around them are filled like missing ones; 0 keeps all"}),
        field(&P::fill, kFills,
              {.name = "fill",
               .doc = "missing points: none (they are refused), nearest (the nearest measured "
                      "height), smooth (a film over the hole) or auto (smooth up to 5 % missing, "
                      "else refused)"}),
        field(&P::level, kLevels,
              {.name = "level",
               .doc = "form taken off by least squares: none, mean, plane, order2, order3 "
                      "(polynomials) or auto (plane for heights in a unit of length, but for files "
                      "that Asperity wrote; else none)"}),
        cutoff_row(&P::filter_s,
                   {.name = "filter-s",
                    .doc = "cut-off of the S-filter (Gaussian, ISO 16610-61), as in 2.5um: waves "
                           "shorter than that are taken off"}),
        cutoff_row(&P::filter_l,
                   {.name = "filter-l",
                    .doc = "cut-off of the L-filter (Gaussian, ISO 16610-61), as in 0.8mm: waves "
                           "longer than that are taken off"}),
        crop_row(),
        resample_row(),
    };
    for (Param<P>& row : table) row.info.written_where_used = true;
    return table;
}

}  // namespace asperity
