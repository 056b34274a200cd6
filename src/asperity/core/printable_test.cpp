// SPDX-License-Identifier: Apache-2.0
#include <asperity/core/printable.h>

#include <asperity/core/parse_number.h>
#include <gtest/gtest.h>

namespace asperity {
namespace {

TEST(Printable, KeepsTextAndReplacesTheRest) {
    EXPECT_EQ(printable("H\xc3\xb6he \xc2\xb5m \xe2\x84\xab \xf0\x9f\x98\x80"),
              "H\xc3\xb6he \xc2\xb5m \xe2\x84\xab \xf0\x9f\x98\x80");
    EXPECT_EQ(printable("H\xf6he \xb5m"), "H?he ?m");       // Latin-1
    EXPECT_EQ(printable("a\nb\x1b[31m\x7f"), "a?b?[31m?");  // control characters
    EXPECT_EQ(printable("\xc2\x9b"
                        "31m"),
              "?31m");                                                // one of the second half
    EXPECT_EQ(printable("\xc0\xaf\xe0\x80\xaf"), "?????");            // overlong
    EXPECT_EQ(printable("\xed\xa0\x80\xf4\x90\x80\x80"), "???????");  // surrogate, too large
    EXPECT_EQ(printable("\xe2\x84"), "??");                           // cut
    EXPECT_EQ(in_quotes("\xb5m\x01"), "'?m?'");
}

}  // namespace
}  // namespace asperity
