// SPDX-License-Identifier: Apache-2.0
#include <asperity/surface/thesis_noise.h>

#include <asperity/core/random.h>
#include <asperity/surface/blocks.h>

namespace asperity {

namespace {

constexpr std::uint32_t kThesisStream = 0x54485349;  // of the random numbers, "THSI"

}  // namespace

void fill_thesis_noise(Heightfield& surface, double roughness, std::uint64_t seed, Run& run) {
    const CounterRandom random(seed, kThesisStream);
    const double scale = 10 * roughness * 0x1p-32;
    const auto nx = static_cast<std::uint64_t>(surface.nx);
    for_blocks(surface.ny, kRowsPerBlock, run, [&](int first, int last) {
        const std::uint64_t begin = static_cast<std::uint64_t>(first) * nx;
        const std::uint64_t end = static_cast<std::uint64_t>(last) * nx;
        // A draw gives four words, for samples 4 n .. 4 n + 3
        auto words = random.bits(begin / 4);
        for (std::uint64_t k = begin; k < end; ++k) {
            if (k % 4 == 0) words = random.bits(k / 4);
            const double word = static_cast<double>(words[k % 4]);
            surface.heights[k] = static_cast<float>(scale * (word + 0.5));
        }
        run.advance(static_cast<std::uint64_t>(last - first));
    });
}

}  // namespace asperity
