// SPDX-License-Identifier: Apache-2.0
// asperity export: a result as files and images other programs read.
#include "brdf_argument.h"
#include "console.h"
#include "file_kind.h"
#include "help.h"
#include "option_value.h"
#include "options.h"
#include "output_path.h"
#include "picture_names.h"
#include "report_json.h"
#include "stop.h"
#include "verbs.h"

#include <asperity/core/directions.h>
#include <asperity/core/error.h>
#include <asperity/core/run.h>
#include <asperity/formats/bsdfs/bsdf_format.h>
#include <asperity/formats/bsdfs/fidelity.h>
#include <asperity/formats/bsdfs/snippets.h>
#include <asperity/formats/results/result_file.h>
#include <asperity/pictures/pictures.h>

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <limits>
#include <memory>
#include <utility>

namespace asperity::cli {

namespace {

constexpr const char* kExportClosing =
    "Examples\n"
    "  asperity export metal.asperity -o layers.exr     (all layers, one EXR part each, f in "
    "1/sr)\n"
    "  asperity export metal.asperity -o table.csv --format layers-csv\n"
    "  asperity export metal.asperity -o metal.bsdf --max-error 2%   (for Mitsuba; read back)\n"
    "  asperity export ggx:alpha=0.3 -o ggx.bsdf --format rgl:colour=spectral\n"
    "  asperity export metal.asperity -o pictures/      (a PNG per layer and sheet.png)\n"
    "  asperity export metal.asperity -o sheet.png --projection disk --colour-map viridis\n";

class ExportVerb {
  public:
    explicit ExportVerb(CLI::App& app) {
        file_ = add_text(app, "file", "FILE",
                         "a result of asperity simulate, a model or a file of a BSDF", "");
        output_ = add_text(app, "-o,--output", "FILE | X.png | FOLDER/",
                           "a file in one of the formats, one sheet of all layers, or a folder of "
                           "pictures; - writes one file to standard output",
                           kOutput);
        format_ = add_text(app, "--format", "NAME[:KEY=VALUE,...]",
                           "a format and its options, see below", kOutput)
                      ->default_str("by the ending");
        colour_map_ = add_text(app, "--colour-map,--color-map", "NAME",
                               "PNG: viridis, inferno, grey or thesis-red", kOutput)
                          ->default_str("inferno");
        scale_ =
            add_text(app, "--scale", "NAME", "PNG: log or linear", kOutput)->default_str("log");
        decades_ = add_text(app, "--decades", "D", "PNG: decades of the log scale", kOutput)
                       ->default_str("4");
        projection_ =
            add_text(app, "--projection", "NAME",
                     "PNG: sky-map (azimuth x angle) or disk (hemisphere from above)", kOutput)
                ->default_str("sky-map");
        channel_ = add_text(app, "--channel", "NAME", "PNG: one channel, by name or number from 0",
                            kOutput)
                       ->default_str("mean of all");
        theme_ =
            add_text(app, "--theme", "NAME", "PNG: dark or light", kOutput)->default_str("dark");
        app.add_flag("--own-scales", own_scales_,
                     "PNG: each picture of a sheet has its own scale and tells where it ends")
            ->group(kOutput);
        max_error_ =
            add_text(app, "--max-error", "E",
                     "fail when the mean L1 of what is read back is larger: 0.02 or 2%", kOutput)
                ->default_str("never");
        app.add_flag("--snippet", snippet_,
                     "write scenes of Mitsuba, pbrt or Radiance that use the file beside it")
            ->group(kOutput);
        app.add_flag("--json", json_, "print one JSON object: the fidelity")->group(kOutput);
        app.add_flag("--quiet", quiet_, "do not name the files written")->group(kOutput);
        set_help(app, "export FILE -o X.exr | X.csv | X.png | FOLDER/",
                 formats_text() + kExportClosing);
    }

    int run() const {
        if (file_->count() == 0) throw Error(ErrorCode::Usage, "export needs a result file");
        if (output_->count() == 0) {
            throw Error(ErrorCode::Usage,
                        "export needs -o with a name ending in .png, / or that of a format");
        }
        const std::string path = text_of(output_);
        if (path == kStandardOutput) return write_piped();
        refuse_picture_options(path);
        if (!wants_pictures(path)) return write_file(path);
        if (format_->count() > 0)
            throw Error(ErrorCode::Usage, "pictures have no format", "format");
        if (snippet_) throw Error(ErrorCode::Usage, "is for files of a format", "snippet");
        if (max_error_->count() > 0 || json_)
            throw Error(ErrorCode::Usage, "is for files of a format", json_ ? "json" : "max-error");
        return write_pictures(path);
    }

