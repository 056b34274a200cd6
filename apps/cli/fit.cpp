// SPDX-License-Identifier: Apache-2.0
// asperity fit: the parameters with which models come nearest to a measurement or a file.
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
#include <asperity/fit/fit.h>
#include <asperity/fit/verdict.h>
#include <asperity/formats/bsdfs/bsdf_format.h>
#include <asperity/formats/results/result_file.h>
#include <shared/write_materialx.h>
#include <shared/write_residuals.h>

#include <fmt/format.h>

#include <cmath>
#include <memory>

namespace asperity::cli {

namespace {

std::string fit_closing() {
    return "FILE is a result file or a file of a BSDF (asperity export --help); Light and "
           "Detector\n"
           "options are for the latter. Models and their keys:\n" +
           brdf_spec_help() +
           "Free are a model's widths and colours; a key that is given, and the facets' "
           "reflectance\n"
           "of the run, stay. Errors are standard errors from batches, larger where the model "
           "does\n"
           "not fit. chi2/dof near 1: as good as the data. L1 is the\n"
           "integral of |f - f of the model| cos(theta) as a share of the albedo, noise what the\n"
           "error bars alone would give.\n"
           "\n"
           "Examples\n"
           "  asperity fit metal.asperity\n"
           "  asperity fit metal.asperity --model ggx,beckmann --light single --png residuals.png\n"
           "  asperity fit metal.asperity --model ggx --reflectance f0 --json\n"
           "  asperity fit paint.asperity --model ggx,beckmann --lambert\n"
           "  asperity fit paint.xml --model cook-torrance:k=ibl,ggx --metric log\n";
}

constexpr double kNoticed = 0.01;  ///< share of light worth a word

std::string param_name(const FittedParam& p) {
    return p.entry < 0 ? p.key : fmt::format("{}[{}]", p.key, p.entry);
}

std::string value_text(const FittedParam& p) {
    if (p.at_end) return fmt::format("{:.4g} (end of its range)", p.value);
    if (!(p.error > 0)) return fmt::format("{:.4g} (not determined)", p.value);
    return with_error(p.value, p.error);
}

std::string percent(double x) {
    return fmt::format("{:.2f} %", 100 * x);
}

std::string text_of_report(const FitReport& report, const FitData& data) {
    std::string text =
        fmt::format("{}: {} layers, {} blocks of cells, metric {}\n", data.name, data.layers.size(),
                    data.blocks.size(), fit_metric_name(report.metric));
    const bool errors = data.has_errors(), chi2 = report.metric == FitMetric::Chi2;
    std::vector<std::string> heads = {"model"};
    if (!chi2) heads.push_back(fit_metric_name(report.metric));
    if (errors) heads.emplace_back("chi2/dof");
    heads.emplace_back("L1");
    if (errors) heads.emplace_back("noise");
    heads.emplace_back("albedo");
    Table table(std::move(heads));
    for (const Fit& fit : report.fits) {
        std::vector<std::string> row = {fit.text};
        if (!chi2) row.push_back(fmt::format("{:.4g}", fit.misfit));
        if (errors) row.push_back(figure_of(fit.chi2_per_dof, 4));
        row.push_back(percent(fit.mean_l1));
        if (errors) row.push_back(percent(fit.mean_noise));
        row.push_back(fmt::format("{:+.4f}", fit.max_albedo_difference));
        table.add(std::move(row));
    }
    text += table.text() + report.verdict + "\n";
    if (!report.note.empty()) text += report.note + "\n";
    for (const Fit& fit : report.fits) {
        text += "  " + fit.spec + "\n";
        std::string line = "     ";
        for (const FittedParam& p : fit.params) {
            const std::string word = " " + param_name(p) + " " + value_text(p);
            if (display_width(line + word) > kTableColumns) {
                text += line + "\n";
                line = "     ";
            }
            line += word + (&p == &fit.params.back() ? "" : ",");
        }
        text += line + "\n";
    }
    return text;
}

const char* name_of(FitGrade grade) {
    switch (grade) {
        case FitGrade::WithinErrors:
            return "within-errors";
        case FitGrade::Close:
            return "close";
        case FitGrade::Rough:
            return "rough";
        case FitGrade::No:
            break;
    }
    return "no";
}

Json json_of(const Fit& fit) {
    Json json = {{"model", fit.text},
                 {"spec", fit.spec},
                 {"grade", name_of(grade(fit))},
                 {"misfit", fit.misfit},
                 {"chi2_per_dof", number_or_null(fit.chi2_per_dof)},
                 {"mean_l1", fit.mean_l1},
                 {"mean_noise", fit.mean_noise},
                 {"max_albedo_difference", fit.max_albedo_difference},
                 {"params", Json::array()},
                 {"layers", distances_json(fit.layers)}};
    for (const FittedParam& p : fit.params)
        json["params"].push_back({{"name", p.key},
                                  {"entry", p.entry < 0 ? Json() : Json(p.entry)},
                                  {"value", p.value},
                                  {"error", number_or_null(p.error)},
                                  {"at_end", p.at_end}});
    return json;
}

class FitVerb {
  public:
    explicit FitVerb(CLI::App& app) : app_(&app) {
        file_ = add_text(app, "file", "FILE", "a result file or a file of a BSDF", "");
        for (const Param<FitSettings>& row : fit_params()) options_.push_back(add_row(app, row));
        experiment_.add_to(app, {kLight, kDetector}, false);
        threads_.add_to(app);
        png_ =
            add_text(app, "--png", "FILE", "a picture of the nearest model over the data", kOutput)
                ->default_str("none");
        mtlx_ = add_text(app, "--mtlx", "FILE", "the fit of ggx as a surface of MaterialX", kOutput)
                    ->default_str("none");
        app.add_flag("--json", json_, "print one JSON object")->group(kOutput);
        set_help(app, "fit FILE [options]", fit_closing());
    }

