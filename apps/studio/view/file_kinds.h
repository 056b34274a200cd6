// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QString>

namespace asperity::studio {

// What files the program opens, as QFileDialog filters; endings come from the registries of
// formats.

QString open_filter();  ///< all that can be opened first, then kind by kind
QString surface_filter();
QString model_filter();
QString brdf_filter();  ///< results, and BRDFs in the formats that can be read

/// What a file is opened as, by its content where that tells, else by its ending.
enum class FileKind { Session, Result, Model, Surface };
FileKind kind_of_file(const QString& path);

}  // namespace asperity::studio
