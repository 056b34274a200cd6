// SPDX-License-Identifier: Apache-2.0
// asperity compare: how far two BRDFs, measured or analytic, lie apart.
#include "brdf_argument.h"
#include "console.h"
#include "file_kind.h"
#include "help.h"
#include "options.h"
#include "output_path.h"
#include "report.h"
#include "report_json.h"
#include "table.h"
#include "verbs.h"

#include <asperity/bsdf/spec.h>
#include <asperity/core/directions.h>
#include <asperity/core/error.h>
#include <asperity/core/run.h>
#include <asperity/formats/images/image_reader.h>
#include <asperity/formats/results/result_file.h>
#include <asperity/gonio/measurement_head.h>
#include <asperity/measured/compare.h>
#include <asperity/render/film.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace asperity::cli {

namespace {

std::string compare_closing() {
    return "A and B are result files, files of BSDFs (asperity export --help) or models:\n" +
           brdf_spec_help() +
           "A key left out keeps its default; lists have \"/\" between their numbers.\n"
           "Models are averaged over the same cells. Light and detector options are for two\n"
           "models. Two pictures (.exr, .hdr) of one size are compared in linear light, pixel by\n"
           "pixel. L1 is the integral of |fa - fb| cos(theta) over the hemisphere (0 equal, 2\n"
           "apart); noise is what it would be from the error bars alone; RMS is of the same\n"
           "difference, in 1/sr. (12) is the standard error of the last digits, from batches, as\n"
           "cells beside each other err together. Of two results with other layers or cells, B is\n"
           "interpolated to those of A, its lobes moving with the light.\n"
           "\n"
           "Examples\n"
           "  asperity compare rough.asperity cook-torrance:roughness=0.55,metallic=1\n"
           "  asperity compare first.asperity second.asperity --json\n"
           "  asperity compare measured.exr model.exr\n"
           "  asperity compare ggx:alpha=0.3 student-t:alpha=0.3,gamma=4 --theta 0,30,60 "
           "--resolution 64\n";
}

/// One side of a comparison.
struct Side {
    std::unique_ptr<Bsdf> model;               ///< set when the side is a model
    std::unique_ptr<Measurement> measurement;  ///< set when it is a file
};

Side open_side(const std::string& text) {
    Side side;
    side.model = open_brdf(text, io::BsdfFormats());
    if (side.model) return side;
    check_brdf_exists(text);
    side.measurement = std::make_unique<Measurement>(load_result(text));
    return side;
}

/// The same comparison with A and B in each other's place.
Comparison swapped(Comparison comparison) {
    std::swap(comparison.name_a, comparison.name_b);
    for (LayerComparison& layer : comparison.layers) {
        std::swap(layer.albedo_a, layer.albedo_b);
        layer.albedo_difference = -layer.albedo_difference;
    }
    return comparison;
}

/// With its error in brackets, "0.0123(4)"; as `plain` formats it where it has none.
std::string told(double value, double error, fmt::format_string<double&> plain) {
    return error == 0 ? fmt::format(plain, value) : with_error(value, error);
}

std::string text_of_comparison(const Comparison& comparison) {
    std::string text = fmt::format("A: {}\nB: {}\n", comparison.name_a, comparison.name_b);
    Table table({"layer", "theta_i", "phi_i", "albedo A", "albedo B", "A - B", "L1", "noise",
                 "RMS [1/sr]"});
    bool errors = false, unknown = false;
    for (const LayerComparison& c : comparison.layers) {
        table.add({std::to_string(c.number), fmt::format("{:.4g}°", degrees(c.theta_i)),
                   fmt::format("{:.4g}°", degrees(c.phi_i)), fmt::format("{:.5f}", c.albedo_a),
                   fmt::format("{:.5f}", c.albedo_b),
                   (c.albedo_difference_error != 0 && c.albedo_difference >= 0 ? "+" : "") +
                       told(c.albedo_difference, c.albedo_difference_error, "{:+.5f}"),
                   told(c.l1, c.l1_error, "{:.4f}"), fmt::format("{:.4f}", c.l1_noise),
                   told(c.rms, c.rms_error, "{:.4g}")});
        unknown = unknown || std::isnan(c.l1_error);
        errors = errors || c.l1_error > 0;
    }
    text += table.text() +
            fmt::format("mean L1 {}, mean RMS {} 1/sr, largest albedo difference {:.5f}\n",
                        told(comparison.mean_l1, comparison.mean_l1_error, "{:.4f}"),
                        told(comparison.mean_rms, comparison.mean_rms_error, "{:.4g}"),
                        comparison.max_albedo_difference);
    if (errors) text += "(12): standard error of the last digits, from batches\n";
    if (unknown)
        text +=
            "(?): a result does not hold what errors of several cells come from: measure it "
            "anew\n";
    return text;
}

bool is_picture(const std::string& text) {
    return ending(text) == "exr" || ending(text) == "hdr";
}

std::string text_of_pictures(const ImageDifference& d, const std::string& a, const std::string& b) {
    return fmt::format(
        "A: {}, mean luminance {:.6g}\nB: {}, mean luminance {:.6g}\n"
        "mean of |A - B| {:.4g}, that is {:.3g} % of A; root mean square {:.4g}\n",
        a, d.mean_a, b, d.mean_b, d.mean_absolute, 100 * d.relative, d.rms);
}

Json json_of_pictures(const ImageDifference& d) {
    return {{"mean_a", d.mean_a},
            {"mean_b", d.mean_b},
            {"mean_absolute_difference", d.mean_absolute},
            {"rms_difference", d.rms},
            {"relative_difference", d.relative}};
}

/// Refuses one that has no difference to another.
Image picture(const std::string& path) {
    Image image = io::read_image(path);
    const auto wrong = std::find_if_not(image.rgb.begin(), image.rgb.end(),
                                        [](float value) { return std::isfinite(value); });
    if (wrong == image.rgb.end()) return image;
    const auto pixel = (wrong - image.rgb.begin()) / 3;
    throw Error(ErrorCode::InvalidInput,
                fmt::format("the pixel in row {}, column {} is not a finite number",
                            pixel / image.width, pixel % image.width),
                path);
}

class CompareVerb {
  public:
    explicit CompareVerb(CLI::App& app) {
        a_ = add_text(app, "a", "A", "a result file, a model or a rendered picture", "");
        b_ = add_text(app, "b", "B", "the same", "");
        experiment_.add_to(app, {kLight, kDetector}, false);
        threads_.add_to(app);
        app.add_flag("--json", json_, "print one JSON object")->group(kOutput);
        set_help(app, "compare A B [options]", compare_closing());
    }

