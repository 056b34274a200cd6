// SPDX-License-Identifier: Apache-2.0
#include <asperity/plots/files/plot_file_params.h>

#include <asperity/params/fields.h>

namespace asperity::plots {

namespace {

constexpr Names<bool, 2> kThemes = {{{"light", false}, {"dark", true}}};

}  // namespace

ParamTable<PlotFileSettings> plot_file_params() {
    using S = PlotFileSettings;
    ParamTable<S> table = {
        field(&S::width, {.name = "width",
                          .unit = "1/96 inch",
                          .range = {120, 8192},
                          .doc = "of the plot: pixels of a screen"}),
        field(&S::height, {.name = "height",
                           .unit = "1/96 inch",
                           .range = {0, 8192},
                           .absent = "auto",
                           .doc = "of the plot; auto: what it fills"}),
        field(&S::font_size, {.name = "font-size",
                              .unit = "1/96 inch",
                              .range = {4, 96},
                              .doc = "of the text; distances and lines follow it"}),
        field(&S::dark, kThemes, {.name = "theme", .doc = "on white paper or for a dark screen"}),
        field(
            &S::scale,
            {.name = "pixels", .range = {0.5, 16}, .doc = ".png: pixels along a unit of --width"}),
    };
    for (Param<S>& row : table) row.info.group = "Files of plots (asperity plot)";
    return table;
}

}  // namespace asperity::plots
