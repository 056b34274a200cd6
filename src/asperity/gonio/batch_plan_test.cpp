// SPDX-License-Identifier: Apache-2.0
#include <asperity/gonio/batch_plan.h>

#include <gtest/gtest.h>

namespace asperity {
namespace {

TEST(BatchPlan, BatchesAreNoLargerThanAMillionRays) {
    RunSettings run;
    run.batches = 2;
    run.rays = 2 << 20;
    EXPECT_EQ(BatchPlan(100, run).batches, 2u);
    run.rays += 1;
    EXPECT_EQ(BatchPlan(100, run).batches, 3u);
    EXPECT_LE(BatchPlan(100, run).largest(), 1u << 20);
}

TEST(BatchPlan, RoundsEndWhereARunWouldHaveLooked) {
    // 100 rays in 3 batches, then 6, then as many as the limit leaves room for
    RunSettings run;
    run.rays = 100;
    run.batches = 3;
    run.max_rays = 330;
    const BatchPlan plan(50, run);
    EXPECT_EQ(plan.round_of(0).end, 3u);
    EXPECT_EQ(plan.round_of(3).end, 3u);
    EXPECT_EQ(plan.round_of(4).end, 6u);
    EXPECT_EQ(plan.round_of(7).end, 9u);  // 330 - 200 rays are room for 3 batches of 34
    EXPECT_EQ(plan.round_of(3).begin, 0u);
    EXPECT_EQ(plan.round_of(4).begin, 3u);
    EXPECT_EQ(plan.round_of(20).end, 9u);  // more than the limit allows
    EXPECT_EQ(plan.rays_before(3), 100u);
    EXPECT_EQ(plan.rays_before(4), 134u);
}

}  // namespace
}  // namespace asperity
