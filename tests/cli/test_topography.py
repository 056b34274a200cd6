# SPDX-License-Identifier: Apache-2.0
"""A measured topography from its file to figures, result and gloss."""
import math
import os

from program import ProgramTest, main


def write_tilted(path, tilt=0.02, holes=()):
    """64 x 48 samples of 0.5 um: waves that are even about the middle, on a tilt."""
    with open(path, "w", encoding="utf-8") as file:
        file.write("# Width: 32 um\n# Height: 24 um\n# Value units: nm\n")
        for j in range(48):
            row = [100 * (math.cos(2 * math.pi * 4 * (i - 31.5) / 64) + math.cos(2 * math.pi * 3 * (j - 23.5) / 48))
                   + 500 * tilt * i for i in range(64)]
            file.write(" ".join("nan" if (i, j) in holes else f"{h:.9g}" for i, h in enumerate(row)) + "\n")


class Topography(ProgramTest):
    def test_a_tilt_and_a_hole_are_taken_off_and_told(self):
        write_tilted("a.txt", holes=[(20, 20), (21, 20)])
        told = self.json_of("surface", "a.txt", "--tiling", "finite")
        self.assertIn("2 points (0.0651 %) filled smoothly; the mean plane taken off, a tilt of 2", told["prepared"])
        self.assertIn("heights in nm from the header", told["source"])
        self.assertAlmostEqual(told["texture"]["Sq"], 1e-7, delta=1e-10)
        self.assertTrue(told["texture"]["geometric_optics"]["holds"])
        self.assertEqual(len(told["texture"]["autocorrelation"]["along_x"]), 33)
        text = self.passes("surface", "a.txt")
        for figure in ("Sa, Sq", "Sal", "Sk, Spk, Svk", "Beckmann alpha", "made ready: ", "geometric optics holds at 0.55 um"):
            self.assertIn(figure, text)
        # Heights of 0.1 um are none to light of 10 um
        self.assertIn("geometric optics does not hold at 10 um: the heights are small",
                      self.passes("surface", "a.txt", "--wavelength", "10um"))

    def test_what_was_done_goes_along(self):
        write_tilted("a.txt")
        self.passes("surface", "a.txt", "--level", "order2", "--tiling", "finite", "-o", "b.gsf")
        with open("b.gsf", "rb") as file:
            self.assertIn(b"AsperityPrepared = a form of order 2 taken off", file.read())
        first = self.json_of("surface", "b.gsf", "--tiling", "finite")
        self.assertIn("a form of order 2 taken off", first["prepared"])
        # Nothing more is done to it
        self.passes("surface", "b.gsf", "--tiling", "finite", "-o", "c.gsf")
        again = self.json_of("surface", "c.gsf", "--tiling", "finite")
        self.assertEqual(again["realised"], first["realised"])
        self.passes("simulate", "--surface", "a.txt", "--theta", "30", "--rays", "2000", "--resolution", "16",
                    "-o", "r.asperity")
        notes = self.json_of("info", "r.asperity")["notes"]
        self.assertTrue(any("the mean plane taken off, a tilt of 20 mrad" in note for note in notes), notes)
        self.assertEqual(self.json_of("info", "r.asperity")["experiment"]["level"], "auto")

    def test_a_tilted_mirror_is_the_level_one(self):
        write_tilted("level.txt", tilt=0)
        write_tilted("tilted.txt", tilt=0.02)
        albedos = []
        for name in ("level", "tilted"):
            self.passes("simulate", "--surface", f"{name}.txt", "--theta", "50", "--rays", "20000", "--resolution", "16",
                        "-o", f"{name}.asperity", "--quiet")
            albedos.append(self.json_of("info", f"{name}.asperity")["surface"]["rms_height"])
        self.assertAlmostEqual(albedos[0], albedos[1], delta=1e-6 * albedos[0])
        compared = self.json_of("compare", "level.asperity", "tilted.asperity")
        self.assertLess(compared["mean_l1"], 1e-3)

    def test_before_and_after(self):
        write_tilted("a.txt")
        self.passes("surface", "a.txt", "--png", "a.png", "--before")
        self.assertGreater(os.path.getsize("a.png"), 1000)
        self.fails(2, "surface", "a.txt", "--before", saying="before")
        self.fails(2, "surface", "flat", "--png", "b.png", "--before", saying="before")

    def test_settings_of_files_are_refused_elsewhere(self):
        self.fails(2, "surface", "gaussian", "--level", "plane", saying="it is for files")
        write_tilted("a.txt")
        self.fails(2, "surface", "a.txt", "--crop", "0,0,90,90um", saying="crop")
        self.fails(2, "surface", "a.txt", "--filter-s", "40um", saying="filter-s")
        self.fails(2, "surface", "a.txt", "--fill", "mean", saying="fill")


