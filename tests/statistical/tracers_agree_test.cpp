// SPDX-License-Identifier: Apache-2.0
//
// The wide tracer against its readable twin, a million rays for every kind of surface: steep and
// grazing, along the axes, through vertices, reflected; and a million in lines of light.
// docs/performance.md, "Ties".
#include <asperity/tracing/test_tracers.h>

#include <gtest/gtest.h>

namespace asperity {
namespace {

using test::Case;
class TracersAgree : public testing::TestWithParam<Case> {};
INSTANTIATE_TEST_SUITE_P(
    Surfaces, TracersAgree,
    testing::Values(Case{"gaussian_smooth", "gaussian", 0.1414},
                    Case{"gaussian", "gaussian", 0.4243}, Case{"gaussian_rough", "gaussian", 0.99},
                    Case{"noise", "thesis", 0.2}, Case{"noise_rough", "thesis", 1.0},
                    Case{"ggx", "ggx", 0.5}, Case{"pyramids", "pyramids", 0.3, 1e-4}),
    test::name_of_case);

TEST_P(TracersAgree, ForAMillionRays) {
    const Heightfield s = test::surface_of(GetParam(), 256);
    const test::Agreement a = test::follow_both(s, 500000, 7);
    ASSERT_GE(a.rays, 1000000);
    // Ties: rays that pass an edge or a grazed facet within rounding of single precision. On
    // pyramids every eighth ray begins above a vertex or runs along an edge between two facets of
    // one plane: which of both it hits is a matter of rounding.
    const int most = static_cast<int>(GetParam().ties * a.rays);
    RecordProperty("other_end", a.other_end);
    RecordProperty("other_facet", a.other_facet);
    EXPECT_LE(a.other_end, most);
    EXPECT_LE(a.other_facet, most);
}

TEST_P(TracersAgree, ForAMillionRaysInLines) {
    const Heightfield s = test::surface_of(GetParam(), 256);
    const test::Agreement a = test::follow_lines(s, 1000, 1000);
    ASSERT_EQ(a.rays, 1000000);
    RecordProperty("other_facet", a.other_facet);
    EXPECT_EQ(a.other_end, 0);
    EXPECT_LE(a.other_facet, static_cast<int>(GetParam().ties * a.rays));
}

}  // namespace
}  // namespace asperity
