// SPDX-License-Identifier: Apache-2.0
#include "bindings.h"

#include <QSignalBlocker>

namespace asperity::studio {

Bindings::Bindings(Document& document, QObject* parent) : QObject(parent), document_(document) {
    connect(&document_, &Document::changed, this, [this] {
        for (const auto& show : shown_) show(document_.settings());
    });
}

void Bindings::bind(QSpinBox* box, const QString& what, Read<int> read, Write<int> write) {
    box->setKeyboardTracking(false);
    follow([box, read](const StudioSettings& settings) {
        const QSignalBlocker quiet(box);
        box->setValue(read(settings));
    });
    connect(box, &QSpinBox::valueChanged, this, [this, what, write](int value) {
        document_.change(what, [&](StudioSettings& settings) { write(settings, value); });
    });
}

void Bindings::bind(QDoubleSpinBox* box, const QString& what, Read<double> read,
                    Write<double> write) {
    box->setKeyboardTracking(false);
    follow([box, read](const StudioSettings& settings) {
        const QSignalBlocker quiet(box);
        box->setValue(read(settings));
    });
    connect(box, &QDoubleSpinBox::valueChanged, this, [this, what, write](double value) {
        document_.change(what, [&](StudioSettings& settings) { write(settings, value); });
    });
}

void Bindings::bind(SliderField* field, const QString& what, Read<double> read,
                    Write<double> write) {
    follow([field, read](const StudioSettings& settings) { field->set_value(read(settings)); });
    connect(field, &SliderField::changed, this, [this, what, write](double value) {
        document_.change(what, [&](StudioSettings& settings) { write(settings, value); });
    });
}

void Bindings::bind(QCheckBox* box, const QString& what, Read<bool> read, Write<bool> write) {
    follow([box, read](const StudioSettings& settings) {
        const QSignalBlocker quiet(box);
        box->setChecked(read(settings));
    });
    connect(box, &QCheckBox::toggled, this, [this, what, write](bool value) {
        document_.change(what, [&](StudioSettings& settings) { write(settings, value); });
    });
}

void Bindings::bind(QComboBox* box, const QString& what, Read<int> read, Write<int> write) {
    follow([box, read](const StudioSettings& settings) {
        const QSignalBlocker quiet(box);
        box->setCurrentIndex(read(settings));
    });
    connect(box, &QComboBox::currentIndexChanged, this, [this, what, write](int value) {
        if (value < 0) return;
        document_.change(what, [&](StudioSettings& settings) { write(settings, value); });
    });
}

void Bindings::follow(const std::function<void(const StudioSettings&)>& show) {
    show(document_.settings());
    shown_.push_back(show);
}

DrawingLock::DrawingLock(Workbench& workbench, QObject* parent)
    : QObject(parent), workbench_(workbench) {
    connect(&workbench, &Workbench::drawing_changed, this, &DrawingLock::update);
}

void DrawingLock::add(QWidget* control) {
    locked_.push_back({control, control->toolTip()});
    update();
}

void DrawingLock::update() {
    const bool drawing = workbench_.is_drawing();
    for (const Locked& locked : locked_) {
        locked.control->setEnabled(!drawing);
        locked.control->setToolTip(
            drawing
                ? tr("Stop Drawing first: this decides what is being drawn") + "\n" + locked.tooltip
                : locked.tooltip);
    }
}

}  // namespace asperity::studio
