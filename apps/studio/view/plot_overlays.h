// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "../model/settings.h"

#include <asperity/gonio/measurement.h>
#include <asperity/plots/plot_style.h>

#include <QString>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace asperity::studio {

/// An analytic model drawn beside the simulated one: what its curves depend on, and its names.
struct OverlayModel {
    std::string name;       ///< in bsdf_models()
    std::size_t place = 0;  ///< there
    std::string spec;       ///< as parse_brdf_spec reads it
    QString label;          ///< "GGX"
    QString title;          ///< "GGX α = 0.3"
    bool operator==(const OverlayModel&) const = default;
};

/// The models that the settings ask for, in the order of bsdf_models(). Their slopes are as wide as
/// those of the surface if they follow it, `surface_alpha` being its rms gradient, Beckmann's
/// alpha. With a measurement, models with facets reflect as those of the measurement do, but for
/// what was set otherwise.
std::vector<OverlayModel> overlay_models(const PlotView& view, std::optional<double> surface_alpha,
                                         const Measurement* measurement);

/// The ink of the analytic model at a place of their list; they begin anew after the last.
plots::PlotInk model_ink(std::size_t place);

}  // namespace asperity::studio
