// SPDX-License-Identifier: Apache-2.0
// asperity-studio: the desktop program.
#include "view/main_window.h"
#include "view/preferences.h"
#include "view/theme.h"

#include <asperity/core/version.h>

#include <QApplication>
#include <QCommandLineParser>
#include <QTimer>

int main(int argc, char** argv) {
    QApplication application(argc, argv);
    QApplication::setOrganizationName("asperity");
    QApplication::setApplicationName("asperity-studio");
    QApplication::setApplicationVersion(asperity::kVersion);

    QCommandLineParser options;
    options.setApplicationDescription(
        "A virtual gonioreflectometer: rough surfaces, the light on them, and the BRDF of it.");
    options.addPositionalArgument("file", "session, result, model or surface to open", "[file]");
    options.addHelpOption();
    options.addVersionOption();
    options.process(application);

    asperity::studio::apply_theme(asperity::studio::preferences::theme());
    asperity::studio::MainWindow window;
    const bool with_file = !options.positionalArguments().isEmpty();
    window.begin(!with_file && asperity::studio::preferences::measure_at_start());
    window.show();
    QTimer::singleShot(0, &window, [&] {
        window.offer_lost_session();
        if (with_file) window.open(options.positionalArguments().first());
    });
    return QApplication::exec();
}