  private:
    /// Formats and their options, for the help.
    std::string formats_text() const {
        std::string text = "Formats\n";
        for (const io::BsdfFormat& format : formats_.rows()) {
            if (!format.write) continue;
            text += fmt::format("  {:<12} .{}: {}\n", format.name, fmt::join(format.endings, ", ."),
                                format.doc);
            for (const io::FormatOption& option : format.options)
                text +=
                    fmt::format("      {}={}: {}\n", option.name,
                                option.otherwise.empty() ? "auto" : option.otherwise, option.doc);
        }
        return text + "\n";
    }

    /// Standard output takes one file of a format that is named, or a sheet where none is.
    int write_piped() const {
        if (json_)
            throw Error(ErrorCode::Usage, "standard output takes the file: -o FILE leaves it free",
                        "json");
        if (snippet_) throw Error(ErrorCode::Usage, "needs a file to stand beside", "snippet");
        const std::string spec = text_of(format_);
        const StandardOutputFile file(
            spec.empty()
                ? "png"
                : formats_.for_writing("", spec.substr(0, spec.find(':'))).endings.front());
        refuse_picture_options(file.path());
        spec.empty() ? write_pictures(file.path()) : write_file(file.path());
        file.send();
        return 0;
    }

    /// Options of pictures are none of files.
    void refuse_picture_options(const std::string& path) const {
        if (wants_pictures(path)) {
            if (decades_->count() > 0 && text_of(scale_, "log") != "log")
                throw Error(ErrorCode::Usage, "it is of the log scale", "decades");
            return;
        }
        if (own_scales_)
            throw Error(ErrorCode::Usage, "it is for pictures: -o X.png or a folder", "own-scales");
        for (const CLI::Option* option :
             {colour_map_, scale_, decades_, projection_, channel_, theme_})
            if (option->count() > 0)
                throw Error(ErrorCode::Usage, "it is for pictures: -o X.png or a folder",
                            option->get_lnames().front());
    }

    /// Nothing is said where standard output takes the file.
    Talk talk() const {
        const bool piped = text_of(output_) == kStandardOutput;
        return {quiet_ || json_ || piped, false};
    }

    int write_file(const std::string& path) const {
        const std::string spec = text_of(format_);
        const std::size_t colon = spec.find(':');
        const io::BsdfFormat& format = formats_.for_writing(path, spec.substr(0, colon));
        const io::FormatOptions options(
            format.options,
            colon == spec.npos ? std::string_view{} : std::string_view(spec).substr(colon + 1));
        check_output_file(path);
        if (snippet_) io::require_snippets(format.name);
        const double most = max_error();
        Run run;
        const StopOnSignal stop(run);
        io::ExportSource source = open_source();
        source.watch(run);
        std::vector<std::string> remarks = source.remarks();
        for (std::string& remark : format.write(source, options, path))
            remarks.push_back(std::move(remark));
        const Talk say = talk();
        say("wrote " + path + "\n");
        if (snippet_)
            for (const std::string& name : io::write_snippets(format.name, options, path))
                say("wrote " + name + "\n");
        if (format.read) {
            const io::Fidelity fidelity = read_back(source, format, path);
            say(io::to_text(fidelity) + "\n");
            for (const std::string& remark : remarks) say("  " + remark + "\n");
            if (json_) write_json(json_of(path, format, fidelity, remarks));
            if (fidelity.mean_l1 > most) {
                throw Error(ErrorCode::InvalidInput,
                            fmt::format("holds the data within {:.3g} % only, --max-error asks for "
                                        "{:.3g} %",
                                        100 * fidelity.mean_l1, 100 * most),
                            path);
            }
        } else if (!json_) {
            for (const std::string& remark : remarks) say("  " + remark + "\n");
        } else {
            write_json({{"file", path}, {"format", format.name}, {"remarks", remarks}});
        }
        return 0;
    }

    static io::Fidelity read_back(const io::ExportSource& source, const io::BsdfFormat& format,
                                  const std::string& path) {
        try {
            return io::fidelity_of(source, format, path);
        } catch (const Error& error) {
            if (error.code() != ErrorCode::Stopped) throw;
            throw Error(error.code(), "stopped; the file is whole, it was not read back", path);
        }
    }

    /// The mean L1 that is still taken.
    double max_error() const {
        if (max_error_->count() == 0) return std::numeric_limits<double>::infinity();
        std::string text = text_of(max_error_);
        const bool percent = text.ends_with('%');
        if (percent) text.pop_back();
        return parse_positive("max-error", text) * (percent ? 0.01 : 1.0);
    }