class Gloss(ProgramTest):
    def test_exact_cases(self):
        mirror = self.json_of("gloss", "--surface", "flat", "--size", "4", "--rays", "2000")
        for reading, expected in zip(mirror["readings"], (2037.6, 999.4, 161.5)):
            self.assertAlmostEqual(reading["gloss"]["value"][0], expected, delta=2.5e-3 * expected)
        glass = self.json_of("gloss", "--surface", "flat", "--size", "4", "--rays", "2000", "--ior", "1.5")
        for reading, expected in zip(glass["readings"], (82.05, 89.14, 98.97)):
            self.assertAlmostEqual(reading["gloss"]["value"][0], expected, delta=0.3)
        self.assertEqual(glass["readings"][0]["haze"]["value"], [0])
        self.assertIsNone(glass["readings"][1]["haze"])
        self.assertAlmostEqual(glass["haze_index"]["value"][0], 89.14 - 82.05, delta=0.5)
        self.assertIsNone(mirror["haze_index"])
        self.assertIn("taken to be as large", glass["notes"][-1])

    def test_measured_surface(self):
        write_tilted("a.txt")
        told = self.json_of("gloss", "--surface", "a.txt", "--geometry", "60", "--material", "Al", "--rays", "4000")
        self.assertEqual(told["channels"], ["R", "G", "B"])
        self.assertIn("a tilt of 20 mrad", told["prepared"])
        self.assertGreater(told["readings"][0]["tis"], 0.5)
        self.assertIn("RMS", self.passes("surface", "a.txt"))
        text = self.passes("gloss", "--surface", "a.txt", "--geometry", "60", "--rays", "4000")
        self.assertIn("gloss [GU]", text)

    def test_refused(self):
        doi = self.json_of("gloss", "--surface", "flat", "--size", "4", "--rays", "2000", "--doi", "0.1,0.2")["doi"]
        self.assertEqual((doi["value"], doi["angle_deg"], doi["source_deg"], doi["receptor_deg"]),
                         ([100], 30, 0.1, 0.2))
        self.assertIn("DOI at 30° (all), source 0.14° and receptors 0.14° wide: 100.00000 exact",
                      self.passes("gloss", "--surface", "flat", "--size", "4", "--rays", "2000", "--doi", "0.14"))
        self.fails(2, "gloss", "--surface", "flat", "--doi", "0.4", saying="0.6 degrees")
        self.fails(2, "gloss", "--surface", "flat", "--doi-angle", "20", saying="no effect without --doi")
        self.fails(2, "gloss", "--surface", "flat", "--geometry", "45", saying="geometry")
        self.fails(2, "gloss", "--surface", "flat", "--azimuth", "30", "--all-azimuths", saying="azimuth")
        self.fails(2, "gloss", "--surface", "flat", "--until", "1%,2%", saying="until")


class Channels(ProgramTest):
    def test_two_channels_have_no_reference_of_three(self):
        small = ["--size", "32", "--theta", "30", "--rays", "2000", "--resolution", "16", "--fresnel", "schlick",
                 "--f0", "0.04,0.5"]
        text = self.passes("simulate", *small)
        self.assertNotIn("L1", text)
        self.fails(2, "simulate", *small, "--reference", "cook-torrance:roughness=0.5", saying="reference")


if __name__ == "__main__":
    main()
