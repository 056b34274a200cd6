// SPDX-License-Identifier: Apache-2.0
#include "worn_brdfs.h"

#include "model_settings.h"

#include <asperity/bsdf/spec.h>
#include <asperity/core/error.h>
#include <asperity/formats/bsdfs/bsdf_format.h>
#include <asperity/formats/results/result_file.h>
#include <asperity/gonio/experiment_text.h>
#include <asperity/measured/baked_brdf.h>

#include <QFileInfo>

#include <fmt/format.h>

#include <algorithm>
#include <exception>

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

/// The sides of a view that wear a simulated BRDF, left first.
std::vector<const BrdfSettings*> simulated_sides(const ModelView& view) {
    std::vector<const BrdfSettings*> sides;
    if (!view.brdf_runs) return sides;
    if (view.brdf.type == BrdfType::Simulated) sides.push_back(&view.brdf);
    if (view.compare && view.second.type == BrdfType::Simulated) sides.push_back(&view.second);
    return sides;
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
    std::vector<Source> sources;
    for (const BrdfSettings* side : simulated_sides(view)) {
        const Source source = source_of(*side, drawing_);
        if (std::find(sources.begin(), sources.end(), source) == sources.end())
            sources.push_back(source);
    }
    if (wanted_ != sources) want(std::move(sources));
}

WornBrdfs::Source WornBrdfs::source_of(const BrdfSettings& settings, const Drawing& drawing) {
    if (settings.result.empty()) return {drawing.result(), {}, {}};
    return {nullptr, settings.result,
            QFileInfo(QString::fromStdString(settings.result)).lastModified()};
}

void WornBrdfs::want(std::vector<Source> sources) {
    wanted_ = std::move(sources);
    const auto is_wanted = [this](const Source& source) {
        return std::find(wanted_.begin(), wanted_.end(), source) != wanted_.end();
    };
    std::erase_if(troubles_, [&](const auto& trouble) { return !is_wanted(trouble.first); });
    if (making_ && !is_wanted(*making_)) {
        background_.cancel();
        making_.reset();
    }
    // What is worn is kept longest
    std::stable_partition(made_.begin(), made_.end(),
                          [&](const Simulated& made) { return is_wanted(made.source); });
    make_next();
    if (wanted_.empty()) return;
    const bool nothing = std::any_of(wanted_.begin(), wanted_.end(),
                                     [](const Source& source) { return source.nothing(); });
    if (nothing && drawing_.state() == Drawing::State::Idle) emit failed(nothing_drawn());
    emit changed();
}

void WornBrdfs::make_next() {
    if (making_) return;
    for (const Source& source : wanted_) {
        const bool failed_before =
            std::any_of(troubles_.begin(), troubles_.end(),
                        [&](const auto& trouble) { return trouble.first == source; });
        if (source.nothing() || failed_before || find(source) != nullptr) continue;
        making_ = source;
        run_ = std::make_shared<Run>();
        const auto make = [this, source](Run& run, const auto&) -> Background::Delivery {
            const Simulated made = simulate(source, run);
            return [this, made] { take(made); };
        };
        background_.start(make, run_);
        return;
    }
}

WornBrdfs::Simulated WornBrdfs::simulate(const Source& source, Run& run) {
    const io::BsdfFormats formats;
    if (source.drawn == nullptr && formats.can_read(source.file)) {
        const std::unique_ptr<Bsdf> file = formats.read(source.file);
        expect_colours(file->channels(), source.file);
        const QString name = QFileInfo(QString::fromStdString(source.file)).fileName();
        return {source, bake_brdf(*file, run), name, true, {}};
    }
    const auto measurement =
        source.drawn != nullptr
            ? source.drawn
            : std::make_shared<const Measurement>(io::load_measurement(source.file));
    const std::string where = source.drawn != nullptr ? "the result drawn" : source.file;
    expect_colours(measurement->channels(), where);
    if (run.stop_requested()) throw Error(ErrorCode::Stopped, "stopped");
    return {source,
            bake_brdf(*measurement, run),
            QString::fromStdString(measurement->surface_name),
            false,
            {{"experiment", to_text(measurement->experiment)},
             {"experiment-checksum", io::checksum(*measurement)}}};
}

void WornBrdfs::take(const Simulated& made) {
    making_.reset();
    made_.insert(made_.begin(), made);
    if (made_.size() > kKept) made_.pop_back();
    make_next();
    emit changed();
}

void WornBrdfs::give_up(const QString& sentence) {
    if (making_) troubles_.emplace_back(*making_, sentence);
    making_.reset();
    make_next();
    emit failed(sentence);
    emit changed();
}

QString WornBrdfs::nothing_drawn() const {
    return drawing_.state() == Drawing::State::Idle
               ? tr("draw textures in the scene Microfacets Surface first, or open a result")
               : tr("the textures are still being drawn: the simulated BRDF follows");
}

QString WornBrdfs::trouble() const {
    if (!view_.brdf_runs) return {};
    const QString left = trouble_of(view_.brdf);
    return left.isEmpty() && view_.compare ? trouble_of(view_.second) : left;
}

QString WornBrdfs::trouble_of(const BrdfSettings& settings) const {
    if (settings.type == BrdfType::Model) return analytic(settings).why;
    const Source* source = wanted(settings);
    if (source == nullptr) return {};
    if (source->nothing()) return nothing_drawn();
    for (const auto& [failed_source, sentence] : troubles_)
        if (failed_source == *source) return sentence;
    return {};
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

const WornBrdfs::Source* WornBrdfs::wanted(const BrdfSettings& settings) const {
    const auto found = std::find_if(wanted_.begin(), wanted_.end(), [&](const Source& source) {
        return source.file == settings.result;
    });
    return found == wanted_.end() ? nullptr : &*found;
}

const WornBrdfs::Simulated* WornBrdfs::worn(const BrdfSettings& settings) const {
    const Source* source = wanted(settings);
    return source == nullptr ? nullptr : find(*source);
}

const WornBrdfs::Simulated* WornBrdfs::find(const Source& source) const {
    const auto found = std::find_if(made_.begin(), made_.end(),
                                    [&](const Simulated& s) { return s.source == source; });
    return found == made_.end() ? nullptr : &*found;
}

std::optional<Material> WornBrdfs::material(const BrdfSettings& settings) const {
    if (settings.type == BrdfType::Model) return analytic(settings).material;
    const Simulated* simulated = worn(settings);
    if (simulated == nullptr) return std::nullopt;
    return Material(simulated->brdf,
                    {std::max(0.0, settings.normalize_factor), in_unit_interval(settings.diffuse)});
}

QString WornBrdfs::description(const BrdfSettings& settings) const {
    if (settings.type == BrdfType::Model) return model_description(settings);
    const Simulated* simulated = worn(settings);
    const QString name = simulated != nullptr ? simulated->name : QString();
    if (simulated != nullptr && simulated->measured) return name;
    return name.isEmpty() ? tr("Simulated") : tr("Simulated, %1").arg(name);
}

io::Provenance WornBrdfs::origin() const {
    io::Provenance told;
    std::string prefix;
    for (const BrdfSettings* side : simulated_sides(view_)) {
        if (const Simulated* simulated = worn(*side))
            for (const auto& [key, value] : simulated->origin)
                told.emplace_back(prefix + key, value);
        prefix = "second-";
    }
    return told;
}

}  // namespace asperity::studio
