// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "console.h"
#include "options.h"

#include <asperity/gonio/measurement.h>

#include <CLI/CLI.hpp>

#include <chrono>
#include <optional>
#include <string>

namespace asperity::cli {

/// What the verbs that measure, and that put measurements together, have in common: where the
/// result goes, what is told of it, and checkpoints.
class Measuring {
  public:
    /// Adds --output, --reference, --json and --quiet.
    void add_output(CLI::App& app, const std::string& otherwise);
    /// Adds --threads, --checkpoint and --resume.
    void add_run(CLI::App& app);

    bool has_output() const { return output_->count() > 0; }
    std::string output() const { return text_of(output_); }

    /// Refuses an output that no result can be written to.
    void check_output() const;
    /// Refuses what would fail only after the work is done. `path` is empty if nothing is written.
    void check(const Experiment& experiment, const std::string& path) const;

    /// What to measure, and from where to go on.
    struct Task {
        Experiment experiment;
        std::optional<Measurement> so_far = {};
        int part = 1, parts = 1;
    };
    /// Measures, keeps checkpoints beside `path`, writes the result there and tells of it. Returns
    /// the exit code.
    int measure(Task task, const std::string& path);
    /// Finds what an earlier run with the same options left at `path` or beside it, if --resume
    /// asks for it. Throws Error(InvalidInput, file) for what is of other options.
    std::optional<Measurement> left_behind(const Measurement& head, const std::string& path,
                                           const Talk& say) const;
    /// Writes the checkpoint beside `path`; that it could not is said once.
    void keep(const Measurement& so_far, const std::string& path);
    /// Says that the checkpoint of an earlier run will be lost, if there is one: it stays until
    /// this run writes its first, or ends.
    static void warn_of_checkpoint(const std::string& path);
    /// No checkpoint is wanted: an hour.
    std::chrono::milliseconds checkpoint_period() const;
    /// Throws Error(Stopped): there is nothing to write.
    [[noreturn]] static void refuse_nothing();
    bool resumes() const { return resume_; }
    bool quiet() const { return quiet_; }
    bool json() const { return json_; }
    int threads() const { return threads_.threads(); }

    /// Writes a complete result to `path` and tells of it.
    void finish(const Measurement& measurement, const std::string& path, int threads) const;

  private:
    void describe(const Talk& say, const Measurement& head, const Heightfield& surface) const;
    void tell(const Talk& say, const Measurement& measurement, const std::string& checksum,
              const std::string& path, int threads) const;
    double checkpoint_seconds() const;

    ThreadsOption threads_;
    CLI::Option *output_ = nullptr, *reference_ = nullptr, *checkpoint_ = nullptr;
    bool resume_ = false, json_ = false, quiet_ = false, warned_ = false;
};

}  // namespace asperity::cli
