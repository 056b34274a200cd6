// SPDX-License-Identifier: Apache-2.0
#include "surface_fields.h"

#include "../model/settings_keys.h"
#include "../model/words.h"
#include "channel_list.h"
#include "file_kinds.h"
#include "file_questions.h"
#include "file_surface_form.h"
#include "param_control.h"
#include "progress_row.h"
#include "show_dialog.h"
#include "surface_file_dialog.h"

#include <asperity/surface/surface_kinds.h>

#include <QFileInfo>
#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QSignalBlocker>

#include <algorithm>

namespace asperity::studio {

namespace {

using S = SurfaceSettings;

bool is_thesis(const S& s) {
    return s.kind == "thesis";
}
bool is_periodic_shape(const S& s) {
    return surface_uses(s.kind, "period");
}

// Sizes that are made at once; the thesis' own were 120 .. 512
constexpr int kThesisLeast = 120, kLeast = 16, kMost = 4096;

/// Makes the size one that the kind can have: not below the thesis' for its noise, whole periods.
void fit_size(S& s) {
    if (is_thesis(s)) s.size = std::max(s.size, kThesisLeast);
    if (is_periodic_shape(s)) s.size = s.period * std::max(1, (s.size + s.period / 2) / s.period);
}

/// The kinds in the order of the list; the last entry is that of files.
std::vector<std::string> kind_names() {
    std::vector<std::string> names;
    for (const SurfaceKind& kind : surface_kinds()) names.push_back(kind.name);
    names.emplace_back(kSurfaceFile);
    return names;
}

/// The settings that have fields of their own, below or in another window.
bool is_special(const std::string& name) {
    for (const char* special : {"surface", "size", "alpha", "correlation-length", "period",
                                "along-y", "cell-size", "boundary", "diagonal"})
        if (name == special) return true;
    // Those of files alone are in the window Surface File
    return !surface_uses("", name) && surface_uses(kSurfaceFile, name);
}

}  // namespace

SurfaceFields::SurfaceFields(Workbench& workbench, QWidget* parent)
    : Section(tr("Surface Settings"), parent),
      workbench_(workbench),
      bindings_(workbench.document(), this),
      lock_(workbench, this) {
    add_kind();
    for (const Param<StudioSettings>& param : all_params())
        if (param.info.group == "Surface") add_setting(param);
    add_file();
    add_size();
    bindings_.follow([this](const StudioSettings&) { show_rows(); });
}

void SurfaceFields::add_row(const QString& label, QWidget* control, const QString& tooltip,
                            Shown shown) {
    add_named_row(label, control, tooltip);
    lock_.add(control);
    rows_.push_back({control, std::move(shown)});
}

void SurfaceFields::add_setting(const Param<StudioSettings>& param) {
    const std::string& name = param.info.name;
    // Files have all their settings in a window of their own
    const Shown used = [unused = param.unused](const StudioSettings& s) {
        return unused(s).empty() && s.experiment.surface.kind != kSurfaceFile;
    };
    const QString label = QString::fromStdString(asperity::label(param.info));
    if (name == "alpha") add_alphas(param, used);
    if (name == "correlation-length") add_correlation_length(param, used);
    if (name == "period") add_period(param, used);
    if (name == "along-y") add_direction(param, used);
    if (!is_special(name))
        add_row(label, make_control(param, label, bindings_, workbench_.document()),
                tooltip_of(param), used);
}

void SurfaceFields::show_rows() {
    const StudioSettings& settings = workbench_.settings();
    for (const Row& row : rows_) form().setRowVisible(row.control, row.shown(settings));
}

void SurfaceFields::add_kind() {
    auto* kinds = new QComboBox;
    for (const SurfaceKind& kind : surface_kinds()) {
        kinds->addItem(QString::fromStdString(kind.label));
        kinds->setItemData(kinds->count() - 1, QString::fromStdString(kind.doc), Qt::ToolTipRole);
    }
    kinds->addItem(tr("File..."));
    const auto index_of = [names = kind_names()](const S& s) {
        return static_cast<int>(std::find(names.begin(), names.end(), s.kind) - names.begin());
    };
    add_row(tr("Surface Kind"), kinds, tr("How the heights of the microsurface are made"),
            [](const StudioSettings&) { return true; });
    bindings_.follow([kinds, index_of](const StudioSettings& settings) {
        const QSignalBlocker quiet(kinds);
        kinds->setCurrentIndex(index_of(settings.experiment.surface));
    });
    connect(kinds, &QComboBox::currentIndexChanged, this, [this, kinds, index_of](int index) {
        const std::string kind = kind_names()[static_cast<std::size_t>(index)];
        const S& now = workbench_.settings().experiment.surface;
        if (kind == kSurfaceFile && now.file.empty()) {
            // Not before there is one
            const QSignalBlocker quiet(kinds);
            kinds->setCurrentIndex(index_of(now));
            open_file();
            return;
        }
        workbench_.document().change(tr("Surface Kind"), [&](StudioSettings& settings) {
            settings.experiment.surface.kind = kind;
            fit_size(settings.experiment.surface);
        });
    });
}

void SurfaceFields::add_alphas(const Param<StudioSettings>& param, const Shown& used) {
    const auto add_alpha = [&](const QString& label, double S::*alpha) {
        auto* field = new SliderField(kebab_case(label), 0.01, 2, 4, 0.01);
        field->box().setRange(param.info.range.low, param.info.range.high);
        add_row(label, field, tooltip_of(param), used);
        bindings_.bind(
            field, label, [alpha](const StudioSettings& s) { return s.experiment.surface.*alpha; },
            [alpha](StudioSettings& s, double value) { s.experiment.surface.*alpha = value; });
    };
    add_alpha(tr("Alpha X"), &S::alpha_x);
    add_alpha(tr("Alpha Y"), &S::alpha_y);
}

void SurfaceFields::add_correlation_length(const Param<StudioSettings>& param, const Shown& used) {
    auto* length = new NumberBox(param.info.range.low, param.info.range.high, 2, 1);
    length->setSuffix(tr(" cells"));
    add_row(tr("Correlation Length"), length, tooltip_of(param), used);
    bindings_.bind(
        length, tr("Correlation Length"),
        [](const StudioSettings& s) { return s.experiment.surface.correlation_x; },
        [](StudioSettings& s, double value) {
            s.experiment.surface.correlation_x = s.experiment.surface.correlation_y = value;
        });
}

void SurfaceFields::add_period(const Param<StudioSettings>& param, const Shown& used) {
    auto* period = new QSpinBox;
    period->setRange(4, kMost);  // all kinds have a period of four
    period->setSingleStep(2);
    period->setSuffix(tr(" cells"));
    add_row(tr("Period"), period, tooltip_of(param), used);
    bindings_.bind(
        period, tr("Period"), [](const StudioSettings& s) { return s.experiment.surface.period; },
        [](StudioSettings& s, int value) {
            s.experiment.surface.period = value + value % 2;  // ridges lie on samples
            fit_size(s.experiment.surface);
        });
}

void SurfaceFields::add_direction(const Param<StudioSettings>& param, const Shown& used) {
    auto* along = new QComboBox;
    along->setObjectName("along-y");
    along->addItems({tr("along x"), tr("along y")});
    add_row(tr("Varies"), along, tooltip_of(param), used);
    bindings_.bind(
        along, tr("Direction"),
        [](const StudioSettings& s) { return s.experiment.surface.along_y ? 1 : 0; },
        [](StudioSettings& s, int index) { s.experiment.surface.along_y = index == 1; });
}

void SurfaceFields::add_file() {
    const Shown is_file = [](const StudioSettings& s) {
        return s.experiment.surface.kind == kSurfaceFile;
    };
    auto* file = new QPushButton;
    file->setObjectName("surface-file");
    add_row(tr("File"), file, tr("Heights from a file, as instruments write them"), is_file);
    connect(file, &QPushButton::clicked, this, &SurfaceFields::open_file);
    bindings_.follow([file](const StudioSettings& settings) {
        const QString path = QString::fromStdString(settings.experiment.surface.file);
        file->setText(QFileInfo(path).fileName());
    });
    add_row(tr("Channel"), new ChannelList(workbench_), tr("What the file holds"), is_file);
    auto* ready = new QPushButton(tr("Make Ready..."));
    ready->setObjectName("make-ready");
    add_row(
        tr("Preparation"), ready,
        tr("Units, missing points, outliers, form, filters, crop; the surface before and after, "
           "and its figures"),
        is_file);
    connect(ready, &QPushButton::clicked, this,
            [this] { show_dialog<SurfaceFileDialog>(workbench_, *window()); });
    add_file_note(is_file);
}

/// What became of the file, in three lines whatever it is.
void SurfaceFields::add_file_note(const Shown& is_file) {
    constexpr int kLines = 3;
    auto* note = new QLabel;
    note->setObjectName("surface-file-note");
    note->setWordWrap(true);
    note->setAlignment(Qt::AlignTop | Qt::AlignLeft);
    note->setFixedHeight(kLines * note->fontMetrics().lineSpacing() + 2);
    form().addRow(note);
    rows_.push_back({note, is_file});
    const auto show = [this, note] {
        const SurfaceSource& surface = workbench_.surface();
        const FileReading* reading = surface.reading();
        const QString trouble = in_words_of_forms(surface.trouble());
        QString text = trouble;
        if (surface.busy())
            text = tr("being read and made ready");
        else if (trouble.isEmpty() && reading != nullptr)
            text = QString::fromStdString(
                reading->after.caption() + "; " +
                (reading->prepared.empty() ? reading->tiling : reading->prepared));
        QPalette colours;
        if (!trouble.isEmpty()) colours.setColor(QPalette::WindowText, trouble_colour());
        note->setPalette(colours);
        note->setText(text);
        note->setToolTip(text);
    };
    for (const auto signal : {&SurfaceSource::started, &SurfaceSource::ready})
        connect(&workbench_.surface(), signal, note, show);
    connect(&workbench_.surface(), &SurfaceSource::failed, note, show);
    show();
}

void SurfaceFields::add_size() {
    auto* pair = new QWidget;
    pair->setObjectName("surface-size-row");
    auto* layout = new QHBoxLayout(pair);
    layout->setContentsMargins(0, 0, 0, 0);
    size_ = new QSpinBox;
    size_->setObjectName("surface-size");
    size_->setAccessibleName(tr("Surface Size"));
    auto* apply = new QPushButton(tr("Apply Size"));
    apply->setObjectName("apply-size");
    apply->setToolTip(tr("Makes the surface anew with the size beside"));
    layout->addWidget(size_, 1);
    layout->addWidget(apply);
    pair->setFocusProxy(size_);
    add_row(tr("Surface Size"), pair,
            tr("Samples on a side, 4096 at most; the thesis noise had 120 .. 512. A cell holds two "
               "triangles, so 120 gives 28800. Apply Size makes the surface"),
            [](const StudioSettings& s) { return s.experiment.surface.kind != kSurfaceFile; });
    bindings_.follow([this](const StudioSettings& settings) {
        const S& surface = settings.experiment.surface;
        const QSignalBlocker quiet(size_);
        size_->setRange(is_thesis(surface) ? kThesisLeast : kLeast, kMost);
        size_->setSingleStep(is_periodic_shape(surface) ? surface.period : 8);
        // What was typed and not applied yet outlives changes of other settings
        if (surface.size == size_shown_) return;
        size_->setValue(surface.size);
        size_shown_ = surface.size;
    });
    connect(apply, &QPushButton::clicked, this, &SurfaceFields::apply_size);
}

void SurfaceFields::apply_size() {
    size_->interpretText();
    size_shown_ = 0;
    workbench_.document().change(tr("Surface Size"), [this](StudioSettings& settings) {
        settings.experiment.surface.size = size_->value();
        fit_size(settings.experiment.surface);
    });
}

void SurfaceFields::open_file() {
    ask_file_to_open(
        window(), tr("Open Surface File"), surface_filter(),
        [this](const QString& path) { take_surface_file(workbench_.document(), path); });
}

}  // namespace asperity::studio
