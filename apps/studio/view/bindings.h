// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "../model/workbench.h"
#include "slider_field.h"

#include <QCheckBox>
#include <QComboBox>
#include <QObject>
#include <QSpinBox>

#include <functional>
#include <vector>

namespace asperity::studio {

/// Ties controls to settings: a control shows its setting whoever changed it, and asks the Document
/// for a step that can be undone when the user moves it.
class Bindings : public QObject {
    Q_OBJECT

  public:
    template <typename Value>
    using Read = std::function<Value(const StudioSettings&)>;
    template <typename Value>
    using Write = std::function<void(StudioSettings&, Value)>;

    Bindings(Document& document, QObject* parent);

    // `what` names the step in the Edit menu.
    void bind(QSpinBox* box, const QString& what, Read<int> read, Write<int> write);
    void bind(QDoubleSpinBox* box, const QString& what, Read<double> read, Write<double> write);
    void bind(SliderField* field, const QString& what, Read<double> read, Write<double> write);
    void bind(QCheckBox* box, const QString& what, Read<bool> read, Write<bool> write);
    /// The value is the index in the list.
    void bind(QComboBox* box, const QString& what, Read<int> read, Write<int> write);

    /// Calls `show` now and after every change.
    void follow(const std::function<void(const StudioSettings&)>& show);

  private:
    Document& document_;
    std::vector<std::function<void(const StudioSettings&)>> shown_;
};

/// Disables controls while a drawing runs; their tooltips say why, and what they are for after it.
class DrawingLock : public QObject {
    Q_OBJECT

  public:
    DrawingLock(Workbench& workbench, QObject* parent);
    void add(QWidget* control);

  private:
    struct Locked {
        QWidget* control;
        QString tooltip;
    };
    void update();

    Workbench& workbench_;
    std::vector<Locked> locked_;
};

}  // namespace asperity::studio