    int run() {
        if (file_->count() == 0) throw Error(ErrorCode::Usage, "fit needs a file");
        const FitSettings settings = read_settings();
        for (const CLI::Option* file : {png_, mtlx_})
            if (file->count() > 0) check_output_file(text_of(file));
        const int threads = Run(threads_.threads()).threads();
        FitData data = open(settings, threads);
        data.name = text_of(file_);
        const FitReport report = fit_models(data, settings, threads);
        if (json_)
            write_json(json_of_report(report, data));
        else
            write_out(text_of_report(report, data) + (hint_.empty() ? "" : hint_ + "\n"));
        if (png_->count() > 0) write_residuals(data, report.fits.front(), text_of(png_));
        if (mtlx_->count() > 0) write_first_ggx(report);
        return 0;
    }

  private:
    static CLI::Option* add_row(CLI::App& app, const Param<FitSettings>& row) {
        const ParamInfo& info = row.info;
        const std::string name = "--" + info.name, help = help_text(info);
        if (info.type == ParamType::Flag) return app.add_flag(name, help)->group(info.group);
        return add_text(app, name, metavar(info), help, info.group)
            ->default_str(row.default_text());
    }

    FitSettings read_settings() const {
        FitSettings settings;
        const ParamTable<FitSettings> rows = fit_params();
        for (std::size_t k = 0; k < rows.size(); ++k)
            if (options_[k]->count() > 0)
                rows[k].apply(settings,
                              rows[k].info.type == ParamType::Flag ? "true" : text_of(options_[k]));
        return settings;
    }

    FitData open(const FitSettings& settings, int threads) {
        const std::string text = text_of(file_);
        const double last = radians(settings.last_theta_deg);
        if (const auto bsdf = open_brdf(text, io::BsdfFormats())) {
            if (settings.light == FitLight::Single)
                throw Error(ErrorCode::Usage,
                            "the file does not tell how often light was reflected", "light");
            Experiment experiment = experiment_.read();
            if (app_->get_option("--resolution")->count() == 0) experiment.detector.resolution = 64;
            if (bsdf->isotropic()) experiment.illumination.isotropic = true;
            validate(experiment);
            return fit_data(*bsdf, experiment, last, threads);
        }
        check_brdf_exists(text);
        if (experiment_.any_given())
            throw Error(ErrorCode::Usage,
                        "a result file brings its own light and detector; these options are for "
                        "files of BSDFs");
        const Measurement measurement = load_result(text);
        const double multiple = multiple_share(measurement);
        if (settings.light == FitLight::All && multiple > kNoticed)
            hint_ = fmt::format(
                "{:.3g} % of the light was reflected more than once, which microfacet models leave "
                "out: --light single leaves it out of the data, too",
                100 * multiple);
        return fit_data(measurement, settings.light, last);
    }

    void write_first_ggx(const FitReport& report) const {
        for (const Fit& fit : report.fits) {
            if (fit.spec.starts_with("ggx:")) return write_materialx(fit, text_of(mtlx_));
        }
        throw Error(ErrorCode::Usage, "needs ggx among the models: OpenPBR has no other facets",
                    "mtlx");
    }

    Json json_of_report(const FitReport& report, const FitData& data) const {
        Json json = {{"file", data.name},
                     {"metric", fit_metric_name(report.metric)},
                     {"layers", data.layers.size()},
                     {"blocks", data.blocks.size()},
                     {"errors_from_batches", data.has_batches()},
                     {"design_effect", data.design_effect},
                     {"verdict", report.verdict},
                     {"note", report.note},
                     {"hint", hint_},
                     {"fits", Json::array()}};
        for (const Fit& fit : report.fits) json["fits"].push_back(json_of(fit));
        return json;
    }

    CLI::App* app_;
    ExperimentOptions experiment_;
    ThreadsOption threads_;
    std::vector<CLI::Option*> options_;
    CLI::Option *file_ = nullptr, *png_ = nullptr, *mtlx_ = nullptr;
    std::string hint_;
    bool json_ = false;
};

}  // namespace

Verb add_fit(CLI::App& program) {
    CLI::App* app = program.add_subcommand("fit", "find the models that come nearest to a BRDF");
    const auto verb = std::make_shared<FitVerb>(*app);
    return {app, [verb] { return verb->run(); }};
}

}  // namespace asperity::cli
