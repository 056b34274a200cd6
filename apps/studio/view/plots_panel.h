// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "../model/workbench.h"

#include <QImage>
#include <QWidget>

namespace asperity::studio {

/// The plots of the current layer and of all layers, with their own controls.
class PlotsPanel : public QWidget {
    Q_OBJECT

  public:
    explicit PlotsPanel(Workbench& workbench, QWidget* parent = nullptr);

    /// The plot shown, at `size`.
    QImage picture(QSize size) const;
    void copy_picture() const;
    /// By the ending of its name: .png, .svg or .csv. Throws Error(Usage | InputOutput).
    void save(const QString& path) const;
};

}  // namespace asperity::studio
