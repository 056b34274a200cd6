// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "view/main_window.h"
#include "view/viewport.h"

#include <QApplication>
#include <QComboBox>
#include <QImage>
#include <QPushButton>
#include <QSettings>
#include <QStandardPaths>
#include <QTemporaryDir>
#include <QTest>

namespace asperity::studio::testing {

/// Names and folders of their own, so that a test neither reads nor changes what a user has.
class TestScope {
  public:
    TestScope() {
        QStandardPaths::setTestModeEnabled(true);
        QApplication::setOrganizationName("asperity-tests");
        QApplication::setApplicationName("studio-test");
        QSettings::setPath(QSettings::NativeFormat, QSettings::UserScope, folder_.path());
    }
    QString path(const QString& name) const { return folder_.filePath(name); }

  private:
    QTemporaryDir folder_;
};

/// The real window, driven by its widgets as a user would.
class StudioWindow : public MainWindow {
  public:
    explicit StudioWindow(QSize size = {1280, 800}) {
        set_asking(Asking::No);
        resize(size);
        show();
        QTest::qWait(1);  // the docks take their places
    }

    /// The control of that name in the page that is shown, or anywhere.
    template <typename Widget>
    Widget& control(const char* name) {
        const bool surface = workbench().settings().scene == SceneKind::Surface;
        auto* page = findChild<QWidget*>(surface ? "surface-page" : "model-page");
        auto* found = page ? page->findChild<Widget*>(name) : nullptr;
        if (found == nullptr) found = findChild<Widget*>(name);
        if (found == nullptr) qFatal("there is no control '%s'", name);
        return *found;
    }

    void click(const char* button) {
        auto& target = control<QPushButton>(button);
        if (!target.isEnabled()) qWarning("%s is disabled", button);
        QTest::mouseClick(&target, Qt::LeftButton);
    }
    /// Types a number into a box and leaves it by Return.
    void type(const char* box, double value) {
        auto& target = control<QAbstractSpinBox>(box);
        target.setFocus();
        target.selectAll();
        QTest::keyClicks(&target, QString::number(value));
        QTest::keyClick(&target, Qt::Key_Return);
    }
    void choose(const char* list, const QString& entry) {
        auto& target = control<QComboBox>(list);
        const int index = target.findText(entry);
        if (index < 0) qFatal("'%s' has no entry '%s'", list, qPrintable(entry));
        target.setCurrentIndex(index);
    }
    QString text(const char* label);

    bool surface_comes();
    /// Presses Draw To Textures and waits for the end.
    bool draw();
    /// Waits until the picture of the scene that is shown is of the settings, at full resolution.
    bool picture_comes();
    Viewport& viewport();  ///< of the scene that is shown
    QImage picture();      ///< of the viewport, with what is painted over it
    void set_small();      ///< settings that draw in a moment
};

// Colours of a picture
inline bool is_green(const QColor& c) {
    return c.green() > 200 && c.red() < 40 && c.blue() < 40;
}
inline bool is_black(const QColor& c) {
    return c.red() < 8 && c.green() < 8 && c.blue() < 8;
}
/// The dome's colours run from dark red to orange and white.
inline bool is_warm(const QColor& c) {
    return c.red() > 60 && c.red() > c.green() + 20 && c.green() >= c.blue();
}
inline bool is_reddish(const QColor& c) {
    return c.red() > 40 && c.red() > 2 * c.green() && c.red() > 2 * c.blue();
}

/// Share of the pixels for which `holds` says yes.
template <typename Holds>
double share_of(const QImage& image, Holds holds) {
    int count = 0;
    for (int y = 0; y < image.height(); ++y)
        for (int x = 0; x < image.width(); ++x)
            if (holds(QColor(image.pixel(x, y)))) ++count;
    return static_cast<double>(count) / (image.width() * image.height());
}

/// Share of the pixels that differ by more than a few shades.
double difference(const QImage& a, const QImage& b);

}  // namespace asperity::studio::testing
