// SPDX-License-Identifier: Apache-2.0
#include "model_panel.h"

#include "brdf_fields.h"
#include "light_fields.h"
#include "look_fields.h"
#include "rows.h"

#include <QVBoxLayout>

namespace asperity::studio {

ModelPanel::ModelPanel(Workbench& workbench, QWidget* parent)
    : QWidget(parent), document_(workbench.document()), bindings_(workbench.document(), this) {
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(4);
    layout->addWidget(brdf_section());
    layout->addWidget(compare_section());
    layout->addWidget(new LightFields(document_));
    layout->addWidget(new LookFields(document_));
    layout->addWidget(new ModelFields(document_));
}

Section* ModelPanel::brdf_section() {
    auto* section = new Section(tr("BRDF Settings"));
    section->form().addRow(new BrdfFields(document_, bindings_, &ModelView::brdf, {}, {}));
    return section;
}

Section* ModelPanel::compare_section() {
    auto* section = new Section(tr("Compare BRDFs"));
    auto* compare = new QCheckBox(tr("Compare"));
    compare->setObjectName("compare");
    compare->setToolTip(
        tr("Wear a second BRDF right of a line that can be dragged; left of it "
           "that of the BRDF Settings. Each may be a model, the layers drawn, or a file"));
    section->form().addRow(compare);
    bindings_.bind(
        compare, tr("Compare"), [](const StudioSettings& s) { return s.model_view.compare; },
        [](StudioSettings& s, bool on) { s.model_view.compare = on; });

    auto* fields = new QWidget;
    auto* rows = new_rows(fields);
    rows->addRow(
        new BrdfFields(document_, bindings_, &ModelView::second, "second-", tr(" (right)")));
    auto* split = new SliderField("split", 0, 1, 3, 0.01);
    add_row(*rows, tr("Split"), split, tr("Where the line stands, as a share of the width"));
    bindings_.bind(
        split, tr("Split"), [](const StudioSettings& s) { return s.model_view.split; },
        [](StudioSettings& s, double share) { s.model_view.split = share; });
    section->form().addRow(fields);
    bindings_.follow([fields](const StudioSettings& settings) {
        fields->setVisible(settings.model_view.compare);
    });
    return section;
}

}  // namespace asperity::studio
