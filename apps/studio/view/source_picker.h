// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "../model/brdf_source.h"
#include "../model/workbench.h"
#include "file_field.h"

#include <QComboBox>
#include <QLabel>
#include <QLineEdit>
#include <QStackedLayout>
#include <QWidget>

namespace asperity::studio {

/// Which BRDF a dialog works on: the layers drawn, a file, or a model. The controls take the name
/// given with "-source", "-layers", "-model" behind it; the file's is that of a FileField.
class SourcePicker : public QWidget {
    Q_OBJECT

  public:
    enum class Models { No, Yes };

    SourcePicker(const QString& name, Workbench& workbench, Models models,
                 QWidget* parent = nullptr);

    BrdfSource source() const;
    void set_source(const BrdfSource& source);

  signals:
    void changed();

  private:
    void show_layers();

    Workbench& workbench_;
    QComboBox* kind_;
    QStackedLayout* place_;
    QLabel* layers_;
    FileField* file_;
    QLineEdit* model_ = nullptr;
    QString path_;
};

}  // namespace asperity::studio
