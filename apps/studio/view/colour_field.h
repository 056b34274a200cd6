// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "slider_field.h"

#include <asperity/render/rgb.h>

#include <QToolButton>
#include <QWidget>

#include <array>

namespace asperity::studio {

/// A reflectance as three numbers 0 .. 1, red, green and blue, in linear light, and a button that
/// shows it and opens a dialog of colours. The boxes take the name given with "-r", "-g", "-b"
/// behind it, the button "-colour".
class ColourField : public QWidget {
    Q_OBJECT

  public:
    explicit ColourField(const QString& name, QWidget* parent = nullptr);

    Rgb value() const;
    void set_value(Rgb colour);  ///< without `changed`

  signals:
    void changed(asperity::Rgb colour);  ///< by the user

  private:
    void ask();
    void show_colour();

    std::array<NumberBox*, 3> boxes_;
    QToolButton* button_;
};

}  // namespace asperity::studio
