// SPDX-License-Identifier: Apache-2.0
#pragma once

// Which channels a figure is about; inside this folder only.

#include <asperity/core/error.h>

#include <string>

namespace asperity::detail {

/// Channels first .. last - 1.
struct ChannelRange {
    int first = 0, last = 1;
};

/// One channel of `channels`, or all of them for -1. Throws Error(Usage, "channel").
inline ChannelRange channel_range(int channel, int channels) {
    if (channel < -1 || channel >= channels)
        throw Error(ErrorCode::Usage,
                    "there is no channel " + std::to_string(channel) + "; channels are 0 .. " +
                        std::to_string(channels - 1) + ", -1 is their mean",
                    "channel");
    return channel < 0 ? ChannelRange{0, channels} : ChannelRange{channel, channel + 1};
}

}  // namespace asperity::detail
