// SPDX-License-Identifier: Apache-2.0
#include <asperity/core/length.h>

#include <gtest/gtest.h>

namespace asperity {
namespace {

TEST(Length, IsReadWithAUnitOrWithout) {
    EXPECT_EQ(parse_length("2.5um"), (Length{2.5, "um"}));
    EXPECT_EQ(parse_length(" 2.5 \xc2\xb5m "), (Length{2.5, "um"}));
    EXPECT_EQ(parse_length("1e-3 mm"), (Length{1e-3, "mm"}));
    EXPECT_EQ(parse_length("-7"), (Length{-7, ""}));
    for (const char* bad : {"", "um", "2.5 parsec", "2,5 um", "1e um", "nan", "2 um 3"})
        EXPECT_FALSE(parse_length(bad)) << bad;
}

TEST(Length, TextIsReadBack) {
    for (const Length& length : {Length{0.1, "um"}, Length{3, ""}, Length{1e-9, "m"}})
        EXPECT_EQ(parse_length(text_of(length)), length);
}

TEST(Length, IsTakenInTheUnitOfTheSurface) {
    EXPECT_DOUBLE_EQ(in_unit({2.5, "um"}, "m").value(), 2.5e-6);
    EXPECT_EQ(in_unit({2.5, ""}, "cell"), 2.5);
    EXPECT_FALSE(in_unit({2.5, "um"}, "cell"));
    EXPECT_EQ(length_text(3.66e-7), "0.366 um");
}

}  // namespace
}  // namespace asperity
