// SPDX-License-Identifier: Apache-2.0
// asperity plot: results, models and surfaces as plots.
#include "brdf_argument.h"
#include "console.h"
#include "file_kind.h"
#include "help.h"
#include "options.h"
#include "output_path.h"
#include "stop.h"
#include "verbs.h"

#include <asperity/bsdf/spec.h>
#include <asperity/core/error.h>
#include <asperity/core/parse_number.h>
#include <asperity/core/run.h>
#include <asperity/formats/bsdfs/bsdf_format.h>
#include <asperity/formats/heights/surface_files.h>
#include <asperity/params/fields.h>
#include <asperity/plots/files/plot_file_params.h>
#include <asperity/plots/files/write_plot.h>
#include <asperity/plots/plot_kinds.h>
#include <asperity/surface/surface_kinds.h>
#include <asperity/surface/surface_text.h>

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>

namespace asperity::cli {

namespace {

using plots::PlotFileSettings;
using plots::PlotKind;
using plots::PlotSettings;
using plots::PlotSubject;

constexpr const char* kPlotClosing =
    "All subjects share one plot. A model beside a result is averaged over the cells of its\n"
    "detector, as the instrument would see it; models alone are drawn exactly. Bands and bars are\n"
    "one standard error. A CSV holds the same curves as numbers, errors in columns of their own.\n"
    "\n"
    "Examples\n"
    "  asperity plot metal.asperity cook-torrance:roughness=0.55,metallic=1 -o lobe.pdf\n"
    "  asperity plot metal.asperity --theta 0,30,60 --axes cartesian --scale log -o lobes.svg\n"
    "  asperity plot metal.asperity ggx:alpha=0.3 --kind lobe3d -o solid.png\n"
    "  asperity plot metal.asperity --kind albedo -o albedo.csv\n"
    "  asperity plot gaussian:alpha=0.3 measured.sur --kind normals -o normals.svg\n";

/// Options made of the rows of a table.
template <typename Settings>
class RowOptions {
  public:
    void add_to(CLI::App& app, const ParamTable<Settings>& table, const char* group) {
        for (const Param<Settings>& row : table) {
            const ParamInfo& info = row.info;
            const std::string name = "--" + info.name, help = help_text(info);
            CLI::Option* option =
                info.type == ParamType::Flag
                    ? app.add_flag(name, help)->group(group)
                    : add_text(app, name, metavar(info), help, group)
                          ->default_str(info.otherwise.empty() ? row.default_text()
                                                               : info.otherwise);
            options_.emplace_back(row, option);
        }
    }
    /// Throws Error(Usage, name), also for an option that the others leave without effect.
    Settings read() const {
        Settings settings;
        for (const auto& [row, option] : options_) {
            if (option->count() == 0) continue;
            const std::string value = row.info.type == ParamType::Flag ? "true" : text_of(option);
            row.apply(settings, value);
        }
        for (const auto& [row, option] : options_)
            if (option->count() > 0 && !row.used(settings))
                throw Error(ErrorCode::Usage, row.unused(settings), row.info.name);
        return settings;
    }

    /// Throws Error(Usage, option) where the option of that name, or any, was given.
    void refuse_where(bool useless, const std::string& name, const char* why) const {
        for (const auto& [row, option] : options_)
            if (useless && option->count() > 0 && (name.empty() || row.info.name == name))
                throw Error(ErrorCode::Usage, why, row.info.name);
    }

