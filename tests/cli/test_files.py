# SPDX-License-Identifier: Apache-2.0
"""Every reader with files that are not what they claim to be: exit code 3 or 4, one line that names
the file, and no output file left."""
import os
import sys

from damaged_files import FORMATS, damaged
from program import SMALL, ProgramTest, main


def write(path, data):
    with open(path, "wb") as file:
        file.write(data)


class HeightFiles(ProgramTest):
    def refused(self, name):
        self.fails((3, 4), "surface", name, "-o", "new.gsf", "--png", "new.png", saying=name)
        self.fails((3, 4), "simulate", "--surface", name, *SMALL[2:], "-o", "new.asperity", saying=name)
        self.assertFalse([left for left in os.listdir(".") if left != name])

    def test_good_files_are_read(self):
        """So that the damaged ones are refused for their damage."""
        heights = [(7 * k % 16) / 16 for k in range(64)]
        for ending, make in FORMATS.items():
            with self.subTest(ending):
                write(f"a.{ending}", make(8, 8, heights))
                read = self.json_of("surface", f"a.{ending}", "--tiling", "periodic")
                self.assertEqual((read["nx"], read["ny"]), (8, 8))
                self.assertAlmostEqual(read["realised"]["max_height"], max(heights), 4)

    def test_nan_is_a_missing_point(self):
        """It is filled, and that is said; four of 64 are more than is filled unasked."""
        heights = [(7 * k % 16) / 16 for k in range(64)]
        for ending in ("gsf", "exr", "txt"):
            with self.subTest(ending):
                name = f"a.{ending}"
                write(name, FORMATS[ending](8, 8, heights[:9] + [float("nan")] + heights[10:]))
                self.assertIn("1 point (1.56 %) filled smoothly",
                              self.json_of("surface", name)["prepared"])
                self.fails(3, "surface", name, "--fill", "none", saying="1 of 64 points are missing")
                write(name, FORMATS[ending](8, 8, heights[:9] + 4 * [float("nan")] + heights[13:]))
                self.fails(3, "surface", name, saying="4 of 64 points are missing (6.25 %)")
                os.remove(name)

    def test_damaged(self):
        for ending, make in FORMATS.items():
            for what, data in damaged(make, ending):
                with self.subTest(ending=ending, what=what):
                    name = f"bad.{ending}"
                    write(name, data)
                    self.refused(name)
                    os.remove(name)

    def test_folder_and_missing(self):
        for ending in FORMATS:
            with self.subTest(ending):
                self.refused(f"missing.{ending}")
                os.mkdir(f"folder.{ending}")
                self.refused(f"folder.{ending}")
                os.rmdir(f"folder.{ending}")

    def test_content_decides_before_the_ending(self):
        write("heights.xyz", b"1 2\n3 4\n")
        self.assertEqual(self.json_of("surface", "heights.xyz")["ny"], 2)

    def test_unknown_content(self):
        write("heights.abc", b"\1\2\3\0 what is this?")
        self.fails(3, "surface", "heights.abc", saying="heights.abc")


class ResultFiles(ProgramTest):
    def setUp(self):
        super().setUp()
        self.passes("simulate", "--surface", "thesis", *SMALL, "--layers", 2, "-o", "good.asperity")
        with open("good.asperity", "rb") as file:
            self.good = file.read()
        os.remove("good.asperity")

    def refused(self, name):
        for arguments in (["info", name], ["info", name, "--json"], ["export", name, "-o", "x.exr"],
                          ["compare", name, "ggx:alpha=0.3"]):
            self.fails((3, 4), *arguments, saying=name)
        self.assertFalse([left for left in os.listdir(".") if left != name])

    def test_cut(self):
        size = len(self.good)
        for length in [0, 1, 11, 12, 16, 20, 64, *range(size // 8, size, size // 8), size - 1]:
            with self.subTest(length=length):
                write("bad.asperity", self.good[:length])
                self.refused("bad.asperity")

    def test_longer(self):
        write("bad.asperity", self.good + b"\0")
        self.refused("bad.asperity")

    def test_any_damaged_byte(self):
        size = len(self.good)
        for place in [0, 5, 12, 14, 20, 40, *range(100, size, size // 24), size - 1]:
            with self.subTest(place=place):
                data = bytearray(self.good)
                data[place] ^= 0x55
                write("bad.asperity", data)
                self.fails((3, 4), "info", "bad.asperity", saying="bad.asperity")

    def test_foreign_missing_folder(self):
        write("foreign.asperity", b"These are not the bytes of a result.\n" * 100)
        self.refused("foreign.asperity")
        os.remove("foreign.asperity")
        self.refused("missing.asperity")
        os.mkdir("folder.asperity")
        self.refused("folder.asperity")


class ConfigFiles(ProgramTest):
    def test_damaged(self):
        for what, data in (("no value", b"rays\n"), ("unknown", b"colour = red\n"),
                           ("bad value", b"rays = -3\n"), ("binary", bytes(range(256)) * 4),
                           ("open quotes", b'surface = "flat\n'), ("nan", b"alpha = nan\n"),
                           ("too long", b"# comment\n" * 200000)):
            with self.subTest(what):
                write("run.txt", data)
                self.fails(3, "simulate", "--config", "run.txt", "-o", "r.asperity",
                           saying="run.txt")
                self.assert_files("run.txt")

    def test_empty_is_the_default_experiment(self):
        write("run.txt", b"")
        with_file = self.json_of("simulate", "--config", "run.txt", *SMALL)
        self.assertEqual(with_file["checksum"], self.json_of("simulate", *SMALL)["checksum"])

    def test_missing_and_folder(self):
        for path in ("missing.txt", "."):
            self.fails(4, "simulate", "--config", path, *SMALL)


if __name__ == "__main__":
    sys.exit(main())
