// SPDX-License-Identifier: Apache-2.0
#include <asperity/tracing/scale.h>

#include <asperity/core/directions.h>
#include <asperity/core/error.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace asperity {

namespace {
constexpr double kMostCellsAcross = 1 << 24;
}

void check_scale(const Heightfield& surface, double lowest, double highest,
                 std::span<const double> theta) {
    const auto refuse = [&](const std::string& why) {
        throw Error(ErrorCode::InvalidInput,
                    fmt::format("heights from {:.6g} to {:.6g} over cells of {:.6g} x {:.6g}: {}",
                                lowest, highest, surface.dx, surface.dy, why),
                    surface.name);
    };
    const double cells = (highest - lowest) / std::min(surface.dx, surface.dy);
    if (!(cells <= kMostCellsAcross))
        refuse(
            fmt::format("they range over {:.3g} cells, more than {:.3g}; are heights and cells "
                        "in the same unit?",
                        cells, kMostCellsAcross));
    for (const double angle : theta) {
        const double way = cells * std::tan(angle);
        if (!(way <= kMostCellsAcross))
            refuse(
                fmt::format("light at {:.12g} degrees crosses {:.3g} cells while it sinks from "
                            "the highest point to the lowest, more than {:.3g}; are heights and "
                            "cells in the same unit, and the angle right?",
                            degrees(angle), way, kMostCellsAcross));
    }
}

}  // namespace asperity
