// SPDX-License-Identifier: Apache-2.0
#include "main_window.h"
#include "menus.h"
#include "tour.h"

#include <asperity/core/version.h>

#include <QCoreApplication>
#include <QMenu>
#include <QMenuBar>
#include <QMessageBox>

namespace asperity::studio {

namespace {

QString tr(const char* text) {
    return QCoreApplication::translate("HelpMenu", text);
}

/// A window with a text, beside the others: it does not hold up the program.
void show_text(MainWindow& window, const char* name, const QString& title, const QString& text) {
    auto* box = new QMessageBox(&window);
    box->setAttribute(Qt::WA_DeleteOnClose);
    box->setObjectName(name);
    box->setWindowTitle(title);
    box->setTextFormat(Qt::RichText);
    box->setText(text);
    box->setStandardButtons(QMessageBox::Close);
    box->setModal(false);
    box->show();
}

/// Thesis table 2.1, and what the pictures answer to beside it.
QString keys_text() {
    return tr(
        "<h3>Orbiter</h3>"
        "<table cellspacing='4'>"
        "<tr><td><b>Left button, drag</b></td><td>turns round the object</td></tr>"
        "<tr><td><b>Wheel, pinch</b></td><td>nearer, farther</td></tr>"
        "<tr><td><b>Arrow keys, + and -</b></td><td>the same without a mouse</td></tr></table>"
        "<h3>First-Person</h3>"
        "<table cellspacing='4'>"
        "<tr><td><b>W A S D</b></td><td>forward, left, backward, right</td></tr>"
        "<tr><td><b>Q E</b></td><td>down, up</td></tr>"
        "<tr><td><b>Shift, Ctrl</b></td><td>faster, slower</td></tr>"
        "<tr><td><b>Left button, drag</b></td><td>looks around</td></tr></table>"
        "<h3>6-DoF</h3>"
        "<table cellspacing='4'>"
        "<tr><td colspan='2'>as First-Person, along the camera's own axes</td></tr>"
        "<tr><td><b>Right button, drag</b></td><td>rolls about the view</td></tr></table>"
        "<h3>All</h3>"
        "<table cellspacing='4'>"
        "<tr><td><b>R</b></td><td>back to where the camera began</td></tr>"
        "<tr><td><b>F9</b></td><td>the scene alone, in large type</td></tr>"
        "<tr><td><b>Click on the dome</b></td><td>the paths of light that end there</td></tr>"
        "<tr><td><b>Drag the line of a split view</b></td><td>more of one BRDF</td></tr>"
        "</table>");
}

QString about_text() {
    return tr("<h3>Asperity %1</h3>"
              "<p>A virtual gonioreflectometer: what light does on a rough surface, and the BRDF "
              "that comes of it.</p>"
              "<p>Apache License 2.0. Built with Qt %2 (LGPL 3, linked dynamically), Embree and "
              "oneTBB (Apache 2.0), Eigen (MPL 2), Highway (Apache 2.0), OpenEXR and "
              "Random123 (BSD), fmt and nlohmann-json (MIT), libpng.</p>")
        .arg(kVersion, qVersion());
}

}  // namespace

void add_help_menu(MainWindow& window) {
    QMenu& menu = *window.menuBar()->addMenu(tr("&Help"));
    menu.addAction(tr("Tour in Five Steps"), &window, [&window] { window.tour().begin(); })
        ->setShortcut(QKeySequence("Shift+F1"));
    menu.addAction(tr("Keys and Mouse"), &window,
                   [&window] { show_text(window, "keys", tr("Keys and Mouse"), keys_text()); })
        ->setShortcut(QKeySequence("F1"));
    menu.addSeparator();
    menu.addAction(tr("About Asperity"), &window,
                   [&window] { show_text(window, "about", tr("About Asperity"), about_text()); });
}

}  // namespace asperity::studio
