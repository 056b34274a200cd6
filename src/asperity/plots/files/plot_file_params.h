// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/params/param.h>
#include <asperity/plots/files/write_plot.h>

namespace asperity::plots {

/// The rows of PlotFileSettings, for options, help and the reference.
ParamTable<PlotFileSettings> plot_file_params();

}  // namespace asperity::plots
