// SPDX-License-Identifier: Apache-2.0
// asperity surface: make or read a surface, tell its figures, save it, draw it.
#include "console.h"
#include "file_kind.h"
#include "help.h"
#include "options.h"
#include "output_path.h"
#include "progress.h"
#include "report_json.h"
#include "stop.h"
#include "surface_report.h"
#include "verbs.h"

#include <asperity/core/error.h>
#include <asperity/formats/heights/surface_files.h>
#include <asperity/pictures/pictures.h>

#include <fmt/format.h>

#include <memory>

namespace asperity::cli {

namespace {

constexpr const char* kSurfaceClosing =
    "With neither -o nor --png the figures are shown, as with --stats.\n"
    "\n"
    "Examples\n"
    "  asperity surface thesis --roughness 0.2 --size 512 -o thesis.gsf --png thesis.png\n"
    "  asperity surface gaussian --alpha 0.3 --correlation-length 12 --stats\n"
    "  asperity surface ggx:alpha=0.5,size=1024 -o rough.gsf\n"
    "  asperity surface measured.gsf --tiling periodic --stats --json\n";

class SurfaceVerb {
  public:
    explicit SurfaceVerb(CLI::App& app) {
        spec_ = add_text(app, "spec", "SPEC|FILE", "a kind of surface or a file of heights", "");
        experiment_.add_to(app, {kSurface}, false);
        threads_.add_to(app);
        output_ = add_text(app, "-o,--output", "FILE",
                           "save the heights: .gsf, .exr or .txt; - writes .gsf to standard output",
                           kOutput);
        png_ = add_text(app, "--png", "FILE", "draw the surface seen from above", kOutput);
        look_ = add_text(app, "--look", "NAME",
                         "of the picture: shaded, with a scale bar and a key of the heights; bare, "
                         "the same without; normals, as the thesis draws them",
                         kOutput)
                    ->default_str("shaded");
        theme_ = add_text(app, "--theme", "NAME", "of the shaded picture: light or dark", kOutput)
                     ->default_str("light");
        app.add_flag("--before", before_,
                     "with --png, of a file: draw the heights as the file has them and, beside "
                     "them, made ready")
            ->group(kOutput);
        app.add_flag("--stats", stats_, "show the realised figures")->group(kOutput);
        app.add_flag("--list", list_, "list the channels of the file and nothing else")
            ->group(kOutput);
        app.add_flag("--json", json_, "print one JSON object and nothing else")->group(kOutput);
        app.add_flag("--quiet", quiet_, "print nothing but errors")->group(kOutput);
        set_help(app, "surface SPEC|FILE [options] [-o FILE] [--png FILE]", kSurfaceClosing);
    }

    int run() {
        const std::string spec = text_of(spec_);
        if (spec.empty()) {
            throw Error(ErrorCode::Usage,
                        "surface needs a kind of surface or a file, such as gaussian");
        }
        const SurfaceSettings settings = experiment_.read(spec).surface;
        if (settings.kind == kSurfaceFile) require_kind(settings.file, FileKind::Heights);
        check_outputs();
        if (before_ && (png_->count() == 0 || settings.kind != kSurfaceFile))
            throw Error(ErrorCode::Usage, "it is for --png of a surface from a file", "before");
        const Talk say(quiet_, json_ || text_of(output_) == kStandardOutput);
        Run run(threads_.threads());
        const StopOnSignal stop(run);
        ProgressBar progress(run, quiet_);
        if (list_) return list(settings, run, progress);
        const Heightfield patch = io::load_patch(settings, run);
        const Heightfield surface = io::tiled(patch, settings);
        const SurfaceReport report(settings, patch, surface, run);
        if (run.stop_requested()) throw Error(ErrorCode::Stopped, "stopped, nothing is written");
        progress.clear();

        if (output_->count() > 0) save(surface);
        if (png_->count() > 0) draw(settings, patch, surface, run);
        if (json_) write_json(report.json(run));
        if (!json_) tell(say, report);
        return 0;
    }

