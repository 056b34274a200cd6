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
#include <asperity/core/parse_number.h>
#include <asperity/formats/results/result_file.h>
#include <asperity/gonio/experiment_text.h>
#include <asperity/gonio/region.h>

#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <utility>

namespace asperity::cli {

namespace {

constexpr const char* kInfoClosing =
    "Examples\n"
    "  asperity info metal.asperity\n"
    "  asperity info metal.asperity --json | jq '.layers[0].albedo'\n"
    "  asperity info metal.asperity --region 20:40,170:190     (what leaves there, with its "
    "error)\n"
    "  asperity info metal.asperity --config > run.txt\n"
    "  asperity simulate --config run.txt -o again.asperity    (the same checksum)\n";

std::string text_of_result(const io::ResultHead& result, const std::string& path) {
    const Measurement& m = result.measurement;
    std::string text =
        fmt::format("{}: asperity {}, checksum {}\n", path, m.version, result.checksum);
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

/// "theta0:theta1,phi0:phi1" in degrees.
Region region_of(const std::string& text) {
    const auto bad = [&] {
        throw Error(ErrorCode::Usage,
                    fmt::format("{} is not of the form theta0:theta1,phi0:phi1, in degrees",
                                in_quotes(text)),
                    "region");
    };
    std::vector<double> angles;
    const auto ranges = split(text, ',');
    for (const std::string_view range : ranges) {
        const auto ends = split(range, ':');
        if (ends.size() != 2) bad();
        for (const std::string_view end : ends) {
            const auto degrees = parse_double(end);
            if (!degrees) bad();
            angles.push_back(radians(*degrees));
        }
    }
    if (ranges.size() != 2) bad();
    return {angles[0], angles[1], angles[2], angles[3]};
}

/// The region, the edges of whose cells are of the detector.
struct CellsOfRegion {
    CellsOfRegion(const Measurement& m, const std::string& text)
        : cells(cells_in(m.detector, region_of(text))) {
        if (cells.empty())
            throw Error(ErrorCode::Usage,
                        fmt::format("{} holds the centre of no cell: they are {:g} x {:g} degrees",
                                    in_quotes(text), 90.0 / m.detector.rows(),
                                    360.0 / m.detector.columns()),
                        "region");
    }
    double projected_solid_angle(const Detector& d) const {
        double sum = 0;
        for (const int cell : cells) sum += d.projected_solid_angle(cell / d.columns());
        return sum;
    }

    std::vector<int> cells;
};

std::string text_of_region(const Measurement& m, const std::string& asked) {
    const CellsOfRegion region(m, asked);
    std::string text = fmt::format(
        "region {}: {} cells, those whose centre is in it, projected solid angle {:.4g} sr\n",
        asked, region.cells.size(), region.projected_solid_angle(m.detector));
    bool few = false, unknown = false;
    for (const Layer& layer : m.layers) {
        text += fmt::format("layer {:2}, theta {:.4g}, phi {:.4g}:", layer.number,
                            degrees(layer.theta_i), degrees(layer.phi_i));
        for (int c = 0; c < m.channels(); ++c) {
            const EnergyOfCells sum = energy_of_cells(m, layer, c, region.cells);
            text += fmt::format(" {} {}{}", m.channel_names[static_cast<std::size_t>(c)],
                                with_error(sum.energy, sum.error), sum.few_rays ? "*" : "");
            few = few || sum.few_rays;
            unknown = unknown || std::isnan(sum.error);
        }
        text += "\n";
    }
    text +=
        "energy as a fraction of what comes in; (12): standard error of the last digits, from "
        "batches\n";
    if (few) text += "*: less than 10 rays, the error is a rough one\n";
    if (unknown)
        text +=
            "(?): this result does not hold what errors of several cells come from: measure it "
            "anew\n";
    return text;
}

Json json_of_region(const Measurement& m, const std::string& asked) {
    const CellsOfRegion region(m, asked);
    Json layers = Json::array();
    for (const Layer& layer : m.layers) {
        Json energy = Json::array(), error = Json::array(), few = Json::array();
        for (int c = 0; c < m.channels(); ++c) {
            const EnergyOfCells sum = energy_of_cells(m, layer, c, region.cells);
            energy.push_back(sum.energy);
            error.push_back(std::isnan(sum.error) ? Json() : Json(sum.error));
            few.push_back(sum.few_rays);
        }
        layers.push_back({{"number", layer.number},
                          {"energy", energy},
                          {"energy_stderr", error},
                          {"few_rays", few}});
    }
    return {{"asked", asked},
            {"cells", region.cells.size()},
            {"projected_solid_angle", region.projected_solid_angle(m.detector)},
            {"layers", layers}};
}

io::ResultHead whole_of(Measurement m) {
    std::string checksum = io::checksum(m);
    return {std::move(m), std::move(checksum)};
}

class InfoVerb {
  public:
    explicit InfoVerb(CLI::App& app) {
        file_ = add_text(app, "file", "FILE", "a result of asperity simulate", "");
        app.add_flag("--json", json_, "print one JSON object")->group(kOutput);
        app.add_flag("--config", config_, "print the experiment as a --config file")
            ->group(kOutput);
        region_ = add_text(app, "--region", "T0:T1,P0:P1",
                           "energy of the cells whose centres have polar angles from T0 to T1 and "
                           "azimuths from P0 to P1, in degrees, with its error",
                           kOutput);
        set_help(app, "info FILE [--region T0:T1,P0:P1] [--json | --config]", kInfoClosing);
    }

    int run() const {
        if (file_->count() == 0) throw Error(ErrorCode::Usage, "info needs a result file");
        if (json_ && config_) {
            throw Error(ErrorCode::Usage, "info prints either --json or --config, not both");
        }
        const bool region = region_->count() > 0;
        if (region && config_)
            throw Error(ErrorCode::Usage, "a --config file has no --region", "region");
        const std::string path = text_of(file_);
        const io::ResultHead result = region ? whole_of(load_result(path)) : load_result_head(path);
        const Measurement& m = result.measurement;
        if (json_) {
            Json json = to_json(m, result.checksum);
            if (region) json["region"] = json_of_region(m, text_of(region_));
            write_json(json);
        } else if (region) {
            write_out(text_of_region(m, text_of(region_)));
        } else {
            write_out(config_ ? to_text(m.experiment) : text_of_result(result, path));
        }
        return 0;
    }

  private:
    CLI::Option *file_ = nullptr, *region_ = nullptr;
    bool json_ = false, config_ = false;
};

}  // namespace

Verb add_info(CLI::App& program) {
    CLI::App* app = program.add_subcommand("info", "show what a result file holds");
    const auto verb = std::make_shared<InfoVerb>(*app);
    return {app, [verb] { return verb->run(); }};
}

}  // namespace asperity::cli
