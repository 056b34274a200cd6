// SPDX-License-Identifier: Apache-2.0
// The settings of a surface: long because they are many.
#include <asperity/surface/surface_params.h>

#include <asperity/core/parse_number.h>
#include <asperity/params/fields.h>
#include <asperity/surface/preparation_params.h>
#include <asperity/surface/surface_kinds.h>
#include <asperity/surface/surface_text.h>

#include <fmt/format.h>

namespace asperity {

namespace {

using S = SurfaceSettings;

constexpr Names<Autocorrelation, 3> kAutocorrelations = {{
    {"gaussian", Autocorrelation::Gaussian},
    {"exponential", Autocorrelation::Exponential},
    {"self-affine", Autocorrelation::SelfAffine},
}};
constexpr Names<Tiling, 4> kTilings = {{
    {"auto", Tiling::Auto},
    {"mirror", Tiling::Mirrored},
    {"periodic", Tiling::Periodic},
    {"finite", Tiling::Finite},
}};
constexpr Names<Boundary, 2> kBoundaries = {{
    {"periodic", Boundary::Periodic},
    {"finite", Boundary::Finite},
}};
constexpr Names<Diagonal, 2> kDiagonals = {{
    {"anti", Diagonal::Anti},
    {"main", Diagonal::Main},
}};

std::string kind_names(std::string_view separator) {
    std::string names;
    for (const SurfaceKind& kind : surface_kinds())
        names += (names.empty() ? "" : std::string(separator)) + kind.name;
    return names;
}

/// The kinds that use a setting, "gaussian, ggx", with files of heights as "files"; nothing where
/// all made surfaces do.
std::string users_of(const std::string& setting, const std::vector<SurfaceKind>& kinds) {
    std::string users;
    if (surface_uses("", setting)) return users;
    const auto add = [&](const std::string& name) { users += (users.empty() ? "" : ", ") + name; };
    for (const SurfaceKind& kind : kinds)
        if (surface_uses(kind.name, setting)) add(kind.name);
    if (surface_uses(kSurfaceFile, setting)) add("files");
    return users;
}

std::string why_unused(const std::string& setting, const S& s) {
    if (surface_uses(s.kind, setting)) return {};
    const std::string who = s.kind == kSurfaceFile ? "a surface read from a file" : s.kind;
    const std::string users = users_of(setting, surface_kinds());
    return who + " does not use it" + (users.empty() ? "" : "; it is for " + users);
}

Param<S> kind_row() {
    Param<S> row;
    row.info = {.name = "surface",
                .metavar = "SPEC|FILE",
                .doc = kind_names(", ") +
                       ", or a file of heights, as instruments write them; settings may follow: "
                       "gaussian:alpha=0.3,size=256"};
    row.get = [](const S& s) { return surface_text(s); };
    row.set = [](S& s, const ParamValue& v) { apply_surface_spec(s, std::get<std::string>(v)); };
    return row;
}

/// A word that helps to read a file; none leaves it to the file.
Param<S> file_row(std::string S::*member, ParamInfo info) {
    info.absent = "auto";
    info.written_where_used = true;
    return {
        std::move(info),
        [member](const S& s) { return (s.*member).empty() ? ParamValue() : ParamValue(s.*member); },
        [member](S& s, const ParamValue& v) {
            const std::string* word = std::get_if<std::string>(&v);
            s.*member = word ? *word : std::string();
        }};
}

Param<S> wavelength_row() {
    const ParamInfo info = {
        .name = "wavelength",
        .metavar = "LENGTH",
        .doc =
            "of the light that is to fall on a surface in metres, as in 633nm: says whether "
            "geometric optics holds; a material's wavelengths are another setting",
        .written_where_used = true};
    return {info, [](const S& s) { return ParamValue(text_of(s.wavelength)); },
            [info](S& s, const ParamValue& v) {
                const auto length = parse_length(std::get<std::string>(v));
                const double metres = length ? in_unit(*length, "m").value_or(0) : 0;
                if (!length || length->unit.empty() || !(metres > 0))
                    refuse(info, in_quotes(std::get<std::string>(v)) +
                                     " is no wavelength with its unit, such as 633nm");
                s.wavelength = *length;
            }};
}

ParamTable<S> shared_rows() {
    constexpr double kSide = kMaxSurfaceSide;
    return {
        field(&S::size, {.name = "size",
                         .label = "Surface Size",
                         .range = {2, kSide},
                         .doc = "samples on a side"}),
        field(&S::roughness, {.name = "roughness",
                              .label = "Surface Roughness",
                              .metavar = "R",
                              .range = kZeroToOne,
                              .doc = "heights are independent and uniform in 0 to 10 R cells"}),
        pair_field(&S::alpha_x, &S::alpha_y,
                   {.name = "alpha",
                    .metavar = "A[,AY]",
                    .range = {1e-4, 100},
                    .doc = "width of the slope distribution (Beckmann's or GGX' alpha) along x and "
                           "y; sqrt(2) times the RMS slope of a Gaussian surface"}),
        pair_field(&S::correlation_x, &S::correlation_y,
                   {.name = "correlation-length",
                    .metavar = "L[,LY]",
                    .unit = "cells",
                    .range = {0.1, kSide},
                    .doc = "distance along x and y at which heights cease to be related"}),
        field(&S::autocorrelation, kAutocorrelations,
              {.name = "autocorrelation",
               .doc = "how neighbouring heights are related: gaussian exp(-r^2/L^2), exponential "
                      "exp(-r/L), or self-affine, of power spectrum 1/(1 + (k L)^2)^(1 + H)"}),
        field(&S::hurst, {.name = "hurst",
                          .label = "Hurst Exponent",
                          .metavar = "H",
                          .range = {0, 1, true},
                          .doc = "Hurst exponent of a self-affine autocorrelation; a small one is "
                                 "jagged"}),
        field(&S::max_slope, {.name = "max-slope",
                              .metavar = "S",
                              .range = {0.01, 1e6},
                              .doc = "steeper facets are cut to this slope"}),
        field(&S::seed,
              {.name = "surface-seed",
               .metavar = "K",
               .doc = "seed of the random heights: another number, another surface of the "
                      "same kind"}),
        field(&S::tilt_deg, {.name = "tilt",
                             .label = "Facet Tilt",
                             .metavar = "D",
                             .unit = "degrees",
                             .range = kBelowHorizon,
                             .doc = "angle of the facets from the horizontal, the steepest ones of "
                                    "ridges"}),
        field(&S::period, {.name = "period",
                           .unit = "cells",
                           .range = {2, kSide},
                           .doc = "cells until the shape repeats; must divide the size"}),
        field(&S::amplitude, {.name = "amplitude",
                              .metavar = "A",
                              .unit = "cells",
                              .range = {0, 1e6},
                              .doc = "height of the wave from its middle"}),
        field(&S::along_y, {.name = "along-y", .doc = "the shape varies along y, not along x"}),
        pair_field(&S::cell_x, &S::cell_y,
                   {.name = "cell-size",
                    .metavar = "C[,CY]",
                    .range = {1e-15, 1e15},
                    .doc = "distance of the samples",
                    .otherwise = "1 cell, or what the file says"}),
        field(&S::height_scale,
              {.name = "height-scale",
               .metavar = "H",
               .range = {-1e9, 1e9},
               .doc = "multiplies the heights, and so the slopes, after all else; "
                      "below zero turns the surface over"}),
        field(
            &S::tiling, kTilings,
            {.name = "tiling",
             .doc = "how a file fills the plane: periodic (it repeats as it is), mirror (made "
                    "periodic by mirroring), finite (a patch with edges) or auto (periodic if the "
                    "file says so or its opposite edges fit, else mirror)"}),
        file_row(&S::file_format, {.name = "format",
                                   .metavar = "NAME",
                                   .doc = "the format, in place of what content and ending say",
                                   .otherwise = "what content and ending say"}),
        file_row(&S::file_channel, {.name = "channel",
                                    .metavar = "NAME|N",
                                    .doc = "of several channels the one to read, see --list",
                                    .otherwise = "the only one"}),
        file_row(&S::file_decimal,
                 {.name = "decimal",
                  .metavar = "NAME",
                  .doc = "point or comma, where the numbers of a text can be read both ways",
                  .otherwise = "as the numbers say"}),
        field(&S::boundary, kBoundaries,
              {.name = "boundary", .doc = "periodic, or finite (a patch with edges)"}),
        field(&S::diagonal, kDiagonals,
              {.name = "diagonal",
               .doc = "how a cell is cut into two triangles: anti (thesis) or main"}),
    };
}

std::string why_no_hurst(const S& s) {
    const std::string why = why_unused("hurst", s);
    if (!why.empty() || s.autocorrelation == Autocorrelation::SelfAffine) return why;
    return fmt::format("the autocorrelation {} does not use it; it is for self-affine",
                       name_of(kAutocorrelations, s.autocorrelation));
}

}  // namespace

ParamTable<S> surface_params() {
    ParamTable<S> table = {kind_row()};
    for (Param<S>& row : shared_rows()) table.push_back(std::move(row));
    append(table, preparation_params(), &S::ready);
    table.push_back(wavelength_row());
    const std::vector<SurfaceKind> kinds = surface_kinds();
    for (const SurfaceKind& kind : kinds)
        table.insert(table.end(), kind.own.begin(), kind.own.end());
    for (Param<S>& row : table) {
        row.info.group = "Surface";
        const std::string name = row.info.name;
        row.info.users = users_of(name, kinds);
        row.unused = [name](const S& s) { return why_unused(name, s); };
        if (name == "hurst") row.unused = why_no_hurst;
    }
    return table;
}

}  // namespace asperity
