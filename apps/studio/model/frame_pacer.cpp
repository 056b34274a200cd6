// SPDX-License-Identifier: Apache-2.0
#include "frame_pacer.h"

#include <algorithm>
#include <cmath>

namespace asperity::studio {

QSize FramePacer::moving_size(QSize full) const {
    constexpr double kFirstGuess = 0.5;
    const double pixels = double(full.width()) * full.height();
    double scale = kFirstGuess;
    if (seconds_per_pixel_ > 0) scale = std::sqrt(kBudget / (seconds_per_pixel_ * pixels));
    scale = std::clamp(scale, kSmallest, 1.0);
    const auto side = [scale](int length) {
        return std::max(1, static_cast<int>(std::lround(scale * length)));
    };
    return {side(full.width()), side(full.height())};
}

void FramePacer::took(QSize size, double seconds) {
    constexpr double kEase = 0.25;
    const double now = seconds / std::max(1.0, double(size.width()) * size.height());
    const bool slower = now > seconds_per_pixel_;
    seconds_per_pixel_ = slower ? now : (1 - kEase) * seconds_per_pixel_ + kEase * now;
}

void FrameRate::shown(double now, double seconds) {
    if (!entries_.empty() && now - entries_.back().now > kPause) entries_.clear();
    entries_.push_back({now, seconds});
    while (now - entries_.front().now > kWindow) entries_.pop_front();
}

double FrameRate::frames_per_second() const {
    if (entries_.size() < 2) return 0;
    const double span = entries_.back().now - entries_.front().now;
    return span > 0 ? static_cast<double>(entries_.size() - 1) / span : 0;
}

double FrameRate::milliseconds_per_frame() const {
    if (entries_.empty()) return 0;
    double sum = 0;
    for (const Entry& entry : entries_) sum += entry.seconds;
    return 1000 * sum / static_cast<double>(entries_.size());
}

}  // namespace asperity::studio
