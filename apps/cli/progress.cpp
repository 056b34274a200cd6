// SPDX-License-Identifier: Apache-2.0
#include "progress.h"

#include "console.h"

#include <asperity/core/directions.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace asperity::cli {

namespace {

constexpr std::size_t kBarWidth = 24;
constexpr double kSecondsBetweenLines = 10;

}  // namespace

std::string clock_text(double seconds) {
    const auto whole = static_cast<long long>(std::ceil(std::clamp(seconds, 0.0, 1e9)));
    if (whole < 3600) return fmt::format("{}:{:02}", whole / 60, whole % 60);
    return fmt::format("{}:{:02}:{:02}", whole / 3600, whole / 60 % 60, whole % 60);
}

std::string short_number(double value) {
    if (value >= 1e9) return fmt::format("{:.2f} G", value / 1e9);
    if (value >= 1e6) return fmt::format("{:.2f} M", value / 1e6);
    if (value >= 1e3) return fmt::format("{:.1f} k", value / 1e3);
    return fmt::format("{:.0f} ", value);
}

ProgressBar::ProgressBar(Run& run, bool quiet) : run_(run), terminal_(err_is_terminal()) {
    if (!quiet) run.on_progress([this](const Progress& progress) { show(progress); });
}

ProgressBar::~ProgressBar() {
    run_.on_progress({});
    clear();
}

void ProgressBar::clear() {
    if (drawn_) write_control("\r\x1b[K");
    drawn_ = false;
}

std::string ProgressBar::line_of(const Progress& p) const {
    const double share = static_cast<double>(p.done) / static_cast<double>(p.total);
    const auto filled = static_cast<std::size_t>(share * static_cast<double>(kBarWidth));
    // Only light is counted in rays and layers, and only pictures in samples.
    const bool light = p.stage == "tracing", picture = p.stage == "rendering";
    std::string line = p.stage;
    if (light && !layers_.empty()) {
        const auto done = static_cast<std::size_t>(share * static_cast<double>(layers_.size()));
        const std::size_t under_way = std::min(done, layers_.size() - 1);
        const Incidence& layer = layers_[under_way];
        line += fmt::format(" layer {} at {:.4g}° ({} of {})", layer.number, degrees(layer.theta),
                            under_way + 1, layers_.size());
    }
    line += fmt::format(" [{}{}] {:3.0f} %", std::string(filled, '#'),
                        std::string(kBarWidth - filled, '.'), 100 * share);
    if (p.per_second > 0) {
        if (light) line += fmt::format("  {}rays/s", short_number(p.per_second));
        if (picture) line += fmt::format("  {}samples/s", short_number(p.per_second));
        line += fmt::format("  {} left", clock_text(p.seconds_left));
    }
    return line;
}

void ProgressBar::show(const Progress& progress) {
    const std::scoped_lock lock(mutex_);
    if (progress.total == 0) return;
    if (terminal_) {
        write_control(fmt::format("\r{}\x1b[K", line_of(progress)));
        drawn_ = true;
        return;
    }
    if (progress.stage != stage_) {
        stage_ = progress.stage;
        quarters_ = 0;
        last_seconds_ = 0;
    }
    const int quarters = static_cast<int>(
        4 * (static_cast<double>(progress.done) / static_cast<double>(progress.total)));
    const bool due = progress.seconds - last_seconds_ > kSecondsBetweenLines;
    if (quarters > quarters_ && quarters < 4 && due) {
        quarters_ = quarters;
        last_seconds_ = progress.seconds;
        write_err(line_of(progress) + "\n");
    }
}

}  // namespace asperity::cli
