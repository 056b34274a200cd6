// SPDX-License-Identifier: Apache-2.0
#include <asperity/plots/plot_kinds.h>

#include <asperity/core/error.h>
#include <asperity/plots/figures.h>
#include <fmt/format.h>

#include <algorithm>

namespace asperity::plots {

const std::vector<PlotKind>& plot_kinds() {
    static const std::vector<PlotKind> kKinds = {
        {.name = "lobe",
         .doc = "the BRDF in a plane",
         .settings = {"axes", "decades", "theta", "layer", "phi", "plane", "average", "no-errors",
                      "channel"},
         .make = detail::lobe_figure},
        {.name = "lobe3d",
         .doc = "the goniometric solid",
         .settings = {"decades", "theta", "layer", "phi", "average", "channel", "colour-map",
                      "camera-azimuth", "camera-elevation"},
         .make = detail::solid_figure},
        {.name = "hemisphere",
         .doc = "the BRDF over all directions, from above",
         .usually_log = true,
         .settings = {"decades", "theta", "layer", "phi", "average", "channel", "colour-map"},
         .make = detail::hemisphere_figure},
        {.name = "albedo",
         .doc = "the reflected share over the angle of incidence",
         .settings = {"decades", "phi", "no-errors", "channel"},
         .make = detail::albedo_figure},
        {.name = "normals",
         .doc = "how the facets of surfaces are tilted",
         .of_surfaces = true,
         .settings = {"decades"},
         .make = detail::normals_figure},
        {.name = "profile",
         .doc = "the heights of surfaces along a line",
         .of_surfaces = true,
         .settings = {"along", "at"},
         .make = detail::profile_figure},
        {.name = "psd",
         .doc = "the power spectral density of surfaces",
         .of_surfaces = true,
         .usually_log = true,
         .make = detail::psd_figure},
    };
    return kKinds;
}

const PlotKind* find_plot_kind(std::string_view name) {
    for (const PlotKind& kind : plot_kinds())
        if (kind.name == name) return &kind;
    return nullptr;
}

bool uses(const PlotKind& kind, std::string_view setting) {
    if (setting == "kind" || setting == "title") return true;
    if (setting == "scale") return kind.name != "profile";
    return std::find(kind.settings.begin(), kind.settings.end(), setting) != kind.settings.end();
}

std::shared_ptr<const Plot> make_plot(const std::vector<PlotSubject>& subjects,
                                      const PlotSettings& settings, Run& run) {
    check(settings);
    const PlotKind& kind = *find_plot_kind(settings.kind);
    if (subjects.empty()) throw Error(ErrorCode::Usage, "there is nothing to plot");
    for (const PlotSubject& subject : subjects)
        if (kind.of_surfaces != (subject.surface != nullptr))
            throw Error(ErrorCode::Usage,
                        fmt::format("--kind {} is made of {}", kind.name,
                                    kind.of_surfaces ? "surfaces" : "results and models"),
                        subject.name);
    return kind.make(subjects, settings, run);
}

}  // namespace asperity::plots
