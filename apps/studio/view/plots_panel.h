// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "../model/workbench.h"

#include "plot_make.h"

#include <QImage>
#include <QLabel>
#include <QTimer>
#include <QWidget>

namespace asperity::studio {

class PlotCanvas;
class PlotControls;

/// The plots of the current layer and of all layers, with their own controls.
class PlotsPanel : public QWidget {
    Q_OBJECT

  public:
    explicit PlotsPanel(Workbench& workbench, QWidget* parent = nullptr);

    /// Whether what is shown follows the latest change; a plot comes a moment after it.
    bool is_up_to_date() const { return !timer_.isActive(); }
    /// The plot shown, at `size`, in the colours of the program.
    QImage picture(QSize size) const;
    /// Black on white, for print.
    void copy_picture() const;
    /// By the ending of its name: .png, .svg, .pdf or .csv; pictures black on white, as large as
    /// shown. Throws Error(Usage | InputOutput).
    void save(const QString& path) const;

  protected:
    void showEvent(QShowEvent*) override;

  private:
    void follow();
    void refresh_soon();
    void refresh();
    void ask_and_save();
    PlotSource source() const;
    std::shared_ptr<const plots::Plot> plot() const;
    QSize shown_size() const;

    Workbench& workbench_;
    PlotControls* controls_;
    PlotCanvas* canvas_;
    QLabel* read_out_;
    QLabel* stale_;
    ModelCurves models_;
    std::shared_ptr<plots::DiscPainter> disc_painter_ = std::make_shared<plots::DiscPainter>();
    QTimer timer_;  ///< until the next plot may be made
};

}  // namespace asperity::studio
