// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/bsdf/bsdf_models.h>
#include <asperity/bsdf/models/microfacet.h>

#include <optional>

namespace asperity {

/// What specifications of all microfacet models have in common.
struct MicrofacetSpec {
    double alpha = 0.5;
    double alpha_y = 0;  ///< 0: as alpha
    Masking masking = Masking::Correlated;
    OpticsSettings optics;               ///< but for the law
    std::optional<FresnelKind> fresnel;  ///< none: the law that `optics` implies

    double width_y() const { return alpha_y > 0 ? alpha_y : alpha; }
    OpticsSettings law() const;
};

ParamTable<MicrofacetSpec> microfacet_params();

/// The specification that is read as this model; `own`: the model's own settings, ",key=value".
/// Throws Error(Usage, "alpha" | "alpha_y") for widths outside 1e-4 .. 100.
std::string microfacet_name(const char* model, double alpha_x, double alpha_y,
                            const std::string& own, Masking masking, const OpticsSettings& optics);

/// The row of a model whose facets are those of a SmithSurface.
BsdfModel smith_model(SlopeFamily family, std::string name, std::string label, std::string doc);

}  // namespace asperity
