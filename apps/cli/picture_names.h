// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/params/fields.h>
#include <asperity/pictures/pictures.h>

namespace asperity::cli {

// Names of the looks of a picture.
inline constexpr Names<io::ColourMap, 4> kColourMaps = {{
    {"viridis", io::ColourMap::Viridis},
    {"inferno", io::ColourMap::Inferno},
    {"grey", io::ColourMap::Grey},
    {"thesis-red", io::ColourMap::ThesisRed},
}};
inline constexpr Names<io::Scale, 2> kScales = {{
    {"log", io::Scale::Log},
    {"linear", io::Scale::Linear},
}};
inline constexpr Names<io::Projection, 2> kProjections = {{
    {"sky-map", io::Projection::SkyMap},
    {"disk", io::Projection::Disk},
}};
inline constexpr Names<bool, 2> kThemes = {{
    {"dark", false},
    {"light", true},
}};

}  // namespace asperity::cli
