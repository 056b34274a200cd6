// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/bsdf/bsdf.h>
#include <asperity/core/run.h>
#include <asperity/gonio/measurement.h>

#include <memory>
#include <string>
#include <variant>

namespace asperity::studio {

/// A BRDF that a dialog works on: the layers that were drawn, a file (a result, or a BRDF in a
/// format of formats/bsdfs), or a model as parse_brdf_spec reads it.
struct BrdfSource {
    enum class Kind { Drawn, File, Model };
    Kind kind = Kind::Drawn;
    std::string text;  ///< the file or the model
    bool operator==(const BrdfSource&) const = default;
};

/// A measurement or a continuous function.
using OpenedBrdf = std::variant<std::shared_ptr<const Measurement>, std::shared_ptr<const Bsdf>>;

/// `drawn`: the layers, null where there are none. Throws Error(Usage) for what is not there, and
/// what reading throws.
OpenedBrdf open_brdf(const BrdfSource& source, std::shared_ptr<const Measurement> drawn);

/// "the layers drawn", "metal.asperity", "ggx:alpha=0.3".
std::string name_of(const BrdfSource& source);

}  // namespace asperity::studio
