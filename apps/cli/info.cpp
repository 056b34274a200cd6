// SPDX-License-Identifier: Apache-2.0
// asperity info: what a result file holds.
#include "console.h"
#include "file_kind.h"
#include "help.h"
#include "options.h"
#include "report.h"
#include "report_json.h"
#include "verbs.h"

#include <asperity/core/error.h>
#include <asperity/formats/results/result_file.h>
#include <asperity/gonio/experiment_text.h>

#include <fmt/format.h>

#include <memory>

namespace asperity::cli {

namespace {

constexpr const char* kClosing =
    "Examples\n"
    "  asperity info metal.asperity\n"
    "  asperity info metal.asperity --json | jq '.layers[0].albedo'\n"
    "  asperity info metal.asperity --config > run.txt\n"
    "  asperity simulate --config run.txt -o again.asperity    (the same checksum)\n";

std::string text_of_result(const Measurement& m, const std::string& path) {
    std::string text =
        fmt::format("{}: asperity {}, checksum {}\n", path, m.version, io::checksum(m));
    text +=
        "surface: " + surface_line(m.experiment.surface, m.surface, m.surface_nx, m.surface_ny) +
        "\n";
    text += "surface: " + m.surface_name + "\n";
    text += fmt::format(
        "detector: {}, {} rows x {} columns, {} bounce orders; channels: {}; seed {}\n",
        m.detector.kind() == DetectorKind::LatLong ? "latlong" : "equal-area", m.detector.rows(),
        m.detector.columns(), m.orders(), fmt::join(m.channel_names, " "), m.experiment.run.seed);
    return text + layer_table(m, std::nullopt) + closing_lines(m);
}

class InfoVerb {
  public:
    explicit InfoVerb(CLI::App& app) {
        file_ = add_text(app, "file", "FILE", "a result of asperity simulate", "");
        app.add_flag("--json", json_, "print one JSON object")->group(kOutput);
        app.add_flag("--config", config_, "print the experiment as a --config file")
            ->group(kOutput);
        set_help(app, "info FILE [--json | --config]", kClosing);
    }

    int run() const {
        if (file_->count() == 0) throw Error(ErrorCode::Usage, "info needs a result file");
        if (json_ && config_) {
            throw Error(ErrorCode::Usage, "info prints either --json or --config, not both");
        }
        const Measurement m = load_result(text_of(file_));
        if (json_) {
            write_json(to_json(m, io::checksum(m)));
        } else {
            write_out(config_ ? to_text(m.experiment) : text_of_result(m, text_of(file_)));
        }
        return 0;
    }

  private:
    CLI::Option* file_ = nullptr;
    bool json_ = false, config_ = false;
};

}  // namespace

Verb add_info(CLI::App& program) {
    CLI::App* app = program.add_subcommand("info", "show what a result file holds");
    const auto verb = std::make_shared<InfoVerb>(*app);
    return {app, [verb] { return verb->run(); }};
}

}  // namespace asperity::cli
