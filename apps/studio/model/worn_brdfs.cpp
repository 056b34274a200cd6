// SPDX-License-Identifier: Apache-2.0
#include "worn_brdfs.h"

#include "model_settings.h"

#include <asperity/bsdf/spec.h>
#include <asperity/core/error.h>
#include <asperity/formats/bsdfs/bsdf_format.h>
#include <asperity/formats/results/result_file.h>
#include <asperity/gonio/experiment_text.h>
#include <asperity/measured/baked_brdf.h>
#include <asperity/measured/tabulated.h>

#include <QFileInfo>

#include <fmt/format.h>

#include <algorithm>

namespace asperity::studio {

namespace {

/// So many results are kept ready: one may go to and fro between them.
constexpr std::size_t kKept = 4;
/// So many analytic ones, which are made in a moment.
constexpr std::size_t kModelsKept = 8;

double in_unit_interval(double value) {
    return std::clamp(value, 0.0, 1.0);
}

Rgb in_unit_interval(Rgb c) {
    return {in_unit_interval(c.r), in_unit_interval(c.g), in_unit_interval(c.b)};
}

bool wears_simulated(const ModelView& view) {
    return view.brdf.type == BrdfType::Simulated ||
           (view.compare && view.second.type == BrdfType::Simulated);
}

/// "GGX, alpha 0.3, material Au": what a specification must give, and what was set.
QString model_description(const BrdfSettings& settings) {
    const auto model = find_bsdf_model(settings.model);
    if (!model) return QString::fromStdString(settings.model);
    QString line = QString::fromStdString(model->label);
    for (const BsdfParam& param : model->params) {
        const std::string text = model_setting(settings.settings, *model, param);
        if (param.required || text != param.otherwise)
            line += QString::fromStdString(fmt::format(", {} {}", param.info.name, text));
    }
    return line;
}

/// Throws what the command line throws for a result that cannot be shown in colours.
void expect_colours(int channels, const std::string& where) {
    if (channels == 1 || channels == 3) return;
    throw Error(ErrorCode::InvalidInput,
                fmt::format("has {} channels, a picture needs 1 (grey) or 3 (red, green, blue): "
                            "measure with --wavelengths 650,550,450",
                            channels),
                where);
}

}  // namespace

WornBrdfs::WornBrdfs(Drawing& drawing, QObject* parent)
    : QObject(parent),
      drawing_(drawing),
      background_(this, [this](const QString& sentence) { give_up(sentence); }) {
    const auto look_again = [this] { wear(view_); };
    connect(&drawing_, &Drawing::completed, this, look_again);
    connect(&drawing_, &Drawing::state_changed, this, &WornBrdfs::told);
    connect(&drawing_, &Drawing::layers_changed, this, [look_again](int number) {
        if (number == 0) look_again();  // cleared, or read from a file
    });
}

void WornBrdfs::wear(const ModelView& view) {
    view_ = view;
    if (!view.brdf_runs || !wears_simulated(view)) {
        background_.cancel();
        wanted_.reset();
        trouble_.clear();
        return;
    }
    Source source;
    if (!view.result.empty()) {
        source.file = view.result;
        source.written = QFileInfo(QString::fromStdString(view.result)).lastModified();
    } else {
        source.drawn = drawing_.result();
    }
    if (wanted_ != source) want(source);
}

void WornBrdfs::want(const Source& source) {
    wanted_ = source;
    trouble_.clear();
    background_.cancel();
    const auto known = std::find_if(made_.begin(), made_.end(),
                                    [&](const Simulated& s) { return s.source == source; });
    if (source.drawn == nullptr && source.file.empty()) {
        if (drawing_.state() == Drawing::State::Idle) emit failed(nothing_drawn());
        emit changed();
    } else if (known != made_.end()) {
        std::rotate(made_.begin(), known, known + 1);
        emit changed();
    } else {
        run_ = std::make_shared<Run>();
        const auto make = [this, source](Run& run, const auto&) -> Background::Delivery {
            const Simulated made = simulate(source, run);
            return [this, made] { take(made); };
        };
        background_.start(make, run_);
        emit changed();
    }
}

WornBrdfs::Simulated WornBrdfs::simulate(const Source& source, Run& run) {
    const io::BsdfFormats formats;
    if (source.drawn == nullptr && formats.can_read(source.file)) {
        const std::unique_ptr<Bsdf> file = formats.read(source.file);
        expect_colours(file->channels(), source.file);
        const QString name = QFileInfo(QString::fromStdString(source.file)).fileName();
        return {source, bake_brdf(*file, run), name, {}};
    }
    const auto measurement =
        source.drawn != nullptr
            ? source.drawn
            : std::make_shared<const Measurement>(io::load_measurement(source.file));
    const std::string where = source.drawn != nullptr ? "the result drawn" : source.file;
    expect_colours(measurement->channels(), where);
    if (run.stop_requested()) throw Error(ErrorCode::Stopped, "stopped");
    const auto table = make_tabulated_brdf(*measurement, run);
    return {source,
            bake_brdf(*table, run),
            QString::fromStdString(measurement->surface_name),
            {{"experiment", to_text(measurement->experiment)},
             {"experiment-checksum", io::checksum(*measurement)}}};
}

void WornBrdfs::take(const Simulated& made) {
    made_.insert(made_.begin(), made);
    if (made_.size() > kKept) made_.pop_back();
    emit changed();
}

void WornBrdfs::give_up(const QString& sentence) {
    trouble_ = sentence;
    emit failed(sentence);
    emit changed();
}

QString WornBrdfs::nothing_drawn() const {
    return drawing_.state() == Drawing::State::Idle
               ? tr("draw textures in the scene Microfacets Surface first, or open a result")
               : tr("the textures are still being drawn: the simulated BRDF follows");
}

QString WornBrdfs::trouble() const {
    for (const BrdfSettings* side : {&view_.brdf, &view_.second}) {
        if (!view_.brdf_runs || (side == &view_.second && !view_.compare)) continue;
        if (side->type == BrdfType::Model && !analytic(*side).why.isEmpty())
            return analytic(*side).why;
    }
    const bool nothing = wanted_ && wanted_->drawn == nullptr && wanted_->file.empty();
    return nothing ? nothing_drawn() : trouble_;
}

const WornBrdfs::Analytic& WornBrdfs::analytic(const BrdfSettings& settings) const {
    const auto model = find_bsdf_model(settings.model);
    const std::string spec = model ? model_spec(settings.settings, *model) : settings.model;
    const auto known = std::find_if(analytic_.begin(), analytic_.end(),
                                    [&](const Analytic& a) { return a.spec == spec; });
    if (known != analytic_.end()) return *known;
    Analytic made{spec, std::nullopt, {}};
    try {
        made.material = Material(parse_brdf_spec(spec));
    } catch (const std::exception& error) {  // models of others may throw what they like
        made.why = QString::fromUtf8(error.what());
    }
    if (analytic_.size() >= kModelsKept) analytic_.pop_front();
    return analytic_.emplace_back(std::move(made));
}

const WornBrdfs::Simulated* WornBrdfs::worn() const {
    if (made_.empty() || !wanted_ || made_.front().source != *wanted_) return nullptr;
    return &made_.front();
}

std::optional<Material> WornBrdfs::material(const BrdfSettings& settings) const {
    if (settings.type == BrdfType::Model) return analytic(settings).material;
    const Simulated* simulated = worn();
    if (simulated == nullptr) return std::nullopt;
    return Material(simulated->brdf,
                    {std::max(0.0, settings.normalize_factor), in_unit_interval(settings.diffuse)});
}

QString WornBrdfs::description(const BrdfSettings& settings) const {
    if (settings.type == BrdfType::Model) return model_description(settings);
    const Simulated* simulated = worn();
    const QString surface = simulated != nullptr ? simulated->surface : QString();
    return surface.isEmpty() ? tr("Simulated") : tr("Simulated, %1").arg(surface);
}

io::Provenance WornBrdfs::origin() const {
    const Simulated* simulated = worn();
    return simulated != nullptr && wears_simulated(view_) ? simulated->origin : io::Provenance{};
}

}  // namespace asperity::studio
