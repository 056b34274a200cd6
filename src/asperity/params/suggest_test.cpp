// SPDX-License-Identifier: Apache-2.0
#include <asperity/params/suggest.h>

#include <gtest/gtest.h>

namespace asperity {
namespace {

TEST(Suggest, NearestName) {
    const std::vector<std::string> names = {"rays", "jitter", "autocorrelation", "k"};
    EXPECT_EQ(nearest("raiz", names), "rays");
    EXPECT_EQ(nearest("jiter", names), "jitter");
    EXPECT_EQ(nearest("ijtter", names), "jitter");
    EXPECT_EQ(nearest("autocor", names), "autocorrelation");
    EXPECT_EQ(nearest("xyzzy", names), "");
    EXPECT_EQ(nearest(std::string(1000, 'a'), names), "");
    EXPECT_EQ(did_you_mean("ray", names), "; did you mean rays?");
    EXPECT_EQ(did_you_mean("xyzzy", names), "");
}

}  // namespace
}  // namespace asperity
