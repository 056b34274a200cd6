// SPDX-License-Identifier: Apache-2.0
#include "light_fields.h"

#include "file_field.h"
#include "rows.h"

#include <QComboBox>
#include <QHBoxLayout>

#include <array>
#include <utility>

namespace asperity::studio {

LightFields::LightFields(Document& document, QWidget* parent)
    : Section(tr("Light"), parent), document_(document), bindings_(document, this) {
    add_kind();
    const std::array<QWidget*, 3> fields{point_fields(), sky_fields(), environment_fields()};
    for (QWidget* kind : fields) form().addRow(kind);
    bindings_.follow([fields](const StudioSettings& settings) {
        for (std::size_t kind = 0; kind < fields.size(); ++kind)
            fields[kind]->setVisible(settings.model_view.light == static_cast<LightKind>(kind));
    });
}

void LightFields::add_kind() {
    auto* kind = new QComboBox;
    kind->setObjectName("light-kind");
    kind->addItems(
        {tr("Point"), tr("Sky"), tr("Environment"), tr("Soft sky")});  // in the order of LightKind
    add_row(form(), tr("Light Kind"), kind,
            tr("L of the rendering equation (thesis eq. 3.2): a point as in the thesis, a clear "
               "sky with its sun, a picture of the surroundings, or the even light of a "
               "photographer's room"));
    bindings_.bind(
        kind, tr("Light Kind"),
        [](const StudioSettings& s) { return static_cast<int>(s.model_view.light); },
        [](StudioSettings& s, int index) { s.model_view.light = static_cast<LightKind>(index); });
}

QWidget* LightFields::point_fields() {
    auto* fields = new QWidget;
    auto* rows = new_rows(fields);
    add_row(*rows, tr("Light Position"), position_field(),
            tr("x to the right, y up, z to the viewer; models have radius 1 about the origin"));
    add_row(
        *rows, tr("Light Intensity"),
        number("light-intensity", tr("Light Intensity"), 0, 1000, 1, &ModelView::light_intensity),
        tr("Radiant intensity I [W/sr]: the irradiance is I / distance²; the thesis' is 300, in a "
           "scene of another scale"));
    return fields;
}

QWidget* LightFields::position_field() {
    constexpr double kFarthest = 100;
    auto* field = new QWidget;
    auto* layout = new QHBoxLayout(field);
    layout->setContentsMargins(0, 0, 0, 0);
    const std::array<std::pair<const char*, double Vec3::*>, 3> axes{
        {{"x", &Vec3::x}, {"y", &Vec3::y}, {"z", &Vec3::z}}};
    for (const auto& [name, axis] : axes) {
        auto* box = new NumberBox(-kFarthest, kFarthest, 2, 0.1);
        box->setObjectName(QString("light-") + name);
        box->setAccessibleName(tr("Light Position %1").arg(name));
        box->setButtonSymbols(QAbstractSpinBox::NoButtons);  // three in a narrow row
        layout->addWidget(box);
        const auto member = axis;
        bindings_.bind(
            box, tr("Light Position"),
            [member](const StudioSettings& s) { return s.model_view.light_position.*member; },
            [member](StudioSettings& s, double x) { s.model_view.light_position.*member = x; });
    }
    return field;
}

QWidget* LightFields::sky_fields() {
    auto* fields = new QWidget;
    auto* rows = new_rows(fields);
    add_row(*rows, tr("Sun Elevation"),
            number("sun-elevation", tr("Sun Elevation"), 0, 90, 1, &ModelView::sun_elevation_deg),
            tr("Degrees above the horizon, 0 … 90 (sky of Preetham, Shirley and Smits 1999)"));
    add_row(*rows, tr("Sun Azimuth"),
            number("sun-azimuth", tr("Sun Azimuth"), 0, 360, 1, &ModelView::sun_azimuth_deg),
            tr("Degrees: 0 behind the model, 90 to its right, 180 behind the viewer"));
    return fields;
}

QWidget* LightFields::environment_fields() {
    auto* fields = new QWidget;
    auto* rows = new_rows(fields);
    auto* file = new FileField("environment", tr("Open Environment"),
                               tr("Environments (*.exr *.hdr);;All files (*)"));
    file->set_placeholder(tr("a latitude-longitude .exr or .hdr"));
    add_row(*rows, tr("Environment"), file,
            tr("A latitude-longitude picture of the radiance all round (thesis eq. 4.5)"));
    add_row(*rows, tr("Rotation"),
            number("environment-rotation", tr("Rotation"), -180, 180, 1,
                   &ModelView::environment_rotation_deg),
            tr("Degrees about the upright axis, counter-clockwise seen from above"));
    bindings_.follow([file](const StudioSettings& s) {
        file->set_path(QString::fromStdString(s.model_view.environment));
    });
    connect(file, &FileField::chosen, this, [this](const QString& path) {
        document_.change(tr("Environment"),
                         [&](StudioSettings& s) { s.model_view.environment = path.toStdString(); });
    });
    return fields;
}

SliderField* LightFields::number(const QString& name, const QString& what, double low, double high,
                                 double step, double ModelView::*value) {
    auto* field = new SliderField(name, low, high, 2, step);
    bindings_.bind(
        field, what, [value](const StudioSettings& s) { return s.model_view.*value; },
        [value](StudioSettings& s, double x) { s.model_view.*value = x; });
    return field;
}

}  // namespace asperity::studio
