// SPDX-License-Identifier: Apache-2.0
// asperity gloss: the glossmeter of a paint shop over a surface.
#include "console.h"
#include "file_kind.h"
#include "help.h"
#include "options.h"
#include "progress.h"
#include "report.h"
#include "report_json.h"
#include "stop.h"
#include "table.h"
#include "verbs.h"

#include <asperity/core/directions.h>
#include <asperity/core/error.h>
#include <asperity/core/parse_number.h>
#include <asperity/formats/heights/surface_files.h>
#include <asperity/instruments/glossmeter.h>
#include <asperity/surface/geometric_optics.h>

#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <optional>

namespace asperity::cli {

namespace {

constexpr const char* kGlossClosing =
    "Light from the source's aperture falls on the surface, is followed from facet to facet and\n"
    "counts where it leaves into the receptor's, as ISO 2813 and ASTM D523 have them: 100 gloss\n"
    "units are what polished glass of index 1.567 sends there. At 20 degrees also the haze of ISO\n"
    "13803, and of a dielectric read at 20 and 60 degrees the haze index of ASTM D4039. The\n"
    "reflectance is that over all directions. Errors are standard errors of the rays; a small\n"
    "surface differs from its like by more.\n"
    "\n"
    "--doi adds the distinctness of image of ASTM E430 and D5767: 100 (1 - R_aside / R_mirror),\n"
    "receptors in the mirror direction and 0.3 degrees from it. Its value hangs on how wide\n"
    "source and receptors are, so your instrument's widths must be told.\n"
    "\n"
    "Examples\n"
    "  asperity gloss --surface gaussian --alpha 0.05 --ior 1.5\n"
    "  asperity gloss --surface measured.sur --material Al --until 1%\n"
    "  asperity gloss --surface ggx --alpha 0.1 --ior 1.5 --geometry 60 --all-azimuths --json\n"
    "  asperity gloss --surface gaussian --alpha 0.002 --ior 1.5 --doi 0.14\n";

/// What rays do not know, of a surface in metres.
struct Interference {
    double wavelength = 0, rms_height = 0;
    std::string verdict;
};

std::string figure_text(const WithError& figure) {
    // Where no ray came, nothing is known of the error either
    if (figure.value == 0 && figure.error == 0) return "0 (no ray)";
    return cli::with_error(figure.value, figure.error);
}

Json json_of(const std::vector<WithError>& figures) {
    Json json = {{"value", Json::array()}, {"stderr", Json::array()}};
    for (const WithError& figure : figures) {
        json["value"].push_back(figure.value);
        json["stderr"].push_back(figure.error);
    }
    return json;
}

class GlossVerb {
  public:
    explicit GlossVerb(CLI::App& app) {
        experiment_.add_to(app, {kSurface, kFacets, kRun}, true);
        threads_.add_to(app);
        geometry_ = add_text(app, "--geometry", "D[,D...]", "angles of the instrument: 20, 60, 85",
                             kDetector)
                        ->default_str("20,60,85");
        azimuth_ = add_text(app, "--azimuth", "D",
                            "azimuth the light comes from: the instrument turned on the surface "
                            "[degrees]",
                            kDetector)
                       ->default_str("0");
        app.add_flag(
               "--all-azimuths", all_azimuths_,
               "each ray from an azimuth of its own, as for a surface that is alike all round")
            ->group(kDetector);
        doi_ = add_text(app, "--doi", "D[,D]",
                        "distinctness of image: widths of source and receptors in the plane of "
                        "incidence [degrees]; one for both",
                        kDetector);
        doi_angle_ = add_text(app, "--doi-angle", "D", "angle of the DOI [degrees]", kDetector)
                         ->default_str("30");
        app.add_flag("--json", json_, "print one JSON object and nothing else")->group(kOutput);
        app.add_flag("--quiet", quiet_, "print nothing but errors")->group(kOutput);
        set_help(app, "gloss --surface SPEC|FILE [--material NAME | --ior N] [options]",
                 kGlossClosing);
    }

