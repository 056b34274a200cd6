// SPDX-License-Identifier: Apache-2.0
// asperity-mpi simulate: the main job on many machines. Ranks share out the batches that are
// missing, trace for a while, add their sums up, and share out again: docs/cluster.md.
#include "reduce.h"

#include "../cli/console.h"
#include "../cli/help.h"
#include "../cli/measuring.h"
#include "../cli/options.h"
#include "../cli/stop.h"

#include <asperity/core/error.h>
#include <asperity/core/version.h>
#include <asperity/formats/heights/surface_files.h>
#include <asperity/formats/results/result_file.h>
#include <asperity/gonio/angles_of_lobe.h>
#include <asperity/gonio/batch_plan.h>
#include <asperity/gonio/layer_of_sums.h>
#include <asperity/gonio/measure.h>
#include <asperity/gonio/measurement_head.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <new>
#include <thread>
#include <utility>

namespace asperity::mpi {

namespace {

constexpr const char* kClosing =
    "The options are those of asperity simulate, and so is the result, to the bit, for any number "
    "of\n"
    "ranks and threads. Each rank makes or reads the surface by itself: a file must be where all "
    "of\n"
    "them see it. FILE.checkpoint is written by rank 0 whenever the ranks add up what they did.\n"
    "\n"
    "Example\n"
    "  mpirun -n 4 asperity-mpi simulate --surface gaussian:alpha=0.3 --until 0.1% -o r.asperity\n";

int rank_of(MPI_Comm ranks) {
    int rank = 0;
    MPI_Comm_rank(ranks, &rank);
    return rank;
}

int size_of(MPI_Comm ranks) {
    int size = 1;
    MPI_Comm_size(ranks, &size);
    return size;
}

/// Asks a run to stop when its time is over, or when the user wants it.
class Timer {
  public:
    Timer(Run& run, const Run& asked, std::chrono::milliseconds time)
        : thread_([this, &run, &asked, time] {
              const auto end = std::chrono::steady_clock::now() + time;
              std::unique_lock lock(mutex_);
              while (!over_ && !asked.stop_requested() && std::chrono::steady_clock::now() < end)
                  changed_.wait_for(lock, std::chrono::milliseconds(20));
              if (!over_) run.request_stop();
          }) {}
    ~Timer() {
        {
            const std::scoped_lock lock(mutex_);
            over_ = true;
        }
        changed_.notify_all();
        thread_.join();
    }
    Timer(const Timer&) = delete;
    Timer& operator=(const Timer&) = delete;

  private:
    std::mutex mutex_;
    std::condition_variable changed_;
    bool over_ = false;
    std::thread thread_;
};

class SimulateOnRanks {
  public:
    explicit SimulateOnRanks(CLI::App& app) {
        using namespace cli;
        experiment_.add_to(app, {kSurface, kLight, kFacets, kDetector, kRun}, true);
        measuring_.add_run(app);
        measuring_.add_output(app, "only the table is shown");
        set_help(app, "simulate --surface SPEC|FILE [options] -o FILE", kClosing);
    }

    int run() {
        const bool first = rank_of(MPI_COMM_WORLD) == 0;
        Experiment experiment = experiment_.read();
        const std::string path = measuring_.has_output() ? measuring_.output() : "";
        measuring_.check(experiment, path);
        Run asked(measuring_.threads());
        const cli::StopOnSignal stop(asked);
        const Heightfield surface = io::load_surface(experiment.surface, asked);
        experiment = with_angles(surface, experiment, asked);
        const Measurement head = head_of(surface, experiment, asked);
        require_same_surface(head.surface_digest);

        const cli::Talk say(measuring_.quiet() || !first, measuring_.json());
        std::optional<Measurement> so_far = measuring_.left_behind(head, path, say);
        if (first && !measuring_.resumes() && !path.empty())
            cli::Measuring::warn_of_checkpoint(path);
        for (bool more = true; more && !any(asked.stop_requested());) {
            so_far = slice(surface, experiment, asked, std::move(so_far), more);
            if (more && first && !path.empty()) measuring_.keep(*so_far, path);
        }
        if (!so_far || so_far->layers.empty()) cli::Measuring::refuse_nothing();
        so_far->stopped = any(asked.stop_requested());
        if (so_far->stopped) so_far->notes.emplace_back("stopped before it was complete");
        if (first) measuring_.finish(*so_far, path, asked.threads());
        return so_far->stopped ? static_cast<int>(ErrorCode::Stopped) : 0;
    }

