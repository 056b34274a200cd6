// SPDX-License-Identifier: Apache-2.0
#include "brdf_fields.h"

#include "rows.h"

#include <QComboBox>

namespace asperity::studio {

BrdfFields::BrdfFields(Document& document, Bindings& bindings, Which which, const QString& prefix,
                       const QString& side, QWidget* parent)
    : QWidget(parent),
      document_(document),
      bindings_(bindings),
      which_(which),
      prefix_(prefix),
      side_(side) {
    auto* form = new_rows(this);
    add_type(*form);
    QWidget* const cook_torrance = cook_torrance_fields();
    QWidget* const simulated = simulated_fields();
    form->addRow(cook_torrance);
    form->addRow(simulated);
    bindings_.follow([this, cook_torrance, simulated](const StudioSettings& settings) {
        const BrdfType type = (settings.model_view.*which_).type;
        cook_torrance->setVisible(type == BrdfType::CookTorrance);
        simulated->setVisible(type == BrdfType::Simulated);
    });
}

void BrdfFields::add_type(QFormLayout& form) {
    auto* type = new QComboBox;
    type->setObjectName(prefix_ + "brdf-type");
    type->addItems({tr("Cook Torrance"), tr("Simulated")});  // in the order of BrdfType
    add_row(form, tr("BRDF Type"), type,
            tr("What the model wears: the analytic model of thesis eq. 4.2 and 4.4, or the layers "
               "that were drawn or read from a result"));
    const Which which = which_;
    bindings_.bind(
        type, tr("BRDF Type") + side_,
        [which](const StudioSettings& s) { return static_cast<int>((s.model_view.*which).type); },
        [which](StudioSettings& s, int index) {
            (s.model_view.*which).type = static_cast<BrdfType>(index);
        });
}

QWidget* BrdfFields::cook_torrance_fields() {
    auto* fields = new QWidget;
    fields->setObjectName(prefix_ + "cook-torrance-fields");
    auto* form = new_rows(fields);
    add_row(*form, tr("Metallic"),
            number("metallic", tr("Metallic"), 1, 0.01, &BrdfSettings::metallic),
            tr("0 … 1, no unit: F0 = 0.04 + (albedo − 0.04) · metallic of Schlick's Fresnel term "
               "(thesis eq. 3.3); a metal has no diffuse part (eq. 4.4)"));
    add_row(*form, tr("Roughness"),
            number("roughness", tr("Roughness"), 1, 0.01, &BrdfSettings::roughness),
            tr("0 … 1, no unit: α = roughness² of the distribution of normals (thesis eq. 3.8), "
               "k = (roughness + 1)² / 8 of the shadowing (eq. 3.6); below 0.01 counts as 0.01"));
    add_row(*form, tr("Albedo"), colour("albedo", tr("Albedo"), &BrdfSettings::albedo),
            tr("Red, green, blue, each 0 … 1: c of thesis eq. 4.4, the colour of the diffuse part "
               "and of a metal's highlight"));
    return fields;
}

QWidget* BrdfFields::simulated_fields() {
    constexpr double kMostFactor = 100;
    auto* fields = new QWidget;
    fields->setObjectName(prefix_ + "simulated-fields");
    auto* form = new_rows(fields);
    add_row(*form, tr("Normalize Factor"),
            number("normalize-factor", tr("Normalize Factor"), kMostFactor, 0.01,
                   &BrdfSettings::normalize_factor),
            tr("0 … 100, no unit: multiplies the simulated BRDF [1/sr]; 1 is physically right"));
    add_row(*form, tr("Albedo"), colour("diffuse", tr("Albedo"), &BrdfSettings::diffuse),
            tr("Red, green, blue, each 0 … 1: albedo / π is added to the simulated BRDF (the "
               "diffuse part of thesis eq. 4.4)"));
    return fields;
}

QWidget* BrdfFields::number(const QString& name, const QString& what, double high, double step,
                            double BrdfSettings::*value) {
    const Which which = which_;
    const auto read = [which, value](const StudioSettings& s) {
        return s.model_view.*which.*value;
    };
    const auto write = [which, value](StudioSettings& s, double x) {
        s.model_view.*which.*value = x;
    };
    if (high > 1) {  // no slider is fine enough about 1 and long enough for the rest
        auto* box = new NumberBox(0, high, 3, 0.1);
        box->setObjectName(prefix_ + name);
        bindings_.bind(box, what + side_, read, write);
        return box;
    }
    auto* field = new SliderField(prefix_ + name, 0, high, 3, step);
    bindings_.bind(field, what + side_, read, write);
    return field;
}

QWidget* BrdfFields::colour(const QString& name, const QString& what, Rgb BrdfSettings::*value) {
    auto* field = new ColourField(prefix_ + name);
    const Which which = which_;
    bindings_.follow([field, which, value](const StudioSettings& s) {
        field->set_value(s.model_view.*which.*value);
    });
    connect(field, &ColourField::changed, this, [this, what, which, value](Rgb chosen) {
        document_.change(what + side_,
                         [&](StudioSettings& s) { s.model_view.*which.*value = chosen; });
    });
    return field;
}

}  // namespace asperity::studio
