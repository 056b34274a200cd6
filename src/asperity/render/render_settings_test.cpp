// SPDX-License-Identifier: Apache-2.0
#include <asperity/core/error.h>
#include <asperity/render/render_settings.h>

#include <gtest/gtest.h>

#include <limits>

namespace asperity {
namespace {

/// The setting check() complains of; empty when all is well.
std::string complaint(const RenderSettings& settings) {
    try {
        check(settings);
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::Usage);
        return error.where();
    }
    return {};
}

TEST(RenderSettings, DefaultsAreFine) {
    EXPECT_EQ(complaint({}), "");
    EXPECT_EQ(RenderSettings().depth, 4);
    EXPECT_EQ(RenderSettings().spp, 64u);
}

TEST(RenderSettings, EachLimitIsKept) {
    const auto with = [](auto change) {
        RenderSettings settings;
        change(settings);
        return complaint(settings);
    };
    EXPECT_EQ(with([](auto& s) { s.width = 0; }), "width");
    EXPECT_EQ(with([](auto& s) { s.width = 16385; }), "width");
    EXPECT_EQ(with([](auto& s) { s.height = -1; }), "height");
    EXPECT_EQ(with([](auto& s) { s.width = s.height = 8192; }), "");
    EXPECT_EQ(with([](auto& s) {
                  s.width = 8193;
                  s.height = 8192;
              }),
              "width");
    EXPECT_EQ(with([](auto& s) { s.spp = 0; }), "spp");
    EXPECT_EQ(with([](auto& s) { s.spp = (1u << 24) + 1; }), "spp");
    EXPECT_EQ(with([](auto& s) { s.until = 1; }), "until");
    EXPECT_EQ(with([](auto& s) { s.until = std::numeric_limits<double>::quiet_NaN(); }), "until");
    EXPECT_EQ(with([](auto& s) { s.depth = 0; }), "depth");
    EXPECT_EQ(with([](auto& s) { s.strata = 1025; }), "strata");
    EXPECT_EQ(with([](auto& s) { s.background.g = -0.1; }), "background");
}

}  // namespace
}  // namespace asperity
