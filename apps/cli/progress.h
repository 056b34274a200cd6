// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/core/run.h>
#include <asperity/detector/illumination.h>

#include <cstddef>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

namespace asperity::cli {

/// Shows how far a Run has come on standard error. On a terminal one line that is drawn anew: what
/// is being done, percent, rays per second, time left. Elsewhere at most three lines a stage, and
/// only of long stages.
class ProgressBar {
  public:
    /// Listens to `run` until it is destroyed, unless `quiet`.
    ProgressBar(Run& run, bool quiet);
    ~ProgressBar();
    ProgressBar(const ProgressBar&) = delete;
    ProgressBar& operator=(const ProgressBar&) = delete;

    /// Names the layer under way, of those that take as many rays each, in this order.
    void name_layers(std::vector<Incidence> layers) { layers_ = std::move(layers); }

    /// Takes the line off the terminal, so that other text may follow.
    void clear();

  private:
    void show(const Progress& progress);
    std::string line_of(const Progress& progress) const;

    Run& run_;
    std::mutex mutex_;  ///< progress may come from any thread
    bool terminal_;
    std::vector<Incidence> layers_;  ///< empty: not known
    bool drawn_ = false;
    std::string stage_;
    int quarters_ = 0;         ///< of this stage that were told
    double last_seconds_ = 0;  ///< of this stage, when the last line was told
};

/// "0:07", "12:30", "3:05:00".
std::string clock_text(double seconds);

/// "950", "12.3 k", "4.56 M", "1.2 G".
std::string short_number(double value);

}  // namespace asperity::cli
