// SPDX-License-Identifier: Apache-2.0
#include "look_fields.h"

#include "rows.h"

#include <asperity/render/builtin_models.h>

#include <QFileInfo>
#include <QSignalBlocker>

#include <array>

namespace asperity::studio {

namespace {

/// The tone mappings there are to choose from, in the order of the list.
constexpr std::array<ToneMapping, 4> kLooks{kThesisLook,
                                            {0, ToneCurve::Aces, Transfer::Srgb},
                                            {0, ToneCurve::Reinhard, Transfer::Srgb},
                                            {0, ToneCurve::None, Transfer::Srgb}};

/// Of a mapping, whatever its exposure; -1: it is none of the list, but of a session.
int look_of(const ToneMapping& tone) {
    for (std::size_t k = 0; k < kLooks.size(); ++k)
        if (kLooks[k].curve == tone.curve && kLooks[k].transfer == tone.transfer)
            return static_cast<int>(k);
    return -1;
}

}  // namespace

LookFields::LookFields(Document& document, QWidget* parent)
    : Section(tr("Look"), parent), bindings_(document, this) {
    add_exposure();
    add_tone_mapping();
    add_depth();
}

void LookFields::add_exposure() {
    auto* exposure = new SliderField("exposure", -12, 12, 2, 0.25);
    add_row(form(), tr("Exposure"), exposure,
            tr("Stops: the radiance is multiplied by 2^exposure before the tone mapping"));
    bindings_.bind(
        exposure, tr("Exposure"),
        [](const StudioSettings& s) { return s.model_view.tone.exposure; },
        [](StudioSettings& s, double stops) { s.model_view.tone.exposure = stops; });
}

void LookFields::add_tone_mapping() {
    auto* look = new QComboBox;
    look->setObjectName("tone-mapping");
    look->addItems({tr("Thesis Look"), tr("ACES"), tr("Reinhard"), tr("None")});
    add_row(form(), tr("Tone Mapping"), look,
            tr("How radiance L becomes what a screen shows, 0 … 1. Thesis Look: L / (L + 1), then "
               "the power 1 / 2.2; ACES: the curve of Narkowicz 2015; None: cut at 1. All but the "
               "first are written as sRGB"));
    bindings_.bind(
        look, tr("Tone Mapping"),
        [](const StudioSettings& s) { return look_of(s.model_view.tone); },
        [](StudioSettings& s, int index) {
            const double exposure = s.model_view.tone.exposure;
            s.model_view.tone = kLooks[static_cast<std::size_t>(index)];
            s.model_view.tone.exposure = exposure;
        });
}

void LookFields::add_depth() {
    constexpr int kDeepest = 32;
    auto* depth = new QSpinBox;
    depth->setObjectName("depth");
    depth->setRange(1, kDeepest);
    depth->setFocusPolicy(Qt::StrongFocus);
    add_row(form(), tr("Reflections"), depth,
            tr("Reflections that light may make on its way from part to part of the model; 1 is "
               "direct light alone, the thesis' look (eq. 3.2 with no light but L_i)"));
    bindings_.bind(
        depth, tr("Reflections"), [](const StudioSettings& s) { return s.model_view.depth; },
        [](StudioSettings& s, int reflections) { s.model_view.depth = reflections; });
}

ModelFields::ModelFields(Document& document, QWidget* parent)
    : Section(tr("Model"), parent), document_(document), bindings_(document, this) {
    add_models();
    auto* floor = new QCheckBox(tr("Floor"));
    floor->setObjectName("floor");
    floor->setToolTip(tr("A round matt floor of albedo 0.5 just below the model"));
    form().addRow({}, floor);
    bindings_.bind(
        floor, tr("Floor"), [](const StudioSettings& s) { return s.model_view.floor; },
        [](StudioSettings& s, bool on) { s.model_view.floor = on; });
}

void ModelFields::add_models() {
    auto* models = new QComboBox;
    models->setObjectName("model-name");
    models->setPlaceholderText(tr("none yet"));
    const int builtin = static_cast<int>(builtin_models().size());
    for (const BuiltinModel& model : builtin_models()) {
        models->addItem(QString::fromStdString(model.name), QString::fromStdString(model.name));
        models->setItemData(models->count() - 1, QString::fromStdString(model.description),
                            Qt::ToolTipRole);
    }
    add_row(form(), tr("Model"), models,
            tr("Models that need no file, and the file that was loaded last"));

    bindings_.follow([models, builtin](const StudioSettings& settings) {
        const QSignalBlocker quiet(models);
        const QString name = QString::fromStdString(settings.model_view.model);
        if (!name.isEmpty() && models->findData(name) < 0) {
            while (models->count() > builtin) models->removeItem(builtin);
            models->addItem(QFileInfo(name).fileName(), name);
        }
        models->setCurrentIndex(name.isEmpty() ? -1 : models->findData(name));
    });
    connect(models, &QComboBox::activated, this, [this, models](int index) {
        document_.change(tr("Load Model"), [&](StudioSettings& settings) {
            settings.model_view.model = models->itemData(index).toString().toStdString();
        });
    });
}

}  // namespace asperity::studio
