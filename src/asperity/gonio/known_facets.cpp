// SPDX-License-Identifier: Apache-2.0
#include <asperity/gonio/known_facets.h>

#include <asperity/core/directions.h>
#include <asperity/core/parallel.h>
#include <asperity/gonio/path_kernels.h>

#include <algorithm>
#include <memory>

namespace asperity {

namespace {

constexpr std::uint64_t kLeastRaysPerCell = 4;
constexpr std::uint64_t kMostCells = std::uint64_t{1} << 24;
constexpr int kWidest = (1 << 15) - 1;
/// Rows of facets that one thread looks at at a time.
constexpr int kRows = 16;

std::uint64_t cells_of(const WideTracer& tracer) {
    return static_cast<std::uint64_t>(tracer.cells_x()) *
           static_cast<std::uint64_t>(tracer.cells_y());
}

}  // namespace

bool KnownFacets::pay(const WideTracer& tracer, std::uint64_t rays) {
    const std::uint64_t cells = cells_of(tracer);
    return tracer.periodic() && tracer.cells_x() <= kWidest && cells <= kMostCells &&
           rays / kLeastRaysPerCell >= cells;
}

/// The working memory of a thread.
struct KnownFacets::Work {
    PathWave wave;
    PerPath<float> cosine;
    PerPath<std::int32_t> cells;
    std::vector<PerPath<float>> reflectance;
};

KnownFacets::KnownFacets(const Scene& scene, const Incidence& incidence, const Run& run) {
    const std::size_t facets = 2 * cells_of(scene.tracer);
    const std::size_t channels =
        scene.fresnel.perfect() ? 0 : static_cast<std::size_t>(scene.fresnel.channels());
    cells_.assign(facets, -1);
    reflectance_.assign(channels, std::vector<float>(facets));

    const int rows = 2 * scene.tracer.cells_y();  // of lower facets, then of upper ones
    const auto tasks = static_cast<std::size_t>((rows + kRows - 1) / kRows);
    parallel_for(tasks, run.threads(), [&](std::size_t k) {
        if (!run.keep_going()) return;
        const auto work = std::make_unique<Work>();
        work->reflectance.resize(channels);
        const int begin = static_cast<int>(k) * kRows, end = std::min(begin + kRows, rows);
        for (int row = begin; row < end; ++row) look(scene, incidence, row, *work);
    });
}

/// Looks at the facets of one row, from the middle of each.
void KnownFacets::look(const Scene& scene, const Incidence& incidence, int row, Work& work) {
    const WideTracer& tracer = scene.tracer;
    const int cells_x = tracer.cells_x(), cells_y = tracer.cells_y();
    const double middle = row < cells_y ? 1.0 / 3 : 2.0 / 3;
    PathWave& wave = work.wave;
    for (int i = 0; i < cells_x; i += static_cast<int>(kWave)) {
        const int count = std::min(cells_x - i, static_cast<int>(kWave));
        tracer.clear(wave);
        set_parallel(tracer, incidence, static_cast<std::size_t>(count), wave);
        tracer.launch_down(middle, middle, i, row % cells_y, count, 0, nullptr, wave);
        reflect_paths(wave.points, wave.arriving(), true, tracer.heights(), wave.leaving(),
                      work.cosine);
        std::vector<float*> out;
        for (PerPath<float>& f : work.reflectance) out.push_back(f);
        if (!out.empty()) scene.fresnel.eval({work.cosine.values, wave.points.count}, out);
        tracer.part(wave);
        find_cells(wave.escapes, scene.detector, tracer.mirrored() ? -1.0f : 1.0f, nullptr, nullptr,
                   work.cells);

        const std::size_t first =
            static_cast<std::size_t>(row) * static_cast<std::size_t>(cells_x) +
            static_cast<std::size_t>(i);
        for (std::size_t k = 0; k < wave.escapes.count; ++k) {
            const auto path = static_cast<std::size_t>(wave.escapes.path[k]);
            cells_[first + path] = work.cells[k];
            for (std::size_t c = 0; c < reflectance_.size(); ++c)
                reflectance_[c][first + path] = work.reflectance[c][path];
        }
    }
}

}  // namespace asperity
