// SPDX-License-Identifier: Apache-2.0
#include <asperity/core/error.h>
#include <asperity/gonio/memory_need.h>
#include <asperity/gonio/test_measurements.h>

#include <gtest/gtest.h>

namespace asperity {
namespace {

TEST(MemoryNeed, CountsLayersChannelsOrdersAndTheSurface) {
    const Heightfield surface = test::noise(100, 1);
    Experiment e;
    e.illumination.theta_deg = {0, 30};
    e.illumination.phi_deg = {0, 10, 20};
    e.detector.resolution = 64;
    e.detector.orders = 4;
    e.run.engine = "plain";
    // 2048 cells: 4 sums of 8 bytes, squares of 16, a count and an error of 4, 16 sums by groups;
    // once more without the error
    EXPECT_EQ(memory_needed(surface, e), 2048u * (6 * (32 + 20 + 4 + 128) + 32 + 20 + 128));
    e.run.bounces = 2;
    EXPECT_EQ(memory_needed(surface, e), 2048u * (6 * (16 + 20 + 4 + 128) + 16 + 20 + 128));
    e.optics = test::gold_like();
    EXPECT_EQ(memory_needed(surface, e), 3 * 2048u * (6 * (16 + 20 + 4 + 128) + 16 + 20 + 128));
    const std::uint64_t without = memory_needed(surface, e);
    e.run.engine = "wide";
    EXPECT_EQ(memory_needed(surface, e), without + 6 * 100 * 100);
}

TEST(MemoryNeed, CountsTheSurfacesThatAreKept) {
    const Heightfield surface = test::noise(100, 1);
    Experiment e;
    e.run.rays = 1 << 20;
    e.run.engine = "plain";
    const std::uint64_t of_one = memory_needed(surface, e);
    // Heights of 4 bytes each
    e.run.surfaces = 10;
    EXPECT_EQ(memory_needed(surface, e), of_one + 10 * surface.heights.size() * 4);
    // ... and 6 more of every cell in the wide engine, which there is once for each
    e.run.engine = "wide";
    EXPECT_EQ(memory_needed(surface, e),
              of_one + 10 * (surface.heights.size() * 4 + 6 * 100 * 100));
    // No more than there is room for
    e.run.surfaces = 1 << 20;
    EXPECT_LE(memory_needed(surface, e), of_one + (std::uint64_t{1} << 30));
    EXPECT_GE(memory_needed(surface, e), of_one + (std::uint64_t{1} << 20));
}

TEST(MemoryNeed, WhatNoMachineHasIsRefusedAtOnce) {
    Experiment e;
    e.illumination.layers = 9000;
    e.detector.resolution = 8192;
    try {
        (void)test::measured(test::noise(16, 1), e);
        ADD_FAILURE() << "was not refused";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::OutOfMemory);
        EXPECT_NE(std::string(error.what()).find("the measurement: needs at least 16"),
                  std::string::npos)
            << error.what();
    }
}

TEST(Experiment, HasAHundredThousandLayersAtMost) {
    Experiment e;
    e.illumination.phi_deg.assign(100, 5);
    e.illumination.theta_deg.assign(1000, 5);
    EXPECT_NO_THROW(validate(e));
    const auto refused = [&](const char* setting) {
        try {
            validate(e);
        } catch (const Error& error) {
            return error.code() == ErrorCode::Usage && error.where() == setting;
        }
        return false;
    };
    e.illumination.phi_deg.push_back(5);
    EXPECT_TRUE(refused("phi"));
    e.illumination.phi_deg = {0};
    e.illumination.theta_deg.assign(100001, 5);
    EXPECT_TRUE(refused("theta"));
    e.illumination.theta_deg.clear();
    e.illumination.layers = 9000;
    e.illumination.phi_deg.assign(12, 5);
    EXPECT_TRUE(refused("phi"));
}

}  // namespace
}  // namespace asperity
