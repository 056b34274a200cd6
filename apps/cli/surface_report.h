// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "report_json.h"
#include "texture_report.h"

#include <asperity/surface/heightfield.h>
#include <asperity/surface/statistics.h>
#include <asperity/surface/surface_settings.h>

#include <optional>
#include <string>

namespace asperity::cli {

/// Kolmogorov-Smirnov distances of the facet slopes to Beckmann's and to the GGX law, at the asked
/// alpha or, where none was asked, at the realised one.
struct LawDistances {
    double beckmann = 0, ggx = 0;
};

/// What `asperity surface` tells about a surface. Keeps references.
class SurfaceReport {
  public:
    /// `patch`: the surface before it was made to fill the plane.
    SurfaceReport(const SurfaceSettings& settings, const Heightfield& patch,
                  const Heightfield& surface, Run& run);

    /// One line, or two for a file.
    std::string headline() const;
    /// All figures, a line each.
    std::string figures() const;
    Json json(Run& run) const;

  private:
    const SurfaceSettings& settings_;
    const Heightfield& surface_;
    SurfaceStatistics statistics_;
    std::optional<LawDistances> distances_;  ///< none for a surface without slopes along x or y
    TextureReport texture_;
};

}  // namespace asperity::cli
