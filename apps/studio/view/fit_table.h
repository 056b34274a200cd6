// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "../model/fit_job.h"

#include <QString>
#include <QTreeWidget>

namespace asperity::studio {

/// "0.3012 ± 0.0008": a value to the second digit of its error; "(?)" where that is not known.
QString with_error(double value, double error);

/// Columns of figures with the fits, best first, each with its parameters below it.
void fill_fit_table(QTreeWidget& table, const FitOutcome& outcome);

}  // namespace asperity::studio
