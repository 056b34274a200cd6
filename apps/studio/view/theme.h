// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QColor>

namespace asperity::studio {

/// Light, dark, or as the desktop has it.
enum class Theme { System, Light, Dark };

/// Qt's own Fusion style in colours of ours, for the whole program. Keep to the palette's roles
/// when painting: they are readable in both.
void apply_theme(Theme theme);

/// True when the program's window colour is a dark one.
bool is_dark();

/// Between two colours: share 0 gives the first, 1 the second.
QColor mix(const QColor& first, const QColor& second, double share);

}  // namespace asperity::studio
