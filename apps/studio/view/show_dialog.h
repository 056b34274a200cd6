// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QWidget>

namespace asperity::studio {

class Workbench;

/// Shows the window's one dialog of this kind, on top and ready for input; made when it is first
/// asked for.
template <class Dialog>
void show_dialog(Workbench& workbench, QWidget& window) {
    auto* dialog = window.findChild<Dialog*>();
    if (dialog == nullptr) dialog = new Dialog(workbench, &window);
    dialog->show();
    dialog->raise();
    dialog->activateWindow();
}

}  // namespace asperity::studio
