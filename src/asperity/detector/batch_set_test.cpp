// SPDX-License-Identifier: Apache-2.0
#include <asperity/detector/batch_set.h>

#include <gtest/gtest.h>

namespace asperity {
namespace {

TEST(BatchSet, RangesJoinInAnyOrder) {
    BatchSet set;
    EXPECT_EQ(set.end(), 0u);
    EXPECT_TRUE(set.add({4, 5}));
    EXPECT_TRUE(set.add({0, 2}));
    EXPECT_TRUE(set.add({8, 9}));
    EXPECT_EQ(set.ranges(), (std::vector<BatchRange>{{0, 2}, {4, 5}, {8, 9}}));
    EXPECT_TRUE(set.add({2, 4}));
    EXPECT_EQ(set.ranges(), (std::vector<BatchRange>{{0, 5}, {8, 9}}));
    EXPECT_EQ(set.count(), 6u);
    EXPECT_EQ(set.end(), 9u);
    EXPECT_EQ(set.first_missing(), 5u);
    EXPECT_TRUE(set.contains(4));
    EXPECT_FALSE(set.contains(5));
}

TEST(BatchSet, TellsWhatIsMissing) {
    BatchSet set;
    EXPECT_EQ(set.missing(3), (std::vector<BatchRange>{{0, 3}}));
    ASSERT_TRUE(set.add({2, 4}));
    ASSERT_TRUE(set.add({6, 9}));
    EXPECT_EQ(set.missing(12), (std::vector<BatchRange>{{0, 2}, {4, 6}, {9, 12}}));
    EXPECT_EQ(set.missing(5), (std::vector<BatchRange>{{0, 2}, {4, 5}}));
    EXPECT_EQ(set.missing(2), (std::vector<BatchRange>{{0, 2}}));
    EXPECT_EQ(common({2, 8}, {5, 20}), (BatchRange{5, 8}));
    EXPECT_EQ(common({2, 8}, {10, 20}).size(), 0u);
    EXPECT_EQ(common({2, 8}, {0, 1}).size(), 0u);
}

TEST(BatchSet, NothingIsAddedTwice) {
    BatchSet set;
    ASSERT_TRUE(set.add({3, 7}));
    const BatchSet before = set;
    for (const BatchRange again : {BatchRange{6, 8}, {0, 4}, {4, 5}, {0, 9}, {3, 7}, {9, 9}})
        EXPECT_FALSE(set.add(again)) << again.begin;
    BatchSet other;
    ASSERT_TRUE(other.add({0, 1}));
    ASSERT_TRUE(other.add({6, 7}));
    EXPECT_FALSE(set.add(other));
    EXPECT_EQ(set, before);
}

}  // namespace
}  // namespace asperity
