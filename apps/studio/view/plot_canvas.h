// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/plots/plot.h>

#include <QImage>
#include <QPixmap>
#include <QWidget>

#include <memory>

namespace asperity::studio {

/// Shows a plot, and the values under the mouse or, moved by the arrow keys, the cross hair.
class PlotCanvas : public QWidget {
    Q_OBJECT

  public:
    explicit PlotCanvas(QWidget* parent = nullptr);

    void set_plot(std::shared_ptr<const plots::Plot> plot);
    QSize sizeHint() const override;
    QSize minimumSizeHint() const override;

  signals:
    void read(const QString& text);  ///< empty: nothing there
    void cell_chosen(int cell);      ///< by a click or Return

  protected:
    void paintEvent(QPaintEvent*) override;
    void mouseMoveEvent(QMouseEvent* event) override;
    void mouseReleaseEvent(QMouseEvent* event) override;
    void leaveEvent(QEvent*) override;
    void keyPressEvent(QKeyEvent* event) override;

  private:
    plots::PlotStyle style_now() const;
    void look_at(std::optional<QPointF> place);
    void choose();

    std::shared_ptr<const plots::Plot> plot_;
    QPixmap painted_;  ///< the plot without the cross hair; null: to be painted anew
    plots::PlotStyle painted_style_;
    std::optional<QPointF> place_;
    std::optional<plots::PlotReading> reading_;
};

/// The plot as a picture of `size` pixels, each `scale` times as fine as the style's, which is
/// style_of(..., font).
QImage plot_image(const plots::Plot& plot, QSize size, double scale, const plots::PlotStyle& style,
                  const QFont& font);

}  // namespace asperity::studio
