// SPDX-License-Identifier: Apache-2.0
#include <asperity/render/tonemap.h>

#include <asperity/render/render_testing.h>

#include <gtest/gtest.h>

#include <limits>

namespace asperity {
namespace {

using test::kInfinity;
using test::kNaN;

double shown(const ToneMapping& mapping, double radiance) {
    return apply(mapping, {0, radiance, 0}).g;
}

TEST(ToneCurve, KnownPoints) {
    const ToneMapping none{0, ToneCurve::None, Transfer::Linear};
    EXPECT_EQ(shown(none, 0.25), 0.25);
    EXPECT_EQ(shown(none, 1.5), 1);
    const ToneMapping reinhard{0, ToneCurve::Reinhard, Transfer::Linear};
    EXPECT_NEAR(shown(reinhard, 1), 0.5, 1e-15);
    EXPECT_NEAR(shown(reinhard, 3), 0.75, 1e-15);
    const ToneMapping aces{0, ToneCurve::Aces, Transfer::Linear};
    EXPECT_NEAR(shown(aces, 1), 2.54 / 3.16, 1e-15);
    // (0.5 * (1.255 + 0.03)) / (0.5 * (1.215 + 0.59) + 0.14)
    EXPECT_NEAR(shown(aces, 0.5), 0.6425 / 1.0425, 1e-15);
    EXPECT_EQ(shown(aces, 100), 1);
}

// IEC 61966-2-1: linear up to 0.0031308, where the number is 0.04045.
TEST(Transfer, KnownPoints) {
    const ToneMapping srgb{0, ToneCurve::None, Transfer::Srgb};
    EXPECT_NEAR(shown(srgb, 0.001), 0.01292, 1e-15);
    EXPECT_NEAR(shown(srgb, 0.0031308), 0.04045, 1e-6);
    EXPECT_NEAR(shown(srgb, 0.0031309), 0.04045, 2e-6);
    EXPECT_NEAR(shown(srgb, 0.5), 0.735357, 1e-6);
    EXPECT_NEAR(shown(srgb, 1), 1, 1e-15);
    const ToneMapping gamma{0, ToneCurve::None, Transfer::Gamma22};
    EXPECT_NEAR(shown(gamma, std::pow(0.5, 2.2)), 0.5, 1e-15);
    EXPECT_NEAR(shown(kThesisLook, 1), std::pow(0.5, 1 / 2.2), 1e-15);
}

TEST(ToneMapping, ExposureIsInStops) {
    ToneMapping mapping{3, ToneCurve::None, Transfer::Linear};
    EXPECT_NEAR(shown(mapping, 0.1), 0.8, 1e-15);
    mapping.exposure = -2;
    EXPECT_NEAR(shown(mapping, 1), 0.25, 1e-15);
}

TEST(ToneMapping, IsMonotonicAndWithinZeroAndOne) {
    for (const ToneCurve curve : {ToneCurve::None, ToneCurve::Reinhard, ToneCurve::Aces}) {
        for (const Transfer transfer : {Transfer::Srgb, Transfer::Gamma22, Transfer::Linear}) {
            for (const double exposure : {-100.0, 0.0, 100.0}) {
                const ToneMapping mapping{exposure, curve, transfer};
                double before = 0;
                for (int tenth = -200; tenth < 10000; ++tenth) {
                    const double now = shown(mapping, std::exp2(0.1 * tenth));
                    ASSERT_GE(now, before - 1e-15);
                    ASSERT_LE(now, 1);
                    before = now;
                }
                EXPECT_NEAR(shown(mapping, kInfinity), 1, 1e-15);
                EXPECT_EQ(shown(mapping, kNaN), 0);
                EXPECT_EQ(shown(mapping, -1), 0);
                EXPECT_EQ(shown(mapping, 0), 0);
            }
        }
    }
}

TEST(ToBytes, RoundsToNearest) {
    const ToneMapping linear{0, ToneCurve::None, Transfer::Linear};
    const Image image{2, 1, {0.49F / 255, 0.51F / 255, 1, 254.4F / 255, 254.6F / 255, 2}};
    EXPECT_EQ(to_bytes(linear, image), (std::vector<std::uint8_t>{0, 1, 255, 254, 255, 255}));
}

TEST(ToBytes, SameForAnyNumberOfThreads) {
    Image image{31, 17, {}};
    for (int k = 0; k < 3 * 31 * 17; ++k) image.rgb.push_back(0.001F * static_cast<float>(k));
    const auto alone = to_bytes({}, image);
    EXPECT_EQ(alone.size(), image.rgb.size());
    for (const int threads : {2, 7}) EXPECT_EQ(to_bytes({}, image, threads), alone);
    EXPECT_TRUE(to_bytes({}, Image{}).empty());
}

}  // namespace
}  // namespace asperity
