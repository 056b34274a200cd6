// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "settings.h"

#include <asperity/formats/results/setting_value.h>

#include <functional>
#include <span>
#include <string>
#include <string_view>

namespace asperity::studio {

/// One setting of the studio, beyond those of the experiment: its name in a session, how its text
/// is read, how it is written.
struct StudioKey {
    const char* name;
    const char* group;  ///< heading in a session
    /// Throws Error(Usage, name) for a text that does not parse or fit.
    std::function<void(StudioSettings&, const io::SettingValue&)> set;
    std::function<std::string(const StudioSettings&)> get;
};

/// All of them, in the order of a session.
std::span<const StudioKey> studio_keys();

/// nullptr when there is no such setting.
const StudioKey* find_studio_key(std::string_view name);

// What the settings accept; widgets take their ends from here.
inline constexpr int kMostLayers = 9000, kMostPaths = 100000, kMostChannels = 4096;
inline constexpr int kDeepest = 1000;
inline constexpr io::Range kExposureRange = {-100, 100, "must be in -100 .. 100"};
inline constexpr io::Range kDecadesRange = {0.01, 30, "must be in 0.01 .. 30"};
inline constexpr io::Range kElevationRange = {-90, 90, "must be in -90 .. 90"};
inline constexpr io::Range kTurnRange = {-360, 360, "must be in -360 .. 360"};
inline constexpr io::Range kAlphaRange = {1e-4, 100, "must be in 0.0001 .. 100"};

}  // namespace asperity::studio
