// SPDX-License-Identifier: Apache-2.0
//
// For tests: a small rough surface, a small experiment, and what came out of it.
#pragma once

#include <asperity/core/random.h>
#include <asperity/gonio/measure.h>

#include <gtest/gtest.h>

#include <utility>

namespace asperity::test {

inline Heightfield noise(int n, double height, std::uint64_t seed = 1) {
    Heightfield s;
    s.nx = s.ny = n;
    s.name = "noise";
    const CounterRandom random(seed, 99);
    for (int k = 0; k < n * n; ++k)
        s.heights.push_back(
            static_cast<float>(height * random.uniform2(static_cast<std::uint64_t>(k))[0]));
    return s;
}

inline Experiment small_experiment() {
    Experiment e;
    e.illumination.theta_deg = {0, 50};
    e.detector.resolution = 32;
    e.run.rays = 20000;
    e.run.bounces = 5;
    return e;
}

inline Measurement measured(const Heightfield& s, const Experiment& e, int threads = 2) {
    asperity::Run run(threads);
    return measure(s, e, run);
}

/// A part of it, or one that goes on.
inline Measurement measured(const Heightfield& s, const Experiment& e, MeasureScope scope,
                            int threads = 2) {
    asperity::Run run(threads);
    return measure(s, e, run, {}, std::move(scope));
}

inline void expect_same_bits(const Layer& a, const Layer& b) {
    EXPECT_EQ(a.energy, b.energy);
    EXPECT_EQ(a.absorbed, b.absorbed);
    EXPECT_EQ(a.truncated, b.truncated);
    EXPECT_EQ(a.escaped_by_bounce, b.escaped_by_bounce);
    EXPECT_EQ(a.stderr_energy, b.stderr_energy);
    EXPECT_EQ(a.stderr_albedo, b.stderr_albedo);
    EXPECT_EQ(a.segments, b.segments);
    EXPECT_EQ(a.reflections, b.reflections);
}

inline void expect_same_bits(const Measurement& a, const Measurement& b) {
    ASSERT_EQ(a.layers.size(), b.layers.size());
    for (std::size_t k = 0; k < a.layers.size(); ++k) expect_same_bits(a.layers[k], b.layers[k]);
}

inline OpticsSettings gold_like() {
    OpticsSettings optics;
    optics.fresnel = FresnelKind::Conductor;
    optics.ior = {0.156, 0.424, 1.383};
    optics.k = {3.602, 2.472, 1.916};
    return optics;
}

}  // namespace asperity::test
