// SPDX-License-Identifier: Apache-2.0
#include "measuring.h"

#include "forecast.h"
#include "output_path.h"
#include "progress.h"
#include "report.h"
#include "report_json.h"
#include "stop.h"

#include <asperity/bsdf/spec.h>
#include <asperity/core/error.h>
#include <asperity/formats/atomic_file.h>
#include <asperity/formats/bsdfs/bsdf_format.h>
#include <asperity/formats/heights/surface_files.h>
#include <asperity/formats/results/result_file.h>
#include <asperity/gonio/angles_of_lobe.h>
#include <asperity/gonio/measure.h>
#include <asperity/gonio/measurement_head.h>
#include <asperity/measured/compare.h>
#include <asperity/optics/fresnel.h>
#include <asperity/surface/surface_kinds.h>

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <utility>

namespace asperity::cli {

namespace {

/// The thesis' model with F = 1 and roughness^2 = alpha, at most 1. A surface smoother than this
/// has no lobe to compare with.
constexpr double kLeastAlpha = 1e-3;

std::string default_reference(const Measurement& m) {
    const SurfaceSettings& settings = m.experiment.surface;
    const SurfaceStatistics& figures = m.surface;
    // GGX slopes have no finite mean square: the asked width is the surface's alpha.
    const double alpha = surface_uses(settings.kind, "max-slope")
                             ? std::sqrt(settings.alpha_x * settings.alpha_y)
                             : figures.rms_gradient;
    if (alpha < kLeastAlpha) return "none";
    // A metal's albedo is its F0 (thesis eq. 4.4): the reflectance of the run's facets along the
    // normal. The model has no more than three channels.
    const Fresnel facets(m.experiment.optics);
    std::vector<double> f0(static_cast<std::size_t>(facets.channels()));
    facets.eval(1, f0);
    if (f0.size() != 1 && f0.size() != 3) return "none";
    return fmt::format("cook-torrance:roughness={:.4g},metallic=1,albedo={:.4g}",
                       std::min(1.0, std::sqrt(alpha)), fmt::join(f0, "/"));
}

bool can_compare(const Bsdf& model, int channels) {
    return model.channels() == channels || model.channels() == 1 || channels == 1;
}

std::string checkpoint_of(const std::string& path) {
    return path + ".checkpoint";
}

bool exists(const std::string& path) {
    std::error_code ignored;
    return std::filesystem::exists(path, ignored);
}

std::uint64_t batches_in(const Measurement& m) {
    std::uint64_t sum = 0;
    for (const Layer& layer : m.layers) sum += static_cast<std::uint64_t>(layer.batches);
    return sum;
}

/// Options that decide how far a run goes: a checkpoint of other ones leads to another result.
void require_same_goal(const Measurement& so_far, const Measurement& head, int part, int parts,
                       const std::string& path) {
    const RunSettings &a = so_far.experiment.run, &b = head.experiment.run;
    if (a.until != b.until || a.until_cells != b.until_cells || a.max_rays != b.max_rays)
        throw Error(ErrorCode::InvalidInput,
                    "it is of a run with another --until or --max-rays: see asperity refine", path);
    if (so_far.part != part || so_far.parts != parts)
        throw Error(ErrorCode::InvalidInput,
                    fmt::format("it is of --part {}/{}", so_far.part, so_far.parts), path);
}

/// A result has a format of its own: another one is what export makes of it.
void check_result_name(const std::string& path) {
    const std::string kind = ending(path);
    const auto refuse = [&](const std::string& then) {
        const std::string result = std::filesystem::path(path).stem().string() + ".asperity";
        throw Error(ErrorCode::Usage,
                    fmt::format("a result is no .{} file: write it with -o {}, then {}", kind,
                                result, fmt::format(fmt::runtime(then), result)),
                    path);
    };
    if (kind == "png") refuse("asperity export {0} -o X.png draws it");
    if (kind == "gsf") refuse("asperity surface makes heights");
    const io::BsdfFormats formats;
    for (const io::BsdfFormat& format : formats.rows())
        if (format.write && std::count(format.endings.begin(), format.endings.end(), kind) > 0)
            refuse("asperity export {0} -o X." + kind);
}

}  // namespace

void Measuring::add_output(CLI::App& app, const std::string& otherwise) {
    output_ =
        add_text(app, "-o,--output", "FILE", "save the result: counts, errors, settings", kOutput)
            ->default_str(otherwise);
    reference_ = add_text(app, "--reference", "SPEC|none",
                          "model for the L1 column, as compare takes it", kOutput)
                     ->default_str("Cook-Torrance with roughness^2 = alpha and the facets' F0");
    app.add_flag("--json", json_, "print one JSON object, as info --json does")->group(kOutput);
    app.add_flag("--quiet", quiet_, "no progress, no table")->group(kOutput);
}

void Measuring::add_run(CLI::App& app) {
    threads_.add_to(app);
    checkpoint_ = add_text(app, "--checkpoint", "SECONDS",
                           "keep what is done in FILE.checkpoint so often; 0: never", kRun)
                      ->default_str("30");
    app.add_flag("--resume", resume_,
                 "go on from FILE.checkpoint, or from a FILE that was stopped, of the same options")
        ->group(kRun);
}

double Measuring::checkpoint_seconds() const {
    constexpr double kMostSeconds = 1e6;
    const std::string text = text_of(checkpoint_, "30");
    const double seconds = text == "0" ? 0 : parse_positive("checkpoint", text);
    if (seconds > kMostSeconds)
        throw Error(ErrorCode::Usage, fmt::format("{} is not below {} seconds", text, kMostSeconds),
                    "checkpoint");
    return seconds;
}

void Measuring::check_output() const {
    if (output() != kStandardOutput) {
        check_result_name(output());
        return check_output_file(output());
    }
    if (json_)
        throw Error(ErrorCode::Usage, "standard output takes the result: -o FILE leaves it free",
                    "json");
}

void Measuring::check(const Experiment& experiment, const std::string& path) const {
    validate(experiment);
    const Fresnel checked(experiment.optics);
    const std::string reference = text_of(reference_, "none");
    if (reference != "none") {
        const auto model = parse_brdf_spec(reference);
        if (!can_compare(*model, checked.channels()))
            throw Error(ErrorCode::Usage,
                        fmt::format("has {} channels, the facets have {}", model->channels(),
                                    checked.channels()),
                        "reference");
    }
    if (has_output()) {
        check_output();
    } else if (!path.empty()) {
        check_output_file(path);
    }
    if (!path.empty() && path != kStandardOutput) {
        checkpoint_seconds();
        return;
    }
    if (resume_) throw Error(ErrorCode::Usage, "needs -o FILE to go on from", "resume");
    if (checkpoint_->count() > 0)
        throw Error(ErrorCode::Usage, "needs -o FILE beside which it is kept", "checkpoint");
}

std::optional<Measurement> Measuring::left_behind(const Measurement& head, const std::string& path,
                                                  const Talk& say) const {
    if (!resume_) return std::nullopt;
    const std::string beside = checkpoint_of(path);
    const bool checkpoint = exists(beside);
    const std::string& file = checkpoint ? beside : path;
    if (!checkpoint && !io::looks_like_result(path)) {
        say("there is no " + beside + ": starting from the beginning\n");
        return std::nullopt;
    }
    Measurement so_far = io::load_measurement(file);
    require_same_experiment(so_far, head, file);
    require_same_goal(so_far, head, head.part, head.parts, file);
    say(fmt::format("going on from {}: {} batches are done\n", file, batches_in(so_far)));
    return so_far;
}

void Measuring::warn_of_checkpoint(const std::string& path) {
    if (!exists(checkpoint_of(path))) return;
    write_err(fmt::format(
        "asperity: warning: {} of a run that did not end will be replaced, --resume would "
        "go on from it\n",
        checkpoint_of(path)));
}

void Measuring::keep(const Measurement& so_far, const std::string& path) {
    if (path == kStandardOutput) return;
    // Work goes on without one, but not without a word
    try {
        io::save_measurement(so_far, checkpoint_of(path));
    } catch (const Error& error) {
        if (!std::exchange(warned_, true))
            write_err(fmt::format("asperity: warning: no checkpoint: {}\n", error.what()));
    }
}

std::chrono::milliseconds Measuring::checkpoint_period() const {
    const double seconds = checkpoint_seconds() > 0 ? checkpoint_seconds() : 3600;
    return std::chrono::milliseconds(std::llround(1000 * seconds));
}

int Measuring::measure(Task task, const std::string& path) {
    Run run(threads_.threads());
    const bool piped = path == kStandardOutput;
    const Talk say(quiet_, json_ || piped);
    const StopOnSignal stop(run);
    ProgressBar progress(run, quiet_);

    const Heightfield surface = io::load_surface(task.experiment.surface, run);
    task.experiment = with_angles(surface, task.experiment, run);
    MeasureScope scope{std::move(task.so_far), task.part, task.parts};
    // A result to be refined is where to begin without a checkpoint
    if (resume_ && (!scope.so_far || exists(checkpoint_of(path)))) {
        Measurement head = head_of(surface, task.experiment, run);
        head.part = task.part;
        head.parts = task.parts;
        if (auto found = left_behind(head, path, say)) scope.so_far = std::move(found);
    }
    if (!resume_ && !path.empty() && path != kStandardOutput) warn_of_checkpoint(path);
    const bool fresh = !scope.so_far && task.parts == 1;
    MeasureListener listener;
    listener.begun = [&](const Measurement& begun) {
        progress.clear();
        describe(say, begun, surface);
        if (!quiet_ && fresh)
            say(forecast(surface, task.experiment, run).warning(task.experiment, surface));
    };
    if (!path.empty() && !piped && checkpoint_seconds() > 0) {
        listener.checkpoint_period = checkpoint_period();
        listener.checkpoint = [&](const Measurement& so_far) { keep(so_far, path); };
    }
    // A run that refines until it is accurate gives each layer the rays it needs.
    if (task.experiment.run.until == 0 && fresh)
        progress.name_layers(incidences(task.experiment.illumination));
    const Measurement m =
        asperity::measure(surface, task.experiment, run, listener, std::move(scope));
    progress.clear();

    if (m.stopped && m.layers.empty()) refuse_nothing();
    finish(m, path, run.threads());
    return m.stopped ? static_cast<int>(ErrorCode::Stopped) : 0;
}

void Measuring::refuse_nothing() {
    throw Error(ErrorCode::Stopped, "stopped before anything was complete, nothing is written");
}

void Measuring::finish(const Measurement& m, const std::string& path, int threads) const {
    if (path == kStandardOutput) {
        const StandardOutputFile file("asperity");
        const std::string checksum = io::save_measurement(m, file.path());
        tell(Talk(quiet_, true), m, checksum, "", threads);
        return file.send();
    }
    const std::string checksum = path.empty() ? io::checksum(m) : io::save_measurement(m, path);
    if (!path.empty()) io::remove_file(checkpoint_of(path));
    tell(Talk(quiet_, json_), m, checksum, path, threads);
}

void Measuring::describe(const Talk& say, const Measurement& head,
                         const Heightfield& surface) const {
    if (quiet_) return;
    const SurfaceSettings& settings = head.experiment.surface;
    say("surface: " + surface_line(settings, head.surface, surface.nx, surface.ny) + "\n");
    const std::string tiling = tiling_line(settings, surface);
    if (!tiling.empty()) say("surface: " + tiling + "\n");
    if (!surface.prepared.empty()) say("surface: made ready: " + surface.prepared + "\n");
}

void Measuring::tell(const Talk& say, const Measurement& m, const std::string& checksum,
                     const std::string& path, int threads) const {
    if (json_) {
        Json json = to_json(m, checksum);
        json["file"] = nullptr;
        if (!path.empty()) json["file"] = path;
        write_json(json);
    }
    if (quiet_) return;
    std::string reference = text_of(reference_);
    if (reference.empty()) reference = default_reference(m);
    // A share of the batches is no lobe to compare
    if (m.parts > 1) reference = "none";
    std::optional<Comparison> comparison;
    if (reference != "none") {
        const auto model = parse_brdf_spec(reference);
        if (can_compare(*model, m.channels())) comparison = compare(m, *model, threads);
    }
    say(layer_table(m, comparison));
    if (comparison)
        say("L1: distance to " + reference + ";\nnoise: what it would be from the errors alone\n");
    say(closing_lines(m));
    if (!path.empty()) say(fmt::format("wrote {}{}\n", path, m.stopped ? " (partial)" : ""));
    say("checksum " + checksum + "\n");
}

}  // namespace asperity::cli
