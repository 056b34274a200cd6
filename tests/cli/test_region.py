# SPDX-License-Identifier: Apache-2.0
"""What leaves into a part of the hemisphere, and its error."""
import sys

from program import ProgramTest, main


class Region(ProgramTest):
    def setUp(self):
        super().setUp()
        self.passes("simulate", "--surface", "gaussian", "--size", 64, "--rays", 20000, "--theta",
                    "40,70", "--resolution", 32, "--fresnel", "dielectric", "--ior", 1.5, "-o",
                    "r.asperity")

    def region(self, angles):
        return self.json_of("info", "r.asperity", "--region", angles)

    def test_the_hemisphere_is_the_albedo(self):
        info = self.region("0:90,0:360")
        self.assertEqual(info["region"]["cells"], 32 * 16)
        self.assertAlmostEqual(info["region"]["projected_solid_angle"], 3.14159265, 7)
        for layer, whole in zip(info["layers"], info["region"]["layers"]):
            self.assertAlmostEqual(whole["energy"][0] / layer["albedo"][0], 1, 9)
            self.assertAlmostEqual(whole["energy_stderr"][0] / layer["albedo_stderr"][0], 1, 6)
            self.assertEqual(whole["few_rays"], [False])

    def test_parts_add_up(self):
        whole = self.region("0:60,0:360")["region"]["layers"][1]["energy"][0]
        parts = [self.region(angles)["region"]["layers"][1]["energy"][0]
                 for angles in ("0:60,-90:90", "0:60,90:270")]
        self.assertAlmostEqual(sum(parts) / whole, 1, 9)

    def test_is_told_in_words(self):
        text = self.passes("info", "r.asperity", "--region", "20:60,135:225")
        self.assertRegex(text, r"region 20:60,135:225: 56 cells")
        self.assertRegex(text, r"layer  1, theta 40, phi 0: all 0\.\d+\(\d\d\)")

    def test_silly_ones(self):
        for angles in ("0:90", "90:0,0:360", "0:95,0:360", "0:90,0:400", "a:b,c:d", "0:90,0:nan",
                       "0-90,0-360", "", "0:90,0:360,0:1"):
            with self.subTest(angles=angles):
                self.fails(2, "info", "r.asperity", "--region", angles, saying="region")
        self.fails(2, "info", "r.asperity", "--region", "0:1,0:1", saying="no cell")
        self.fails(2, "info", "r.asperity", "--region", "0:90,0:360", "--config")


if __name__ == "__main__":
    sys.exit(main())