  private:
    std::vector<std::pair<Param<Settings>, CLI::Option*>> options_;
};

/// Whether a text is a kind of surface, with or without settings.
bool is_surface_kind(const std::string& text) {
    return find_surface_kind(text.substr(0, text.find(':'))).has_value();
}

PlotSubject open_surface(const std::string& text, const PlotKind& kind, Run& run) {
    if (ending(text) == "asperity")
        throw Error(ErrorCode::InvalidInput,
                    fmt::format("is a result; --kind {} is made of surfaces: a file of heights or "
                                "a kind such as gaussian:alpha=0.3",
                                kind.name),
                    text);
    SurfaceSettings settings;
    apply_surface_spec(settings, text);
    if (settings.kind == kSurfaceFile) require_kind(settings.file, FileKind::Heights);
    PlotSubject subject;
    subject.surface = std::make_shared<const Heightfield>(io::load_surface(settings, run));
    return subject;
}

PlotSubject open_result(const std::string& text, const PlotKind& kind) {
    PlotSubject subject;
    subject.model = open_brdf(text, io::BsdfFormats());
    if (subject.model) return subject;
    if (is_surface_kind(text))
        throw Error(ErrorCode::Usage,
                    fmt::format("is a kind of surface; --kind {} is made of results (asperity "
                                "simulate --surface {} -o x.asperity) and models",
                                kind.name, text),
                    text);
    check_brdf_exists(text);
    subject.measurement = std::make_shared<const Measurement>(load_result(text));
    return subject;
}

/// The text of a model or a kind, the name of a file without folder and ending.
std::string short_name(const std::string& text) {
    if (is_brdf_spec(text)) return text;
    std::error_code ignored;
    if (!std::filesystem::exists(text, ignored)) return text;
    return std::filesystem::path(text).stem().string();
}

class PlotVerb {
  public:
    explicit PlotVerb(CLI::App& app) {
        subjects_ = add_text(app, "subjects", "FILE|MODEL...",
                             "results, files of BSDFs and models; of some kinds, surfaces", "")
                        ->expected(1, -1)
                        ->allow_extra_args()
                        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
        plot_.add_to(app, plots::plot_params(), kModel);
        output_ = add_text(
            app, "-o,--output", "X.svg | X.pdf | X.png | X.csv",
            "a drawing, a picture or the numbers; - writes an SVG to standard output", kOutput);
        labels_ = add_text(app, "--labels", "A,B...", "names of the subjects", kOutput)
                      ->default_str("files and models");
        file_.add_to(app, plots::plot_file_params(), kOutput);
        threads_.add_to(app);
        app.add_flag("--quiet", quiet_, "do not name the file written")->group(kOutput);
        set_help(app, "plot A [B ...] [--kind KIND] -o X.svg | X.pdf | X.png | X.csv",
                 kPlotClosing);
    }

    int run() const {
        const PlotSettings settings = plot_.read();
        const PlotFileSettings file = file_.read();
        plots::check(settings);
        const std::string path = text_of(output_);
        if (subjects_->count() == 0)
            throw Error(ErrorCode::Usage, "plot needs results, models or surfaces");
        if (path.empty())
            throw Error(ErrorCode::Usage,
                        "plot needs -o with a name ending in .svg, .pdf, .png or .csv");
        const bool piped = path == kStandardOutput;
        if (!piped) plots::check_plot_path(path);
        if (!piped) check_output_file(path);
        file_.refuse_where(ending(path) == "csv", {}, "a CSV has no looks");
        file_.refuse_where(ending(path) != "png", "pixels", "it is for .png");

        Run run(threads_.threads());
        const StopOnSignal stop(run);
        const auto plot = plots::make_plot(open_subjects(settings, run), settings, run);
        if (piped) {
            const StandardOutputFile drawing("svg");
            plots::write_plot(*plot, file, drawing.path());
            drawing.send();
            return 0;
        }
        plots::write_plot(*plot, file, path);
        Talk(quiet_, false)("wrote " + path + "\n");
        return 0;
    }

  private:
    std::vector<PlotSubject> open_subjects(const PlotSettings& settings, Run& run) const {
        const PlotKind& kind = *plots::find_plot_kind(settings.kind);
        const std::vector<std::string> texts = subjects_->results();
        const std::vector<std::string> names = names_of(texts);
        std::vector<PlotSubject> subjects;
        for (std::size_t k = 0; k < texts.size(); ++k) {
            if (texts[k].empty()) throw Error(ErrorCode::Usage, "a name of a subject is empty");
            subjects.push_back(kind.of_surfaces ? open_surface(texts[k], kind, run)
                                                : open_result(texts[k], kind));
            subjects.back().name = names[k];
        }
        return subjects;
    }

    std::vector<std::string> names_of(const std::vector<std::string>& texts) const {
        std::vector<std::string> names;
        if (labels_->count() > 0) {
            const std::string labels = text_of(labels_);
            for (const std::string_view label : split(labels, ',')) names.emplace_back(label);
            if (names.size() != texts.size())
                throw Error(
                    ErrorCode::Usage,
                    fmt::format("{} given, there are {} subjects", names.size(), texts.size()),
                    "labels");
            return names;
        }
        for (const std::string& text : texts) names.push_back(short_name(text));
        // Two files of one name in two folders
        for (std::size_t k = 0; k < names.size(); ++k)
            if (std::count(names.begin(), names.end(), names[k]) > 1) names[k] = texts[k];
        return names;
    }

    RowOptions<PlotSettings> plot_;
    RowOptions<PlotFileSettings> file_;
    ThreadsOption threads_;
    CLI::Option *subjects_ = nullptr, *output_ = nullptr, *labels_ = nullptr;
    bool quiet_ = false;
};

}  // namespace

Verb add_plot(CLI::App& program) {
    CLI::App* app =
        program.add_subcommand("plot", "plot results, models and surfaces as SVG, PDF, PNG or CSV");
    const auto verb = std::make_shared<PlotVerb>(*app);
    return {app, [verb] { return verb->run(); }};
}

}  // namespace asperity::cli
