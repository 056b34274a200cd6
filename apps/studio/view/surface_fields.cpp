// SPDX-License-Identifier: Apache-2.0
#include "surface_fields.h"

#include "file_questions.h"

#include <QFileInfo>
#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QSignalBlocker>

#include <algorithm>
#include <limits>

namespace asperity::studio {

namespace {

using Kind = SurfaceKind;
using S = SurfaceSettings;

// Which kinds have which fields
bool always(const S&) {
    return true;
}
bool is_made(const S& s) {
    return s.kind != Kind::File;
}
bool is_thesis(const S& s) {
    return s.kind == Kind::Thesis;
}
bool is_gaussian(const S& s) {
    return s.kind == Kind::Gaussian;
}
bool is_ggx(const S& s) {
    return s.kind == Kind::Ggx;
}
bool is_random_field(const S& s) {
    return is_gaussian(s) || is_ggx(s);
}
bool is_random(const S& s) {
    return is_thesis(s) || is_random_field(s);
}
bool is_self_affine(const S& s) {
    return is_gaussian(s) && s.autocorrelation == Autocorrelation::SelfAffine;
}
bool is_wave(const S& s) {
    return s.kind == Kind::Sinusoid || s.kind == Kind::Eggcrate;
}
bool is_tilted(const S& s) {
    return s.kind == Kind::Tilted || s.kind == Kind::VGroove || s.kind == Kind::Sawtooth ||
           s.kind == Kind::Pyramids;
}
bool is_periodic_shape(const S& s) {
    return is_wave(s) || (is_tilted(s) && s.kind != Kind::Tilted);
}
bool has_direction(const S& s) {
    return s.kind == Kind::Tilted || s.kind == Kind::VGroove || s.kind == Kind::Sawtooth ||
           s.kind == Kind::Sinusoid;
}
bool is_file(const S& s) {
    return s.kind == Kind::File;
}

// The thesis' sizes, and those of all other kinds
constexpr int kThesisLeast = 120, kThesisMost = 512, kLeast = 16, kMost = 4096;

/// Makes the size one that the kind can have: within the thesis' range, whole periods.
void fit_size(S& s) {
    if (is_thesis(s)) s.size = std::clamp(s.size, kThesisLeast, kThesisMost);
    if (is_periodic_shape(s)) s.size = s.period * std::max(1, (s.size + s.period / 2) / s.period);
}

}  // namespace

SurfaceFields::SurfaceFields(Workbench& workbench, QWidget* parent)
    : Section(tr("Surface Settings"), parent),
      workbench_(workbench),
      bindings_(workbench.document(), this),
      lock_(workbench, this) {
    add_kind();
    add_thesis_fields();
    add_random_fields();
    add_shape_fields();
    add_file_fields();
    add_size();
    bindings_.follow([this](const StudioSettings&) { show_rows(); });
}

void SurfaceFields::add_row(const QString& label, QWidget* control, const QString& tooltip,
                            Shown shown) {
    add_named_row(label, control, tooltip);
    lock_.add(control);
    rows_.push_back({control, shown});
}

void SurfaceFields::show_rows() {
    const S& surface = workbench_.settings().experiment.surface;
    for (const Row& row : rows_) form().setRowVisible(row.control, row.shown(surface));
}

void SurfaceFields::add_kind() {
    auto* kinds = new QComboBox;
    // In the order of SurfaceKind
    kinds->addItems({tr("Thesis noise"), tr("Gaussian"), tr("GGX"), tr("Flat"), tr("Tilted facet"),
                     tr("V-grooves"), tr("Sawtooth"), tr("Pyramids"), tr("Sinusoid"),
                     tr("Egg crate"), tr("File...")});
    add_row(tr("Surface Kind"), kinds, tr("How the heights of the microsurface are made"), always);
    bindings_.follow([kinds](const StudioSettings& settings) {
        const QSignalBlocker quiet(kinds);
        kinds->setCurrentIndex(static_cast<int>(settings.experiment.surface.kind));
    });
    connect(kinds, &QComboBox::currentIndexChanged, this, [this, kinds](int index) {
        const auto kind = static_cast<SurfaceKind>(index);
        const S& now = workbench_.settings().experiment.surface;
        if (kind == Kind::File && now.file.empty()) {
            // Not before there is one
            const QSignalBlocker quiet(kinds);
            kinds->setCurrentIndex(static_cast<int>(now.kind));
            open_file();
            return;
        }
        workbench_.document().change(tr("Surface Kind"), [&](StudioSettings& settings) {
            settings.experiment.surface.kind = kind;
            fit_size(settings.experiment.surface);
        });
    });
}

void SurfaceFields::add_thesis_fields() {
    auto* roughness = new SliderField("surface-roughness", 0, 1, 3, 0.01);
    add_row(tr("Surface Roughness"), roughness,
            tr("Heights are independent and uniform in 0 .. 10 roughness, in cells: 0 is a mirror, "
               "1 scatters in all directions (thesis 2.2.2)"),
            is_thesis);
    bindings_.bind(
        roughness, tr("Surface Roughness"),
        [](const StudioSettings& s) { return s.experiment.surface.roughness; },
        [](StudioSettings& s, double value) { s.experiment.surface.roughness = value; });
}

void SurfaceFields::add_random_fields() {
    const auto add_alpha = [this](const QString& label, double S::*alpha) {
        auto* field = new SliderField(kebab_case(label), 0.01, 2, 4, 0.01);
        field->box().setRange(1e-4, 100);
        add_row(label, field,
                tr("Width of the distribution of facet slopes, dimensionless: Beckmann and GGX "
                   "alpha, sqrt(2) times the RMS slope of a Gaussian surface"),
                is_random_field);
        bindings_.bind(
            field, label, [alpha](const StudioSettings& s) { return s.experiment.surface.*alpha; },
            [alpha](StudioSettings& s, double value) { s.experiment.surface.*alpha = value; });
    };
    add_alpha(tr("Alpha X"), &S::alpha_x);
    add_alpha(tr("Alpha Y"), &S::alpha_y);

    auto* kinds = new QComboBox;
    kinds->addItems({tr("Gaussian"), tr("Exponential"), tr("Self-affine")});
    add_row(tr("Autocorrelation"), kinds,
            tr("How neighbouring heights are related: exp(-r²/L²), exp(-r/L), or the power "
               "spectrum 1/(1 + (kL)²)^(1 + H)"),
            is_gaussian);
    bindings_.bind(
        kinds, tr("Autocorrelation"),
        [](const StudioSettings& s) {
            return static_cast<int>(s.experiment.surface.autocorrelation);
        },
        [](StudioSettings& s, int index) {
            s.experiment.surface.autocorrelation = static_cast<Autocorrelation>(index);
        });

    auto* length = new NumberBox(0.1, kMost, 2, 1);
    length->setSuffix(tr(" cells"));
    add_row(tr("Correlation Length"), length,
            tr("L, the distance at which heights forget each other"), is_random_field);
    bindings_.bind(
        length, tr("Correlation Length"),
        [](const StudioSettings& s) { return s.experiment.surface.correlation_x; },
        [](StudioSettings& s, double value) {
            s.experiment.surface.correlation_x = s.experiment.surface.correlation_y = value;
        });

    auto* hurst = new SliderField("hurst", 0.05, 1, 2, 0.05);
    add_row(tr("Hurst Exponent"), hurst, tr("H of a self-affine surface: small is jagged"),
            is_self_affine);
    bindings_.bind(
        hurst, tr("Hurst Exponent"),
        [](const StudioSettings& s) { return s.experiment.surface.hurst; },
        [](StudioSettings& s, double value) { s.experiment.surface.hurst = value; });

    auto* slope = new NumberBox(0.01, 1e6, 2, 1);
    add_row(tr("Max Slope"), slope, tr("Steeper facets of the GGX surface are cut to this slope"),
            is_ggx);
    bindings_.bind(
        slope, tr("Max Slope"),
        [](const StudioSettings& s) { return s.experiment.surface.max_slope; },
        [](StudioSettings& s, double value) { s.experiment.surface.max_slope = value; });

    auto* seed = new QSpinBox;
    seed->setRange(0, std::numeric_limits<int>::max());
    add_row(tr("Surface Seed"), seed, tr("Another number, another surface of the same kind"),
            is_random);
    bindings_.bind(
        seed, tr("Surface Seed"),
        [](const StudioSettings& s) { return static_cast<int>(s.experiment.surface.seed); },
        [](StudioSettings& s, int value) {
            s.experiment.surface.seed = static_cast<std::uint64_t>(value);
        });
}

void SurfaceFields::add_shape_fields() {
    auto* tilt = new SliderField("tilt", 0, 89, 2, 1);
    tilt->box().setSuffix("°");
    add_row(tr("Facet Tilt"), tilt, tr("Angle of the facets from the horizontal, in degrees"),
            is_tilted);
    bindings_.bind(
        tilt, tr("Facet Tilt"),
        [](const StudioSettings& s) { return s.experiment.surface.tilt_deg; },
        [](StudioSettings& s, double value) { s.experiment.surface.tilt_deg = value; });

    auto* period = new QSpinBox;
    period->setRange(4, 512);
    period->setSingleStep(2);
    period->setSuffix(tr(" cells"));
    add_row(tr("Period"), period, tr("Cells until the shape repeats; the size is made a multiple"),
            is_periodic_shape);
    bindings_.bind(
        period, tr("Period"), [](const StudioSettings& s) { return s.experiment.surface.period; },
        [](StudioSettings& s, int value) {
            s.experiment.surface.period = value + value % 2;  // ridges lie on samples
            fit_size(s.experiment.surface);
        });

    auto* amplitude = new NumberBox(0, 1000, 3, 0.5);
    amplitude->setSuffix(tr(" cells"));
    add_row(tr("Amplitude"), amplitude, tr("Of the wave, from its middle"), is_wave);
    bindings_.bind(
        amplitude, tr("Amplitude"),
        [](const StudioSettings& s) { return s.experiment.surface.amplitude; },
        [](StudioSettings& s, double value) { s.experiment.surface.amplitude = value; });

    auto* along = new QComboBox;
    along->setObjectName("along-y");
    along->addItems({tr("along x"), tr("along y")});
    add_row(tr("Varies"), along, tr("Direction in which the heights change"), has_direction);
    bindings_.bind(
        along, tr("Direction"),
        [](const StudioSettings& s) { return s.experiment.surface.along_y ? 1 : 0; },
        [](StudioSettings& s, int index) { s.experiment.surface.along_y = index == 1; });
}

void SurfaceFields::add_file_fields() {
    auto* file = new QPushButton;
    file->setObjectName("surface-file");
    add_row(tr("File"), file, tr("Heights from a file: .gsf, .exr, 16-bit .png, .txt, .csv, .asc"),
            is_file);
    connect(file, &QPushButton::clicked, this, &SurfaceFields::open_file);
    bindings_.follow([file](const StudioSettings& settings) {
        const QString path = QString::fromStdString(settings.experiment.surface.file);
        file->setText(QFileInfo(path).fileName());
    });

    auto* tiling = new QComboBox;
    tiling->addItems({tr("Automatic"), tr("Mirrored"), tr("Periodic"), tr("Finite patch")});
    add_row(tr("Tiling"), tiling, tr("How the heights of a file are made to fill the plane"),
            is_file);
    bindings_.bind(
        tiling, tr("Tiling"),
        [](const StudioSettings& s) { return static_cast<int>(s.experiment.surface.tiling); },
        [](StudioSettings& s, int index) {
            s.experiment.surface.tiling = static_cast<Tiling>(index);
        });

    auto* scale = new NumberBox(-1e9, 1e9, 4, 0.1);
    add_row(tr("Height Scale"), scale,
            tr("Multiplies the heights, and so the slopes; below zero turns the surface over"),
            is_file);
    bindings_.bind(
        scale, tr("Height Scale"),
        [](const StudioSettings& s) { return s.experiment.surface.height_scale; },
        [](StudioSettings& s, double value) { s.experiment.surface.height_scale = value; });
}

void SurfaceFields::add_size() {
    auto* pair = new QWidget;
    pair->setObjectName("surface-size-row");
    auto* layout = new QHBoxLayout(pair);
    layout->setContentsMargins(0, 0, 0, 0);
    size_ = new QSpinBox;
    size_->setObjectName("surface-size");
    auto* apply = new QPushButton(tr("Apply Size"));
    apply->setObjectName("apply-size");
    apply->setToolTip(tr("Makes the surface anew with the size beside"));
    layout->addWidget(size_, 1);
    layout->addWidget(apply);
    pair->setFocusProxy(size_);
    add_row(tr("Surface Size"), pair,
            tr("Samples on a side: 120 .. 512 for the thesis noise. A cell holds two triangles, so "
               "120 gives 28800. Apply Size makes the surface"),
            is_made);
    bindings_.follow([this](const StudioSettings& settings) {
        const S& surface = settings.experiment.surface;
        const QSignalBlocker quiet(size_);
        size_->setRange(is_thesis(surface) ? kThesisLeast : kLeast,
                        is_thesis(surface) ? kThesisMost : kMost);
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
    ask_file_to_open(window(), tr("Open Surface File"),
                     tr("Heights (*.gsf *.exr *.png *.txt *.csv *.asc *.dat);;All files (*)"),
                     [this](const QString& path) {
                         workbench_.document().change(
                             tr("Surface File"), [&path](StudioSettings& settings) {
                                 settings.experiment.surface.kind = Kind::File;
                                 settings.experiment.surface.file = path.toStdString();
                             });
                     });
}

}  // namespace asperity::studio