    int run() {
        if (b_->count() == 0) {
            throw Error(ErrorCode::Usage, "compare needs two result files, models or pictures");
        }
        const auto beside_picture = [](const CLI::Option* a, const CLI::Option* b) {
            if (is_picture(text_of(a)) && ending(text_of(b)) == "png")
                require_kind(text_of(b), FileKind::Picture);
        };
        beside_picture(a_, b_);
        beside_picture(b_, a_);
        if (is_picture(text_of(a_)) && is_picture(text_of(b_))) return compare_pictures();
        const Experiment experiment = experiment_.read();
        validate(experiment);
        const int threads = Run(threads_.threads()).threads();
        const Side a = open_side(text_of(a_)), b = open_side(text_of(b_));
        const Comparison comparison = compare_sides(a, b, experiment, threads);
        const std::vector<std::string> lobes = notes_on_lobes(a, b);
        if (json_) {
            Json json = to_json(comparison);
            if (!note_.empty()) json["note"] = note_;
            if (!lobes.empty()) json["lobes"] = lobes;
            write_json(json);
        } else {
            write_out(text_of_comparison(comparison));
            if (!note_.empty()) write_out("note: " + note_ + "\n");
            for (const std::string& note : lobes) write_out("note: " + note + "\n");
        }
        return 0;
    }

  private:
    /// Of sides whose lobes are told by too few cells.
    static std::vector<std::string> notes_on_lobes(const Side& a, const Side& b) {
        std::vector<std::string> notes;
        for (const auto& [name, side] : {std::pair{"A", &a}, {"B", &b}}) {
            if (!side->measurement) continue;
            const std::string note = narrow_lobes(*side->measurement);
            if (!note.empty()) notes.push_back(fmt::format("{}: {}", name, note));
        }
        return notes;
    }

    int compare_pictures() const {
        if (experiment_.any_given())
            throw Error(ErrorCode::Usage,
                        "pictures bring their own light: these options are for "
                        "two models");
        const Image a = picture(text_of(a_)), b = picture(text_of(b_));
        const ImageDifference difference = compare(a, b);
        if (json_) {
            write_json(json_of_pictures(difference));
        } else {
            write_out(text_of_pictures(difference, text_of(a_), text_of(b_)));
        }
        return 0;
    }

    /// Layer by layer, or between the layers of B where it has none of A's.
    Comparison compare_measurements(const Measurement& a, const Measurement& b, int threads) {
        const std::string why = unlike(a, b);
        if (why.empty()) return compare(a, b);
        note_ =
            why + ": B is interpolated between its layers, noise and errors are those of A alone";
        return compare_between_layers(a, b, Run(threads));
    }

    Comparison compare_sides(const Side& a, const Side& b, const Experiment& experiment,
                             int threads) {
        Comparison comparison;
        if (a.model && b.model) {
            comparison = compare(*a.model, *b.model, experiment, threads);
        } else if (experiment_.any_given()) {
            throw Error(ErrorCode::Usage,
                        "a result file brings its own light and detector; these options are for "
                        "two models");
        } else if (b.model) {
            comparison = compare(*a.measurement, *b.model, threads);
        } else if (a.model) {
            comparison = swapped(compare(*b.measurement, *a.model, threads));
        } else {
            comparison = compare_measurements(*a.measurement, *b.measurement, threads);
        }
        // Sides carry the names the user gave them.
        comparison.name_a = text_of(a_);
        comparison.name_b = text_of(b_);
        return comparison;
    }

    ExperimentOptions experiment_;
    ThreadsOption threads_;
    CLI::Option *a_ = nullptr, *b_ = nullptr;
    std::string note_;  ///< on how it was done
    bool json_ = false;
};

}  // namespace

Verb add_compare(CLI::App& program) {
    CLI::App* app = program.add_subcommand("compare", "tell how far two BRDFs lie apart");
    const auto verb = std::make_shared<CompareVerb>(*app);
    return {app, [verb] { return verb->run(); }};
}

}  // namespace asperity::cli
