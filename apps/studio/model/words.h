// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QString>

#include <string>

namespace asperity::studio {

/// A sentence of the library as the forms have it: "filter-s: ..." and "--fill nearest" become
/// "Filter S: ..." and "Fill nearest", for settings that have a field.
QString in_words_of_forms(const QString& sentence);

/// The setting that a sentence begins with, "filter-s"; empty: none.
std::string setting_complained_of(const QString& sentence);

}  // namespace asperity::studio
