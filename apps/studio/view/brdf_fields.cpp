// SPDX-License-Identifier: Apache-2.0
#include "brdf_fields.h"

#include "file_field.h"
#include "file_kinds.h"
#include "model_form.h"
#include "rows.h"

#include <QComboBox>
#include <QVBoxLayout>

#include <algorithm>

namespace asperity::studio {

BrdfFields::BrdfFields(Document& document, Bindings& bindings, Which which, const QString& prefix,
                       const QString& side, QWidget* parent)
    : QWidget(parent),
      document_(document),
      bindings_(bindings),
      which_(which),
      prefix_(prefix),
      side_(side),
      place_(new QWidget) {
    auto* form = new_rows(this);
    add_type(*form);
    auto* column = new QVBoxLayout(place_);
    column->setContentsMargins(0, 0, 0, 0);
    QWidget* const simulated = simulated_fields();
    form->addRow(place_);
    form->addRow(simulated);
    bindings_.follow([this, simulated](const StudioSettings& settings) {
        const BrdfSettings& brdf = settings.model_view.*which_;
        show_model(brdf.model);
        place_->setVisible(brdf.type == BrdfType::Model);
        simulated->setVisible(brdf.type == BrdfType::Simulated);
    });
}

void BrdfFields::add_type(QFormLayout& form) {
    auto* type = new QComboBox;
    type->setObjectName(prefix_ + "brdf-type");
    QString models;
    for (const BsdfModel& model : bsdf_models()) {
        models_.push_back(model.name);
        const QString name = QString::fromStdString(model.label.empty() ? model.name : model.label);
        type->addItem(name);
        type->setItemData(type->count() - 1, QString::fromStdString(model.doc), Qt::ToolTipRole);
        models += "\n" + name + ": " + QString::fromStdString(model.doc);
    }
    type->addItem(tr("Simulated"));
    add_row(form, tr("BRDF Type"), type,
            tr("What the model wears: an analytic model, or the layers that were drawn or a file "
               "that was opened") +
                models);
    const Which which = which_;
    bindings_.bind(
        type, tr("BRDF Type") + side_,
        [which, models = models_](const StudioSettings& s) {
            const BrdfSettings& brdf = s.model_view.*which;
            const auto found = brdf.type == BrdfType::Simulated
                                   ? models.end()
                                   : std::find(models.begin(), models.end(), brdf.model);
            return static_cast<int>(found - models.begin());
        },
        [which, models = models_](StudioSettings& s, int index) {
            BrdfSettings& brdf = s.model_view.*which;
            const auto place = static_cast<std::size_t>(index);
            brdf.type = place < models.size() ? BrdfType::Model : BrdfType::Simulated;
            if (place < models.size()) brdf.model = models[place];
        });
}

/// Names of controls are those of the parameters, which models share: there are fields of one model
/// at a time.
void BrdfFields::show_model(const std::string& name) {
    if (fields_ != nullptr && name == shown_model_) return;
    if (fields_ != nullptr) {
        fields_->hide();
        fields_->setParent(nullptr);
        fields_->deleteLater();
    }
    shown_model_ = name;
    const auto model = find_bsdf_model(name);
    if (!model) return;
    const Which which = which_;
    const auto access = [which](auto& s) -> auto& {
        return (s.model_view.*which).settings;
    };
    fields_ = new ModelForm(document_, model_rows(access, *model), prefix_, side_);
    place_->layout()->addWidget(fields_);
    fields_->show();
}

QWidget* BrdfFields::simulated_fields() {
    auto* fields = new QWidget;
    fields->setObjectName(prefix_ + "simulated-fields");
    auto* form = new_rows(fields);
    add_row(*form, tr("Result"), result(),
            tr("A result of asperity simulate, or a measured BRDF in a format that is read (RGL, "
               "MERL, Zemax, tables and others); empty: the layers drawn in the scene Microfacets "
               "Surface"));
    add_row(*form, tr("Normalize Factor"), factor(),
            tr("0 … 100, no unit: multiplies the simulated BRDF [1/sr]; 1 is physically right"));
    add_row(*form, tr("Albedo"), colour("diffuse", tr("Albedo"), &BrdfSettings::diffuse),
            tr("Red, green, blue, each 0 … 1: albedo / π is added to the simulated BRDF (the "
               "diffuse part of thesis eq. 4.4)"));
    return fields;
}

QWidget* BrdfFields::result() {
    auto* field = new FileField(prefix_ + "result", tr("Open Result or BRDF"), brdf_filter());
    field->set_placeholder(tr("the layers drawn"));
    const Which which = which_;
    bindings_.follow([field, which](const StudioSettings& s) {
        field->set_path(QString::fromStdString((s.model_view.*which).result));
    });
    connect(field, &FileField::chosen, this, [this, which](const QString& path) {
        document_.change(tr("Open Result") + side_, [&](StudioSettings& s) {
            (s.model_view.*which).result = path.toStdString();
        });
    });
    return field;
}

QWidget* BrdfFields::factor() {
    constexpr double kMostFactor = 100;  // no slider is fine enough about 1 and long enough
    auto* box = new NumberBox(0, kMostFactor, 3, 0.1);
    box->setObjectName(prefix_ + "normalize-factor");
    const Which which = which_;
    bindings_.bind(
        box, tr("Normalize Factor") + side_,
        [which](const StudioSettings& s) { return (s.model_view.*which).normalize_factor; },
        [which](StudioSettings& s, double x) { (s.model_view.*which).normalize_factor = x; });
    return box;
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
