// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QList>

class QDockWidget;

namespace asperity::studio {

class MainWindow;

// The menus of the window, each in a file of its own. Every command has a name, a status tip where
// the name does not say all, and a shortcut where it is used often.

void add_file_menu(MainWindow& window);
void add_edit_menu(MainWindow& window);
void add_view_menu(MainWindow& window, const QList<QDockWidget*>& docks);
void add_simulation_menu(MainWindow& window);
void add_help_menu(MainWindow& window);

}  // namespace asperity::studio
