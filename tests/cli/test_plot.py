# SPDX-License-Identifier: Apache-2.0
"""asperity plot: numbers known by hand, files of every kind, and what is refused."""
import csv
import math
import os
import resource
import shutil
import subprocess
import unittest
import xml.etree.ElementTree

from program import SMALL, ProgramTest, main, run

RESULTS = ("lobe", "lobe3d", "hemisphere", "albedo")
SURFACES = ("normals", "profile", "psd")


def rows(path):
    """The columns of a CSV file by their headers."""
    with open(path, newline="") as file:
        lines = list(csv.reader(file))
    return {name: [float(line[k]) if line[k] else None for line in lines[1:]]
            for k, name in enumerate(lines[0])}


def content(path):
    with open(path, "rb") as file:
        return file.read()


class Plot(ProgramTest):
    def result(self):
        self.passes("simulate", "--surface", "gaussian", *SMALL, "--theta", "0,45", "-o",
                    "r.asperity", "--quiet")

    def test_lambert_is_one_over_pi(self):
        self.passes("plot", "lambert", "-o", "l.csv")
        table = rows("l.csv")
        self.assertEqual(list(table), ["theta_o [deg]", "lambert: f [1/sr]"])
        self.assertEqual(table["theta_o [deg]"][0], -89.75)
        for f in table["lambert: f [1/sr]"]:
            self.assertAlmostEqual(f, 1 / math.pi, 15)

    def test_csv_of_a_result_has_its_errors_and_is_its_layer(self):
        self.result()
        self.passes("plot", "r.asperity", "--kind", "albedo", "-o", "a.csv")
        table, info = rows("a.csv"), self.json_of("info", "r.asperity")
        self.assertEqual(table["theta_i [deg]"], [0, 45])
        layers = sorted(info["layers"], key=lambda layer: layer["theta_deg"])
        for got, layer in zip(table["albedo [1]"], layers):
            self.assertAlmostEqual(got, layer["albedo"][0], 6)
        self.assertIn("standard error of albedo [1]", table)
        self.passes("plot", "r.asperity", "ggx:alpha=0.3", "--labels", "mine,theirs", "-o", "l.csv")
        self.assertEqual(list(rows("l.csv"))[:4],
                         ["theta_o [deg]", "mine: f [1/sr]", "standard error of mine: f [1/sr]",
                          "theirs: f [1/sr]"])

    def test_every_kind_in_every_format(self):
        self.result()
        for kind in RESULTS + SURFACES:
            subjects = (["r.asperity", "cook-torrance:roughness=0.5"] if kind in RESULTS else
                        ["gaussian:alpha=0.3,size=64", "ggx:alpha=0.3,size=64"])
            for ending in ("svg", "pdf", "png", "csv"):
                with self.subTest(kind=kind, ending=ending):
                    name = f"p.{ending}"
                    self.assertEqual(self.passes("plot", *subjects, "--kind", kind, "-o", name),
                                     f"wrote {name}\n")
                    data = content(name)
                    self.assertGreater(len(data), 1000)
                    if ending == "svg":
                        root = xml.etree.ElementTree.fromstring(data)
                        self.assertTrue(root.tag.endswith("svg"))
                        self.assertEqual(root.get("width"), "640px")
                    elif ending == "pdf":
                        self.assertEqual(data[:5], b"%PDF-")
                        self.assertIn(b"%%EOF", data[-10:])
                    elif ending == "png":
                        self.assertEqual(data[:8], b"\x89PNG\r\n\x1a\n")
                        self.assertEqual(int.from_bytes(data[16:20], "big"), 1280)

    @unittest.skipUnless(shutil.which("pdftotext"), "needs pdftotext")
    def test_a_pdf_says_what_it_shows(self):
        self.result()
        self.passes("plot", "r.asperity", "cook-torrance:roughness=0.5", "--theta", 45, "-o",
                    "p.pdf")
        text = subprocess.run(["pdftotext", "p.pdf", "-"], capture_output=True, text=True,
                              check=True).stdout
        for words in ("BRDF, θᵢ = 45°", "r ± 1 standard error", "cook-torrance:roughness=0.5",
                      "[sr⁻¹]", "Means over ±", "mirror direction", "−60°"):
            self.assertIn(words, text)

    def test_looks_and_sizes(self):
        made = set()
        for options in ([], ["--theme", "dark"], ["--axes", "cartesian"], ["--scale", "log"],
                        ["--plane", 90], ["--font-size", 20], ["--title", "Mine"],
                        ["--theta", "10,20"]):
            self.passes("plot", "ggx:alpha=0.3", "-o", "p.png", "--pixels", 1, *options)
            made.add(content("p.png"))
        self.assertEqual(len(made), 8)
        self.passes("plot", "lambert", "-o", "p.png", "--width", 300, "--height", 200, "--pixels", 1.5)
        self.assertEqual(content("p.png")[16:24], (450).to_bytes(4, "big") + (300).to_bytes(4, "big"))
        self.passes("plot", "ggx:alpha=0.3", "--kind", "lobe3d", "-o", "a.png", "--quiet")
        self.passes("plot", "ggx:alpha=0.3", "--kind", "lobe3d", "--camera-azimuth", 10,
                    "-o", "b.png", "--quiet")
        self.assertNotEqual(content("a.png"), content("b.png"))

    def test_same_numbers_for_any_number_of_threads(self):
        for threads in (1, 3):
            self.passes("plot", "ggx:alpha=0.2", "--kind", "hemisphere", "-o", f"{threads}.csv",
                        "--threads", threads)
        self.assertEqual(content("1.csv"), content("3.csv"))

    def test_refused(self):
        self.result()
        self.passes("surface", "flat", "--size", 16, "-o", "s.gsf")
        for code, arguments, saying in (
                (2, ["-o", "p.svg"], "plot needs results, models or surfaces"),
                (2, ["lambert"], ".svg, .pdf, .png or .csv"),
                (2, ["lambert", "-o", "p.jpg"], ".svg, .pdf, .png or .csv"),
                (2, ["lambert", "-o", "p"], ".svg, .pdf, .png or .csv"),
                (2, ["lambert", "--kind", "pie", "-o", "p.svg"], "lobe, lobe3d, hemisphere"),
                (2, ["", "-o", "p.svg"], "empty"),
                (2, ["lambert", "--kind", "albedo", "--plane", 3, "-o", "p.svg"],
                 "plane: has no effect on --kind albedo"),
                (2, ["lambert", "--decades", 3, "-o", "p.svg"], "log scale"),
                (2, ["lambert", "--theme", "dark", "-o", "p.csv"], "a CSV has no looks"),
                (2, ["lambert", "--pixels", 3, "-o", "p.svg"], "it is for .png"),
                (2, ["lambert", "--theta", 90, "-o", "p.svg"], "theta"),
                (2, ["r.asperity", "--theta", 30, "-o", "p.svg"], "its angles are"),
                (2, ["r.asperity", "--layer", 9, "-o", "p.svg"], "no layer 9"),
                (2, ["lambert", "--layer", 1, "-o", "p.svg"], "models have no layers"),
                (2, ["r.asperity", "--channel", "green", "-o", "p.svg"], "channel"),
                (2, ["lambert", "--labels", "a,b", "-o", "p.svg"], "2 given, there are 1"),
                (2, ["lambert", "--labels", "a,b", "-o", "p.svg"], "labels"),
                (2, ["gaussian:alpha=0.3", "-o", "p.svg"], "is a kind of surface"),
                (3, ["s.gsf", "-o", "p.svg"], "heightfield"),
                (3, ["r.asperity", "--kind", "psd", "-o", "p.svg"], "is a result"),
                (4, ["missing.asperity", "-o", "p.svg"], "missing.asperity"),
                (4, ["lambert", "-o", "nowhere/p.svg"], "nowhere"),
                (3, ["s.gsf", "--kind", "psd", "-o", "p.svg"], "no spectrum")):
            with self.subTest(arguments=arguments):
                self.fails(code, "plot", *arguments, saying=saying)
                self.assertFalse(os.path.exists("p.svg"))

    def test_sheets_and_reliefs_have_looks(self):
        self.result()
        made = {}
        for name, options in (("dark", []), ("light", ["--theme", "light"]),
                              ("own", ["--own-scales"])):
            self.passes("export", "r.asperity", "-o", "s.png", "--projection", "disk", *options)
            made[name] = content("s.png")
        self.assertEqual(len(set(made.values())), 3)
        self.fails(2, "export", "r.asperity", "-o", "x.exr", "--own-scales", saying="own-scales")
        self.fails(2, "export", "r.asperity", "-o", "x.exr", "--theme", "light", saying="theme")
        self.fails(2, "export", "r.asperity", "-o", "s.png", "--theme", "blue", saying="theme")
        sizes = {}
        for look in ("shaded", "bare", "normals"):
            self.passes("surface", "gaussian", "--size", 64, "--png", "s.png", "--look", look)
            sizes[look] = content("s.png")[16:24]
        self.assertEqual(sizes["bare"], sizes["normals"])
        self.assertGreater(sizes["shaded"], sizes["bare"])
        self.fails(2, "surface", "gaussian", "--png", "s.png", "--look", "bare", "--theme", "dark",
                   saying="theme")
        self.fails(2, "surface", "gaussian", "--theme", "dark", saying="theme")

    def test_a_disk_that_takes_no_more_is_told(self):
        for ending in ("svg", "pdf", "png", "csv"):
            with self.subTest(ending):
                done = run("plot", "lambert", "-o", f"p.{ending}", restore_signals=False,
                           preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (64, 64)))
                self.assertEqual(done.returncode, 4, done.stderr)
                self.assertRegex(done.stderr, rf"\Aasperity: error: p.{ending}: [^\n]+\n\Z")
                self.assert_files()


if __name__ == "__main__":
    main()
