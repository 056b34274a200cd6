// SPDX-License-Identifier: Apache-2.0
#include "export_job.h"

#include <asperity/core/error.h>
#include <asperity/formats/bsdfs/bsdf_format.h>
#include <asperity/formats/bsdfs/fidelity.h>
#include <asperity/formats/bsdfs/snippets.h>

#include <cmath>

namespace asperity::studio {

namespace {

constexpr int kCellsOfModels = 64;  ///< of the fidelity: a model has no detector of its own

io::ExportSource source_of(const ExportWish& wish, int threads) {
    const OpenedBrdf opened = open_brdf(wish.source, wish.drawn);
    if (const auto* measurement = std::get_if<std::shared_ptr<const Measurement>>(&opened))
        return {*measurement, threads};
    Experiment cells;
    cells.detector.resolution = kCellsOfModels;
    return {std::get<std::shared_ptr<const Bsdf>>(opened), cells, threads};
}

}  // namespace

bool has_snippets(const std::string& format) {
    try {
        io::require_snippets(format);
        return true;
    } catch (const Error&) {
        return false;
    }
}

namespace {

/// The steps of an export; a stop leaves in the outcome what was done before.
void run_export(const ExportWish& wish, Run& run, ExportOutcome& outcome) {
    const io::BsdfFormats formats;
    const io::BsdfFormat& format = formats.for_writing(wish.path, wish.format);
    const io::FormatOptions options(format.options, wish.options);
    if (wish.snippets) io::require_snippets(format.name);
    if (!format.read && std::isfinite(wish.max_error))
        throw Error(ErrorCode::Usage, "this format is not read back", "max-error");

    constexpr std::uint64_t kSteps = 3;
    run.begin("exporting", kSteps);
    const auto step = [&] {
        run.advance(1);
        if (run.stop_requested()) throw Error(ErrorCode::Stopped, "stopped");
    };
    io::ExportSource source = source_of(wish, run.threads());
    source.watch(run);
    const auto remark = [&](const std::string& sentence) {
        outcome.remarks << QString::fromStdString(sentence);
    };
    for (const std::string& sentence : source.remarks()) remark(sentence);
    step();
    for (const std::string& sentence : format.write(source, options, wish.path)) remark(sentence);
    outcome.written << QString::fromStdString(wish.path);
    if (wish.snippets)
        for (const std::string& name : io::write_snippets(format.name, options, wish.path))
            outcome.written << QString::fromStdString(name);
    step();
    if (format.read) {
        const io::Fidelity fidelity = io::fidelity_of(source, format, wish.path);
        outcome.fidelity = QString::fromStdString(io::to_text(fidelity));
        outcome.mean_l1 = fidelity.mean_l1;
        outcome.too_far = fidelity.mean_l1 > wish.max_error;
    }
    run.end();
}

}  // namespace

ExportOutcome export_brdf(const ExportWish& wish, Run& run) {
    ExportOutcome outcome;
    try {
        run_export(wish, run, outcome);
    } catch (const Error& error) {
        if (error.code() != ErrorCode::Stopped) throw;
        outcome.stopped = true;
    }
    return outcome;
}

}  // namespace asperity::studio
