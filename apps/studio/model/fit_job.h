// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "brdf_source.h"
#include "settings.h"

#include <asperity/fit/fit.h>

#include <QString>

#include <memory>
#include <string>

namespace asperity::studio {

/// A BRDF and what is to be fitted to it, as `asperity fit` has it.
struct FitWish {
    BrdfSource source;
    std::shared_ptr<const Measurement> drawn;
    FitSettings settings;
};

struct FitOutcome {
    std::shared_ptr<const FitData> data;
    FitReport report;
    QString hint;  ///< what the user should know of the data; empty: nothing
};

/// Throws what opening, fit_data() and fit_models() throw; Error(Stopped).
FitOutcome fit_brdf(const FitWish& wish, Run& run);

/// True for a fit that MaterialX can hold: ggx without a diffuse part.
bool fits_materialx(const Fit& fit);

/// Draws the model of a specification in the plots, with just its settings; the others keep the
/// widths they have. `surface_alpha`: that of models that follow the surface.
void put_in_plots(StudioSettings& settings, const std::string& spec,
                  std::optional<double> surface_alpha);

/// Compares on the model: what was fitted left of the line, the fit right of it.
void put_in_compare(StudioSettings& settings, const std::string& spec, const BrdfSource& fitted);

}  // namespace asperity::studio