    int run() {
        const Experiment experiment = experiment_.read();
        if (experiment.surface.kind == kSurfaceFile)
            require_kind(experiment.surface.file, FileKind::Heights);
        GlossSettings settings = read_settings(experiment);
        Run run(threads_.threads());
        const Talk say(quiet_, json_);
        const StopOnSignal stop(run);
        ProgressBar progress(run, quiet_);

        const Heightfield patch = io::load_patch(experiment.surface, run);
        const Heightfield surface = io::tiled(patch, experiment.surface);
        const GlossReport report = measure_gloss(surface, experiment.optics, settings, run);
        progress.clear();
        if (report.readings.empty())
            throw Error(ErrorCode::Stopped, "stopped before anything was complete");
        const auto interference = interference_of(experiment.surface, patch, run);
        if (json_) write_json(to_json(report, surface, interference));
        if (!json_) tell(say, report, experiment, surface, interference);
        return report.stopped ? static_cast<int>(ErrorCode::Stopped) : 0;
    }

  private:
    static double number(const char* name, std::string_view text) {
        const auto value = parse_double(text);
        if (!value) throw Error(ErrorCode::Usage, in_quotes(text) + " is not a number", name);
        return *value;
    }

    GlossSettings read_settings(const Experiment& experiment) const {
        GlossSettings settings;
        settings.run = experiment.run;
        if (geometry_->count() > 0) {
            settings.angles_deg.clear();
            for (const std::string_view part : split(text_of(geometry_), ','))
                settings.angles_deg.push_back(number("geometry", part));
        }
        for (const double angle : settings.angles_deg) standard_gloss_geometry(angle);
        if (azimuth_->count() > 0) {
            if (all_azimuths_)
                throw Error(ErrorCode::Usage, "it has no effect with --all-azimuths", "azimuth");
            settings.azimuth_deg = number("azimuth", text_of(azimuth_));
        }
        settings.all_azimuths = all_azimuths_;
        settings.doi = read_doi();
        return settings;
    }

    DoiSettings read_doi() const {
        DoiSettings doi;
        if (doi_->count() == 0) {
            if (doi_angle_->count() > 0)
                throw Error(ErrorCode::Usage, "it has no effect without --doi", "doi-angle");
            return doi;
        }
        const auto widths = split(text_of(doi_), ',');
        if (widths.size() > 2)
            throw Error(ErrorCode::Usage, "it takes one or two widths: source, receptors", "doi");
        doi.source_deg = number("doi", widths.front());
        doi.receptor_deg = number("doi", widths.back());
        if (doi_angle_->count() > 0) doi.angle_deg = number("doi-angle", text_of(doi_angle_));
        doi_geometry(doi);
        return doi;
    }

    static std::optional<Interference> interference_of(const SurfaceSettings& settings,
                                                       const Heightfield& patch, Run& run) {
        if (patch.unit != "m" || run.stop_requested()) return std::nullopt;
        const double wavelength = in_unit(settings.wavelength, "m").value_or(0);
        const GeometricOptics optics = geometric_optics(patch, wavelength, run);
        return Interference{wavelength, optics.rms_height * wavelength, optics.verdict};
    }

    static double scatter(const Interference& waves, const GlossReading& reading) {
        return total_integrated_scatter(waves.rms_height, waves.wavelength,
                                        radians(reading.geometry.angle_deg));
    }