    /// A result of ours, a model, or a file of a BSDF.
    io::ExportSource open_source() const {
        const int threads = Run().threads();
        const std::string text = text_of(file_);
        if (auto bsdf = open_brdf(text, formats_)) {
            Experiment cells;
            cells.detector.resolution = 64;  // of the fidelity; a model has none of its own
            return {std::shared_ptr<const Bsdf>(std::move(bsdf)), cells, threads};
        }
        return {std::make_shared<const Measurement>(load_result(text)), threads};
    }

    static Json json_of(const std::string& path, const io::BsdfFormat& format,
                        const io::Fidelity& fidelity, const std::vector<std::string>& remarks) {
        Json json = {
            {"file", path},
            {"format", format.name},
            {"mean_l1", fidelity.mean_l1},
            {"worst_l1", fidelity.worst_l1},
            {"worst_theta_i_deg", degrees(fidelity.worst_theta_i)},
            {"mean_noise", fidelity.mean_noise},
            {"mean_l1_isotropic",
             fidelity.mean_isotropy < 0 ? Json() : Json(fidelity.mean_isotropy)},
            {"mean_l1_format", fidelity.mean_format < 0 ? Json() : Json(fidelity.mean_format)},
            {"max_albedo_difference", fidelity.max_albedo_difference},
            {"remarks", remarks},
            {"layers", distances_json(fidelity.layers)}};
        return json;
    }

    int write_pictures(const std::string& path) const {
        io::SkyMapSettings look = look_of_options();
        const bool folder = ending(path) != "png";
        folder ? check_output_folder(path) : check_output_file(path);

        const Measurement m = load_result(text_of(file_));
        look.channel = channel_of(m);
        std::vector<std::string> written = {path};
        if (folder) {
            written = io::write_layer_pngs(m, path, look);
            const std::string sheet = (std::filesystem::path(path) / "sheet.png").string();
            io::write_layer_sheet(m, sheet, look);
            written.push_back(sheet);
        } else {
            io::write_layer_sheet(m, path, look);
        }
        const Talk say = talk();
        for (const std::string& name : written) say("wrote " + name + "\n");
        return 0;
    }

    io::SkyMapSettings look_of_options() const {
        io::SkyMapSettings look;
        look.colour_map =
            OptionValue("colour-map", text_of(colour_map_, "inferno")).choice(kColourMaps);
        look.scale = OptionValue("scale", text_of(scale_, "log")).choice(kScales);
        look.projection =
            OptionValue("projection", text_of(projection_, "sky-map")).choice(kProjections);
        look.light = OptionValue("theme", text_of(theme_, "dark")).choice(kThemes);
        look.own_scales = own_scales_;
        look.decades = parse_positive("decades", text_of(decades_, "4"));
        constexpr double kMostDecades = 30;
        if (look.decades > kMostDecades) {
            throw Error(ErrorCode::Usage, fmt::format("{} is above 30", look.decades), "decades");
        }
        return look;
    }

    /// A sheet, or a folder: a name that ends in "/", is one, or has no ending.
    bool wants_pictures(const std::string& path) const {
        std::error_code ignored;
        if (!path.empty() && path.back() == '/') return true;
        if (std::filesystem::is_directory(path, ignored)) return true;
        if (format_->count() > 0) return false;
        return ending(path) == "png" || (ending(path).empty() && !path.empty());
    }

    int channel_of(const Measurement& m) const {
        if (channel_->count() == 0) return io::SkyMapSettings{}.channel;
        const std::string name = text_of(channel_);
        const auto found = std::find(m.channel_names.begin(), m.channel_names.end(), name);
        if (found != m.channel_names.end()) {
            return static_cast<int>(found - m.channel_names.begin());
        }
        const bool number = !name.empty() && name.find_first_not_of("0123456789") == name.npos;
        if (number) return parse_count("channel", name, 0, m.channels() - 1);
        throw Error(ErrorCode::Usage,
                    fmt::format("'{}' is none of {}", name, fmt::join(m.channel_names, ", ")),
                    "channel");
    }

    io::BsdfFormats formats_;
    CLI::Option *file_ = nullptr, *output_ = nullptr, *format_ = nullptr, *colour_map_ = nullptr,
                *scale_ = nullptr, *max_error_ = nullptr, *decades_ = nullptr,
                *projection_ = nullptr, *channel_ = nullptr, *theme_ = nullptr;
    bool quiet_ = false, json_ = false, snippet_ = false, own_scales_ = false;
};

}  // namespace

Verb add_export(CLI::App& program) {
    CLI::App* app = program.add_subcommand("export", "write the layers as EXR or PNG");
    const auto verb = std::make_shared<ExportVerb>(*app);
    return {app, [verb] { return verb->run(); }};
}

}  // namespace asperity::cli
