// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "report_json.h"

#include <asperity/core/run.h>
#include <asperity/surface/surface_settings.h>
#include <asperity/surface/texture_figures.h>

#include <string>

namespace asperity::cli {

/// The figures a laboratory quotes: of the surface as it was measured and made ready, before it is
/// mirrored. Keeps a reference to the patch.
class TextureReport {
  public:
    TextureReport(const SurfaceSettings& settings, const Heightfield& patch, Run& run);

    std::string text() const;
    /// With the curves of autocorrelation and power spectral density, computed here.
    Json json(Run& run) const;

  private:
    const Heightfield& patch_;
    TextureFigures figures_;
};

}  // namespace asperity::cli
