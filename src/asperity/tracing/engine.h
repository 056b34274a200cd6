// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/core/run.h>
#include <asperity/detector/batch_sums.h>
#include <asperity/detector/detector.h>
#include <asperity/detector/illumination.h>
#include <asperity/optics/fresnel.h>
#include <asperity/surface/heightfield.h>
#include <asperity/tracing/launch.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace asperity {

/// What light falls on and what it is sorted into. Outlives the engine made for it.
struct EngineSetup {
    const Heightfield& surface;
    const Fresnel& fresnel;
    const Detector& detector;
    int bounces = 1;  ///< Ray Bounces B: reflections a ray may make
};

/// The working memory of one thread; whatever an engine needs.
class Worker {
  public:
    virtual ~Worker() = default;
};

/// The surface in light of one direction.
class LitSurface {
  public:
    virtual ~LitSurface() = default;
    /// Traces one batch and adds what became of its energy to `sums`: the same bits on any worker,
    /// whichever batches it had before. Calls run.advance() with the rays done; false, within some
    /// milliseconds, if the run is stopped first: the sums then hold a part and must be cleared.
    virtual bool trace(const BatchRequest& batch, Worker& worker, BatchSums& sums,
                       Run& run) const = 0;
};

/// A way to follow light over a surface. Bits are promised within an engine, for any number of
/// threads; between engines the same means. All functions may be called from any thread.
class Engine {
  public:
    virtual ~Engine() = default;
    /// Works out what all batches of this light have in common, on so many threads. `rays` of the
    /// layer, in a first estimate, tell what is worth the work; what comes out depends on them and
    /// on nothing but light and setup. Once the run is stopped it may be left unfinished.
    virtual std::unique_ptr<LitSurface> light(const Incidence& incidence, LaunchPattern pattern,
                                              std::uint64_t rays, const Run& run,
                                              int threads) const = 0;
    /// Serves this engine, and others of its kind with other surfaces and all else alike.
    virtual std::unique_ptr<Worker> worker() const = 0;
    /// Bytes kept beside the heights themselves.
    virtual std::size_t memory_bytes() const = 0;
};

/// A row of the list of engines.
struct EngineKind {
    std::string name;      ///< as the setting `engine` says
    std::string sentence;  ///< for those who choose
    /// Calls run.advance() with cells, surface.cell_count() of them; throws Error(Stopped).
    std::function<std::unique_ptr<Engine>(const EngineSetup& setup, Run& run)> make;
};

/// All engines, those of programs that use the library included; the first one is the default.
std::vector<EngineKind> engines();
/// Throws Error(Usage, "engine") for a name that none has.
EngineKind find_engine(std::string_view name);
/// Adds a row to the list: from then on settings may name it. Throws Error(Usage, name) for a name
/// that is empty or taken, or without a function.
void add_engine(EngineKind kind);

}  // namespace asperity