  private:
    /// Traces for a while, and adds up what all ranks did. `more`: it may not have been all.
    Measurement slice(const Heightfield& surface, const Experiment& experiment, const Run& asked,
                      std::optional<Measurement> so_far, bool& more) const {
        const int rank = rank_of(MPI_COMM_WORLD);
        Run run(asked.threads());
        MeasureScope scope{so_far, rank + 1, size_of(MPI_COMM_WORLD), true};
        Measurement mine;
        {
            const Timer timer(run, asked, measuring_.checkpoint_period());
            mine = measure(surface, experiment, run, {}, std::move(scope));
        }
        const SumShape shape = mine.shape();
        const std::uint64_t largest = BatchPlan(surface.cell_count(), experiment.run).largest();
        more = false;
        std::vector<Layer> layers;
        for (const Incidence& light : incidences(experiment.illumination)) {
            auto sums = sum_over_ranks(sums_in(mine, light, shape), shape, largest, MPI_COMM_WORLD);
            more = more || sums;
            if (auto before = so_far ? sums_in(*so_far, light, shape) : std::nullopt) {
                if (sums)
                    *sums += *before;
                else
                    sums = std::move(before);
            }
            if (sums) layers.push_back(layer_of(light, *sums));
        }
        // A rank that was stopped while it prepared did nothing, but has something to do
        more = more || any(mine.stopped);
        if (any(mine.surface.area_ratio == 0)) mine.surface = statistics(surface, asked);
        mine.layers = std::move(layers);
        mine.part = mine.parts = 1;
        mine.stopped = more;
        mine.trace_seconds += so_far ? so_far->trace_seconds : 0;
        std::erase_if(mine.notes, [](const std::string& note) {
            return note.starts_with("part ") || note.starts_with("stopped before");
        });
        return mine;
    }

    static std::optional<LayerSums> sums_in(const Measurement& m, const Incidence& light,
                                            const SumShape& shape) {
        for (const Layer& layer : m.layers)
            if (layer.number == light.number) return sums_of(layer, shape);
        return std::nullopt;
    }

    static void require_same_surface(const std::string& digest) {
        std::array<char, 32> first{};
        std::copy_n(digest.begin(), std::min(digest.size(), first.size()), first.begin());
        MPI_Bcast(first.data(), static_cast<int>(first.size()), MPI_CHAR, 0, MPI_COMM_WORLD);
        if (any(!std::equal(digest.begin(), digest.end(), first.begin(), first.end())))
            throw Error(ErrorCode::InvalidInput, "the ranks do not have the same heights",
                        "surface");
    }

    cli::ExperimentOptions experiment_;
    cli::Measuring measuring_;
};

/// Parses and runs; throws what the verb throws.
int run_program(int argc, char** argv) {
    CLI::App program("asperity simulate on the ranks of MPI", "asperity-mpi");
    program.set_version_flag("--version", std::string("asperity-mpi ") + kVersion);
    program.require_subcommand(1, 1);
    CLI::App* app = program.add_subcommand("simulate", "shoot light at a surface on all ranks");
    SimulateOnRanks verb(*app);
    const bool first = rank_of(MPI_COMM_WORLD) == 0;
    try {
        program.parse(argc, argv);
    } catch (const CLI::CallForVersion& version) {
        if (first) cli::write_out(std::string(version.what()) + "\n");
        return 0;
    } catch (const CLI::CallForHelp&) {
        if (first) cli::write_out(app->parsed() ? app->help() : program.help());
        return 0;
    } catch (const CLI::ParseError& error) {
        throw Error(ErrorCode::Usage, error.what());
    }
    return verb.run();
}

}  // namespace
}  // namespace asperity::mpi

int main(int argc, char** argv) {
    using namespace asperity;
    int given = 0;
    MPI_Init_thread(&argc, &argv, MPI_THREAD_FUNNELED, &given);
    const int rank = mpi::rank_of(MPI_COMM_WORLD);
    int code = 0;
    std::string why;
    try {
        cli::prepare_standard_streams();
        code = mpi::run_program(argc, argv);
    } catch (const Error& error) {
        code = static_cast<int>(error.code());
        why = error.what();
    } catch (const std::bad_alloc&) {
        code = static_cast<int>(ErrorCode::OutOfMemory);
        why = "not enough memory";
    } catch (const std::exception& error) {
        code = 1;
        why = std::string("unexpected: ") + error.what();
    }
    if (!why.empty()) {
        // What all ranks refuse, as wrong options, the first one says; others end at once with it
        if (rank > 0) std::this_thread::sleep_for(std::chrono::milliseconds(500));
        cli::write_err(fmt::format("asperity-mpi: error: {}{}\n",
                                   rank > 0 ? fmt::format("rank {}: ", rank) : "", why));
        MPI_Abort(MPI_COMM_WORLD, code);
    }
    MPI_Finalize();
    return code;
}
