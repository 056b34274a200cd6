// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/pictures/height_map.h>

#include <QImage>
#include <QWidget>

namespace asperity::studio {

/// Heights as a file has them and, beside them, made ready: colours with a bar of their own each,
/// points without a height black.
class BeforeAfter : public QWidget {
    Q_OBJECT

  public:
    explicit BeforeAfter(QWidget* parent = nullptr);

    /// A map without pixels is one that is not there.
    void set_maps(const io::HeightMap& before, const io::HeightMap& after);
    /// In the place of the second picture where there is none: why.
    void set_reason(const QString& reason);

    QSize sizeHint() const override;
    QSize minimumSizeHint() const override;

  protected:
    void paintEvent(QPaintEvent* event) override;

  private:
    struct Side {
        QString title;
        io::HeightMap map;
        QImage image;
        bool holes = false;
    };
    void set_side(Side& side, const io::HeightMap& map);
    void paint_side(QPainter& painter, const QRectF& area, const Side& side) const;

    Side before_, after_;
    QString reason_;
};

}  // namespace asperity::studio
