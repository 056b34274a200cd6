// SPDX-License-Identifier: Apache-2.0
#include <asperity/gonio/measure.h>
#include <asperity/surface/make_surface.h>

#include <gtest/gtest.h>

#include <string>

namespace asperity {
namespace {

TEST(MeasurementHead, SaysWhereLobesAreNarrowerThanCells) {
    const auto notes = [](double alpha, double theta_deg, int resolution) {
        Experiment e;
        e.surface.kind = "gaussian";
        e.surface.size = 64;
        e.surface.alpha_x = e.surface.alpha_y = alpha;
        e.illumination.theta_deg = {0, theta_deg};
        e.detector.resolution = resolution;
        e.run.rays = 1000;
        asperity::Run run(1);
        std::string all;
        for (const std::string& note : measure(make_surface(e.surface, run), e, run).notes)
            all += note;
        return all;
    };
    // 2 alpha = 0.06 are 4.9 rows of 0.7 degrees; a column is 1.4 degrees, 0.0245, from 66 degrees
    // on; 8 rows are 418 columns
    const std::string said = notes(0.03, 80, 256);
    EXPECT_NE(said.find("4.9 cells wide"), std::string::npos) << said;
    EXPECT_NE(said.find("from 66 degrees"), std::string::npos) << said;
    EXPECT_NE(said.find("--resolution 448"), std::string::npos) << said;
    EXPECT_EQ(notes(0.03, 80, 448), "");
    EXPECT_EQ(notes(0.03, 50, 256), "");
    EXPECT_EQ(notes(0.1, 80, 256), "");
}

}  // namespace
}  // namespace asperity