    static void tell(const Talk& say, const GlossReport& report, const Experiment& experiment,
                     const Heightfield& surface, const std::optional<Interference>& waves) {
        say(fmt::format("{}, {} x {} samples\n", kind_name(experiment.surface), surface.nx,
                        surface.ny));
        const std::string tiling = tiling_line(experiment.surface, surface);
        if (!tiling.empty()) say(tiling + "\n");
        if (!surface.source.empty()) say(surface.source + "\n");
        if (!surface.prepared.empty()) say("made ready: " + surface.prepared + "\n");
        std::vector<std::string> heads = {"geometry", "channel", "gloss [GU]", "haze",
                                          "reflectance"};
        if (waves) heads.push_back("TIS");
        Table table(heads);
        for (const GlossReading& r : report.readings)
            for (std::size_t c = 0; c < r.gloss.size(); ++c) {
                std::vector<std::string> row = {fmt::format("{}°", r.geometry.angle_deg),
                                                report.channel_names[c], figure_text(r.gloss[c]),
                                                r.haze.empty() ? "" : figure_text(r.haze[c]),
                                                figure_text(r.reflectance[c])};
                if (waves) row.push_back(fmt::format("{:.4g}", scatter(*waves, r)));
                table.add(row);
            }
        say(table.text());
        for (const GlossReading& r : report.readings) {
            if (r.truncated > 1e-3 || r.edge > 0)
                say(
                    fmt::format("note: at {}° {:.3g} % of the light was truncated, {:.3g} % left "
                                "through the side of the patch\n",
                                r.geometry.angle_deg, 100 * r.truncated, 100 * r.edge));
        }
        for (std::size_t c = 0; c < report.haze_index.size(); ++c)
            say(fmt::format("haze index of ASTM D4039 ({}), gloss at 60° less that at 20°: {}\n",
                            report.channel_names[c], figure_text(report.haze_index[c])));
        tell_doi(say, report);
        for (const std::string& note : report.notes) say("note: " + note + "\n");
        if (waves)
            say("TIS: share of the reflected light that interference alone scatters, at " +
                length_text(waves->wavelength) + "\n" + waves->verdict + "\n");
    }

    static void tell_doi(const Talk& say, const GlossReport& report) {
        if (!report.doi) return;
        const GlossGeometry& geometry = report.doi->geometry;
        for (std::size_t c = 0; c < report.doi->doi.size(); ++c)
            say(fmt::format("DOI at {}° ({}), source {}° and receptors {}° wide: {}\n",
                            geometry.angle_deg, report.channel_names[c], geometry.source.in_plane,
                            geometry.receptor.in_plane, figure_text(report.doi->doi[c])));
    }

    static Json to_json(const DoiReading& doi) {
        Json json =
            doi.doi.empty() ? Json{{"value", nullptr}, {"stderr", nullptr}} : json_of(doi.doi);
        json["angle_deg"] = doi.geometry.angle_deg;
        json["source_deg"] = doi.geometry.source.in_plane;
        json["receptor_deg"] = doi.geometry.receptor.in_plane;
        json["rays"] = doi.rays;
        return json;
    }

    static Json to_json(const GlossReport& report, const Heightfield& surface,
                        const std::optional<Interference>& waves) {
        Json json;
        json["surface"] = surface.name;
        if (!surface.source.empty()) json["source"] = surface.source;
        if (!surface.prepared.empty()) json["prepared"] = surface.prepared;
        json["channels"] = report.channel_names;
        json["stopped"] = report.stopped;
        json["notes"] = report.notes;
        json["haze_index"] = nullptr;
        if (!report.haze_index.empty()) json["haze_index"] = json_of(report.haze_index);
        json["doi"] = nullptr;
        if (report.doi) json["doi"] = to_json(*report.doi);
        json["geometric_optics"] = nullptr;
        if (waves) json["geometric_optics"] = waves->verdict;
        json["readings"] = Json::array();
        for (const GlossReading& r : report.readings) {
            Json reading = {{"angle_deg", r.geometry.angle_deg},
                            {"gloss", json_of(r.gloss)},
                            {"haze", nullptr},
                            {"reflectance", json_of(r.reflectance)},
                            {"truncated", r.truncated},
                            {"edge", r.edge},
                            {"rays", r.rays},
                            {"tis", nullptr}};
            if (!r.haze.empty()) reading["haze"] = json_of(r.haze);
            if (waves) reading["tis"] = scatter(*waves, r);
            json["readings"].push_back(reading);
        }
        return json;
    }

    ExperimentOptions experiment_;
    ThreadsOption threads_;
    CLI::Option *geometry_ = nullptr, *azimuth_ = nullptr, *doi_ = nullptr, *doi_angle_ = nullptr;
    bool all_azimuths_ = false, json_ = false, quiet_ = false;
};

}  // namespace

Verb add_gloss(CLI::App& program) {
    CLI::App* app = program.add_subcommand("gloss", "read a glossmeter over a surface");
    const auto verb = std::make_shared<GlossVerb>(*app);
    return {app, [verb] { return verb->run(); }};
}

}  // namespace asperity::cli
