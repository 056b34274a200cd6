// SPDX-License-Identifier: Apache-2.0
#include <asperity/gonio/measurement_check.h>
#include <asperity/gonio/measurement_ranges.h>
#include <asperity/gonio/test_measurements.h>

#include <gtest/gtest.h>

#include <functional>
#include <limits>

namespace asperity {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN(),
                 kInfinity = std::numeric_limits<double>::infinity();

Measurement small_measurement() {
    Experiment e = test::small_experiment();
    e.illumination.phi_deg = {10, 20};
    e.run.rays = 1000;
    return test::measured(test::noise(16, 1), e);
}

TEST(MeasurementRanges, WhatWasMeasuredIsInRange) {
    Measurement m = small_measurement();
    ASSERT_EQ(m.layers.size(), 4u);
    EXPECT_EQ(out_of_range(m), "");
    EXPECT_EQ(io::contradiction(m), "");
    // Stopped before the second
    m.layers.erase(m.layers.begin() + 1);
    EXPECT_EQ(out_of_range(m), "");
    m.layers.clear();
    EXPECT_EQ(out_of_range(m), "");
}

TEST(MeasurementRanges, FindsWhatNoRunCanHave) {
    const Measurement good = small_measurement();
    const auto spoilt = [&](const std::function<void(Measurement&)>& spoil) {
        Measurement m = good;
        spoil(m);
        // Files are read and written through this door
        EXPECT_EQ(io::contradiction(m), out_of_range(m));
        return out_of_range(m);
    };
    const auto in_layer = [&](const std::function<void(Layer&)>& spoil) {
        return spoilt([&](Measurement& m) { spoil(m.layers[2]); });
    };
    for (const double error : {kNan, -1e-9, kInfinity, -kInfinity}) {
        const std::string why = "layer 3: an error that is negative or no number";
        EXPECT_EQ(in_layer([&](Layer& l) { l.stderr_energy[7] = static_cast<float>(error); }), why);
        EXPECT_EQ(in_layer([&](Layer& l) { l.stderr_albedo[0] = error; }), why);
        EXPECT_EQ(in_layer([&](Layer& l) { l.stderr_albedo_by_bounce[1] = error; }), why);
    }
    EXPECT_EQ(in_layer([](Layer& l) { l.batches = -1; }), "layer 3: -1 batches");
    EXPECT_EQ(in_layer([](Layer& l) { l.batches = 1001; }), "layer 3: 1001 batches of 1000 rays");
    EXPECT_EQ(in_layer([](Layer& l) { l.stuck = 1001; }), "layer 3: 1001 of 1000 rays stuck");
    EXPECT_EQ(in_layer([](Layer& l) { l.reflections = 6000; }),
              "layer 3: 6000 reflections of 1000 rays");

    const std::string light =
        "layer 3: the experiment has no such light, or the layers are not in its order";
    EXPECT_EQ(in_layer([](Layer& l) { l.theta_i += 1e-6; }), light);
    EXPECT_EQ(in_layer([](Layer& l) { l.phi_i -= 1e-6; }), light);
    EXPECT_EQ(spoilt([](Measurement& m) { m.layers[2].number = 4; }),
              "layer 4: the experiment has no such light, or the layers are not in its order");
    EXPECT_EQ(spoilt([](Measurement& m) { m.layers.push_back(m.layers[2]); }), light);

    EXPECT_EQ(spoilt([](Measurement& m) { m.surface_nx = -5; }), "a surface of -5 x 16 samples");
    EXPECT_EQ(spoilt([](Measurement& m) { m.surface_dy = 0; }),
              "a surface with samples 1 x 0 apart");
    EXPECT_EQ(spoilt([](Measurement& m) { m.surface_dx = kNan; }),
              "a surface with samples nan x 1 apart");
}

TEST(MeasurementCheck, EveryUnitOfEnergyIsAccountedFor) {
    const Measurement good = small_measurement();
    const auto why = [&](const std::function<void(Layer&)>& spoil) {
        Measurement m = good;
        spoil(m.layers[1]);
        return io::contradiction(m);
    };
    const std::string launched =
        "layer 2: channel all: launched energy is not escaped + absorbed + truncated + edge";
    EXPECT_EQ(why([](Layer& l) { ++l.edge[0]; }), launched);
    EXPECT_EQ(why([](Layer& l) { ++l.rays; }), launched);
    // Sums that only fit because they wrap around 2^64
    EXPECT_EQ(why([](Layer& l) {
                  l.absorbed[0] += std::uint64_t{1} << 63;
                  l.edge[0] += std::uint64_t{1} << 63;
              }),
              launched);
    EXPECT_EQ(why([](Layer& l) { ++l.energy[5]; }),
              "layer 2: channel all: escaped energy is not the sum over the cells");
    EXPECT_EQ(why([](Layer& l) { ++l.escaped_by_bounce[0]; }),
              "layer 2: channel all: escaped energy is not the sum over the bounces");
}

TEST(Measurement, HasNoMoreOrdersThanBounces) {
    Measurement m;
    m.experiment.detector.orders = 4;
    m.experiment.run.bounces = 2;
    EXPECT_EQ(m.orders(), 2);
    m.experiment.run.bounces = 9;
    EXPECT_EQ(m.orders(), 4);
}

TEST(MeasurementRanges, OneBatchMayNotKnowItsError) {
    Measurement m = small_measurement();
    m.layers[0].batches = 1;
    m.layers[0].stderr_albedo[0] = kInfinity;
    EXPECT_EQ(out_of_range(m), "");
    m.layers[0].stderr_albedo[0] = kNan;
    EXPECT_NE(out_of_range(m), "");
}

}  // namespace
}  // namespace asperity
