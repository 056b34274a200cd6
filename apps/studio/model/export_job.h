// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "brdf_source.h"

#include <QString>
#include <QStringList>

#include <limits>
#include <string>

namespace asperity::studio {

/// A BRDF to be written, as `asperity export` has it.
struct ExportWish {
    BrdfSource source;
    std::shared_ptr<const Measurement> drawn;
    std::string format;   ///< name of a row of io::BsdfFormats
    std::string options;  ///< "key=value,key=value"
    bool snippets = false;
    std::string path;
    double max_error = std::numeric_limits<double>::infinity();  ///< of mean_l1, a share
};

/// What came of it.
struct ExportOutcome {
    QStringList written;   ///< files
    QString fidelity;      ///< a line; empty: the format cannot be read back, or stopped before
    double mean_l1 = -1;   ///< below 0: not known
    bool too_far = false;  ///< mean_l1 is above ExportWish::max_error
    QStringList remarks;
    bool stopped = false;  ///< after what `written` says
};

/// Writes the file and reads it back. A stop ends it within about 0.1 s; files are whole or not
/// there.
/// Throws what opening, writing and reading throw.
ExportOutcome export_brdf(const ExportWish& wish, Run& run);

/// True for formats that have scenes to be written beside the file.
bool has_snippets(const std::string& format);

}  // namespace asperity::studio