  private:
    int list(const SurfaceSettings& settings, Run& run, ProgressBar& progress) const {
        if (settings.kind != kSurfaceFile)
            throw Error(ErrorCode::Usage, "only files have channels to list", "list");
        const auto channels = io::list_channels(settings, run);
        progress.clear();
        std::string text;
        for (std::size_t k = 0; k < channels.size(); ++k) {
            const io::HeightsChannel& c = channels[k];
            text += fmt::format("{:>3}  {}  {} x {}{}\n", k + 1, c.name, c.nx, c.ny,
                                c.other.empty() ? "" : ", no heights: " + c.other);
        }
        Talk(quiet_, false)(text);
        return 0;
    }

    void save(const Heightfield& surface) const {
        if (text_of(output_) != kStandardOutput)
            return io::write_heights(surface, text_of(output_));
        const StandardOutputFile file("gsf");
        io::write_heights(surface, file.path());
        file.send();
    }

    void draw(const SurfaceSettings& settings, const Heightfield& patch, const Heightfield& surface,
              Run& run) const {
        if (before_)
            io::write_before_after_png(io::read_topography(settings, run), patch, text_of(png_));
        else if (text_of(look_, "shaded") == "shaded")
            io::write_relief_png(surface, text_of(png_), is_dark());
        else
            io::write_surface_png(surface, text_of(png_), look());
    }

    bool is_dark() const {
        const std::string name = text_of(theme_, "light");
        if (name == "dark" || name == "light") return name == "dark";
        throw Error(ErrorCode::Usage, fmt::format("'{}' is neither light nor dark", name), "theme");
    }

    io::SurfaceLook look() const {
        const std::string name = text_of(look_, "shaded");
        if (name == "shaded" || name == "bare") return io::SurfaceLook::Shaded;
        if (name == "normals") return io::SurfaceLook::Normals;
        throw Error(ErrorCode::Usage, fmt::format("'{}' is none of shaded, bare, normals", name),
                    "look");
    }

    void check_outputs() const {
        look();
        if (look_->count() > 0 && png_->count() == 0)
            throw Error(ErrorCode::Usage, "it is for --png, the picture", "look");
        is_dark();
        if (theme_->count() > 0 &&
            (png_->count() == 0 || before_ || text_of(look_, "shaded") != "shaded"))
            throw Error(ErrorCode::Usage, "it is for --png in the look shaded", "theme");
        if (output_->count() > 0) {
            const std::string path = text_of(output_);
            if (path == kStandardOutput && json_)
                throw Error(ErrorCode::Usage,
                            "standard output takes the heights: -o FILE leaves it free", "json");
            const std::string kind = path == kStandardOutput ? "gsf" : ending(path);
            if (kind != "gsf" && kind != "exr" && kind != "txt") {
                throw Error(ErrorCode::Usage,
                            kind == "png"
                                ? "--png draws a picture; -o saves heights, .gsf, .exr or .txt"
                                : "the name must end in .gsf, .exr or .txt",
                            path);
            }
            if (path != kStandardOutput) check_output_file(path);
        }
        if (png_->count() > 0) {
            if (ending(text_of(png_)) != "png") {
                throw Error(ErrorCode::Usage, "the name must end in .png", text_of(png_));
            }
            check_output_file(text_of(png_));
        }
    }

    void tell(const Talk& say, const SurfaceReport& report) const {
        say(report.headline());
        if (stats_ || (output_->count() == 0 && png_->count() == 0)) say(report.figures());
        for (const CLI::Option* file : {output_, png_}) {
            if (file->count() > 0 && text_of(file) != kStandardOutput)
                say("wrote " + text_of(file) + "\n");
        }
    }

    ExperimentOptions experiment_;
    ThreadsOption threads_;
    CLI::Option *spec_ = nullptr, *output_ = nullptr, *png_ = nullptr, *look_ = nullptr,
                *theme_ = nullptr;
    bool stats_ = false, json_ = false, quiet_ = false, list_ = false, before_ = false;
};

}  // namespace

Verb add_surface(CLI::App& program) {
    CLI::App* app = program.add_subcommand("surface", "make, read, describe and draw a surface");
    const auto verb = std::make_shared<SurfaceVerb>(*app);
    return {app, [verb] { return verb->run(); }};
}

}  // namespace asperity::cli
