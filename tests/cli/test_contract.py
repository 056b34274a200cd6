# SPDX-License-Identifier: Apache-2.0
"""The spellings other tools call, end to end on tiny settings."""
import json
import math
import os
import re
import struct
import subprocess
import sys
import zlib

from program import PROGRAM, SMALL, ProgramTest, main, run

LAYER_KEYS = {"theta_deg", "phi_deg", "launched", "albedo", "albedo_stderr", "albedo_by_bounce",
              "absorbed", "truncated", "mean_bounces"}


def content(path):
    with open(path, "rb") as file:
        return file.read()


def png_size(path):
    """Width and height of a PNG whose chunks are whole."""
    data = content(path)
    assert data[:8] == b"\x89PNG\r\n\x1a\n", path
    place, size = 8, None
    while place < len(data):
        length, kind = struct.unpack(">I4s", data[place:place + 8])
        body = data[place + 4:place + 8 + length]
        assert zlib.crc32(body) == struct.unpack(">I", data[place + 8 + length:][:4])[0], path
        if kind == b"IHDR":
            size = struct.unpack(">II", body[4:12])
        place += 12 + length
    return size


class Surface(ProgramTest):
    def test_made_saved_drawn_read(self):
        self.passes("surface", "thesis", "--size", 32, "-o", "s.gsf", "--png", "s.png")
        self.assert_files("s.gsf", "s.png")
        self.assertTrue(all(side > 0 for side in png_size("s.png")))
        made = self.json_of("surface", "thesis", "--size", 32, "--stats")
        read = self.json_of("surface", "s.gsf", "--tiling", "periodic", "--stats")
        self.assertEqual(read["realised"], made["realised"])
        self.assertEqual((read["nx"], read["ny"]), (32, 32))
        self.assertEqual(made["asked"], {"roughness": 0.2})

    def test_every_kind(self):
        for kind in ("thesis", "gaussian", "ggx", "flat", "tilted", "vgroove", "sawtooth",
                     "pyramids", "sinusoid", "eggcrate"):
            with self.subTest(kind):
                self.assertEqual(self.json_of("surface", kind, "--size", 64)["kind"], kind)

    def test_known_figures(self):
        groove = self.json_of("surface", "vgroove:tilt=45,size=32")["realised"]
        self.assertAlmostEqual(groove["rms_slope_x"], 1, 6)
        self.assertAlmostEqual(groove["area_ratio"], 2 ** 0.5, 6)
        rough = self.json_of("surface", "gaussian", "--alpha", 0.25, "--size", 128)
        self.assertAlmostEqual(rough["realised"]["rms_gradient"], 0.25, 4)
        self.assertEqual(rough["asked"], {"alpha_x": 0.25, "alpha_y": 0.25})
        self.assertLess(rough["slope_distance"]["beckmann"], 0.05)
        self.assertGreater(rough["slope_distance"]["ggx"], 0.1)

    def test_formats_keep_the_heights(self):
        self.passes("surface", "gaussian", "--size", 32, "-o", "a.gsf")
        wanted = self.json_of("surface", "a.gsf", "--tiling", "periodic")["realised"]
        for name in ("a.exr", "a.txt"):
            with self.subTest(name):
                self.passes("surface", "a.gsf", "--tiling", "periodic", "-o", name)
                got = self.json_of("surface", name, "--tiling", "periodic")["realised"]
                self.assertAlmostEqual(got["rms_height"], wanted["rms_height"], 6)
                self.assertAlmostEqual(got["skewness"], wanted["skewness"], 6)

    def test_default_tiling_is_told(self):
        self.passes("surface", "thesis", "--size", 16, "-o", "a.gsf")
        self.assertIn("periodic as the file says (the default of --tiling)",
                      self.passes("surface", "a.gsf"))
        with open("slant.txt", "w") as file:
            file.write("0 1 2\n0 1 2\n")
        self.assertIn("mirrored", self.passes("surface", "slant.txt"))
        self.assertIn("a finite patch", self.passes("surface", "slant.txt", "--tiling", "finite"))

    def test_looks(self):
        for look in ("shaded", "normals"):
            self.passes("surface", "eggcrate", "--size", 32, "--png", f"{look}.png", "--look", look)
        self.assertNotEqual(content("shaded.png"), content("normals.png"))


class Simulate(ProgramTest):
    def test_table_and_file(self):
        text = self.passes("simulate", "--surface", "gaussian", *SMALL, "-o", "r.asperity")
        self.assert_files("r.asperity")
        for words in ("alpha 0.3 asked", "albedo", "1 bounce", "2 bounces", "3+", "absorbed",
                      "truncated", "L1", "cook-torrance:roughness=0.54", "rays/s",
                      "wrote r.asperity", "checksum"):
            self.assertIn(words, text)
        self.assertEqual(sum("°" in line for line in text.splitlines()), 15)
        self.assertNotIn("edge loss", text)

    def test_errors_have_digits(self):
        self.assertIn("1.00000 exact", self.passes("simulate", "--surface", "flat", *SMALL,
                                                   "--theta", 0, "-o", "r.asperity"))
        # Gold in grazing light: errors of some 1e-6
        text = self.passes("simulate", "--surface", "vgroove:tilt=1", "--size", 64, "--rays",
                           100000, "--resolution", 16, "--theta", "10", "--launch", "random",
                           "--fresnel", "conductor", "--material", "Ag", "--wavelengths", 550,
                           "-o", "r.asperity")
        value, error = re.search(r"(\d\.\d+)\((\d+)\)", text).groups()
        layer, = self.json_of("info", "r.asperity")["layers"]
        unit = 10.0 ** -len(value.split(".")[1])
        self.assertEqual(len(error), 2)
        self.assertAlmostEqual(float(value), layer["albedo"][0], delta=0.5001 * unit)
        self.assertAlmostEqual(int(error) * unit, layer["albedo_stderr"][0], delta=0.5001 * unit)

    def test_json_keys(self):
        self.passes("simulate", "--surface", "thesis", *SMALL, "--bounces", 3, "--fresnel",
                    "schlick", "--f0", "0.9,0.5,0.1", "-o", "r.asperity")
        info = self.json_of("info", "r.asperity")
        self.assertLessEqual({"launched_total", "rays_per_second", "threads", "surface", "layers"},
                             set(info))
        self.assertEqual(info["launched_total"], 15 * 2000)
        self.assertGreater(info["rays_per_second"], 0)
        self.assertGreater(info["surface"]["rms_height"], 0)
        self.assertEqual([round(layer["theta_deg"]) for layer in info["layers"]],
                         list(range(0, 90, 6)))
        for layer in info["layers"]:
            self.assertLessEqual(LAYER_KEYS, set(layer))
            self.assertEqual(layer["phi_deg"], 0)
            self.assertEqual(len(layer["albedo"]), 3)
            self.assertEqual([len(row) for row in layer["albedo_by_bounce"]], [3, 3, 3])
            exact = layer["exact"]
            for c in range(3):
                self.assertAlmostEqual(sum(layer["albedo_by_bounce"][c]), layer["albedo"][c], 12)
                self.assertAlmostEqual(
                    layer["albedo"][c] + layer["absorbed"][c] + layer["truncated"][c], 1, 12)
                self.assertEqual(sum(int(exact[part][c]) for part in
                                     ("escaped", "absorbed", "truncated", "edge")),
                                 int(exact["launched"]))
            self.assertGreaterEqual(layer["mean_bounces"], 1)
            self.assertLessEqual(layer["mean_bounces"], 3)

    def test_json_alone_on_stdout(self):
        done = run("simulate", "--surface", "flat", *SMALL, "--json")
        self.assertEqual(json.loads(done.stdout)["file"], None)
        self.assertIn("surface: flat", done.stderr)
        done = run("simulate", "--surface", "flat", *SMALL, "--json", "--quiet", "-o", "r.asperity")
        self.assertEqual(json.loads(done.stdout)["file"], "r.asperity")
        self.assertEqual(done.stderr, "")

    def test_quiet(self):
        done = run("simulate", "--surface", "flat", *SMALL, "--quiet", "-o", "r.asperity")
        self.assertEqual((done.returncode, done.stdout, done.stderr), (0, "", ""))
        self.assert_files("r.asperity")

    def test_few_lines_on_a_stderr_that_is_no_terminal(self):
        done = run("simulate", "--surface", "gaussian", *SMALL)
        self.assertLessEqual(len(done.stderr.splitlines()), 4)
        self.assertNotIn("\r", done.stderr)

    def test_isotropic_has_no_azimuth(self):
        info = self.json_of("simulate", "--surface", "gaussian", *SMALL, "--isotropic",
                            "--theta", "30,60")
        self.assertEqual([layer["phi_deg"] for layer in info["layers"]], [None, None])

    def test_fixed_angles(self):
        info = self.json_of("simulate", "--surface", "flat", *SMALL, "--theta", "0,45",
                            "--phi", "10,20")
        angles = [(round(layer["theta_deg"], 9), round(layer["phi_deg"], 9))
                  for layer in info["layers"]]
        self.assertEqual(sorted(angles), [(0, 10), (0, 20), (45, 10), (45, 20)])

    def test_number_of_rays(self):
        few = ("simulate", "--surface", "flat", "--size", 16, "--theta", 0, "--resolution", 8)
        with open("run.txt", "w", encoding="utf-8") as file:
            file.write("jitter = 2\n")
        for options, jitter in ((), 16), (("--jitter", 3), 3), (("--config", "run.txt"), 2):
            layer, = self.json_of(*few, *options)["layers"]
            self.assertEqual(layer["launched"], jitter * 16 * 16)

    def test_finite_patch_shows_edge_loss(self):
        text = self.passes("simulate", "--surface", "thesis", *SMALL, "--boundary", "finite")
        self.assertIn("edge loss", text)

    def test_until(self):
        # The same limit in both spellings, and it is kept.
        options = ("simulate", "--surface", "gaussian", "--size", 64, "--theta", 30,
                   "--resolution", 4, "--fresnel", "schlick", "--f0", 0.5, "--rays", 256)
        percent = self.json_of(*options, "--until", "5%")
        share = self.json_of(*options, "--until", "0.05")
        self.assertEqual(percent["checksum"], share["checksum"])
        layer = percent["layers"][0]
        self.assertGreater(layer["launched"], 256)
        self.assertLess(layer["albedo_stderr"][0] / layer["albedo"][0], 0.05)

    def test_tables_fit_a_terminal_and_shares_add_up(self):
        """The widest there is: two azimuths, three bands, light lost at the edge, a reference."""
        text = self.passes("simulate", "--surface", "gaussian", *SMALL, "--theta", "10,40", "--phi",
                           "0,30", "--material", "Au", "--boundary", "finite", "-o", "r.asperity")
        tables = [line for line in text.splitlines() if "°" in line or "layer" in line]
        self.assertGreaterEqual(len(tables), 2 * 12)
        self.assertLessEqual(max(map(len, tables)), 80)
        rows = [line.split() for line in tables if "°" in line]
        shares, edges = rows[:12], rows[12:]
        for share, edge in zip(shares, edges):
            self.assertEqual(share[:4], edge[:4])  # layer, theta, phi, band
            after, lost = sum(map(float, share[5:8])), float(edge[4])
            self.assertAlmostEqual(after, 100 * float(share[4].split("(")[0]), delta=0.06)
            self.assertAlmostEqual(after + sum(map(float, share[8:10])) + lost, 100, delta=0.04)
        for arguments in (("gloss", "--surface", "gaussian", *SMALL[:4], "--material", "Au"),
                          ("compare", "r.asperity", "ggx:alpha=0.3"),
                          ("info", "r.asperity")):
            lines = self.passes(*arguments).splitlines()
            self.assertLessEqual(max(len(line) for line in lines if "°" in line), 80, arguments)

    def test_reference(self):
        text = self.passes("simulate", "--surface", "flat", *SMALL, "--theta", 0)
        self.assertNotIn("L1", text)
        text = self.passes("simulate", "--surface", "flat", *SMALL, "--theta", 0, "--reference",
                           "lambert:albedo=1")
        self.assertIn("lambert", text)
        text = self.passes("simulate", "--surface", "ggx", *SMALL, "--theta", 0, "--reference",
                           "none")
        self.assertNotIn("L1", text)

    def test_reference_has_the_material_of_the_run(self):
        rough = ["simulate", "--surface", "gaussian", *SMALL, "--theta", 30]
        self.assertIn("metallic=1,albedo=0.04/0.5/0.9",
                      self.passes(*rough, "--f0", "0.04,0.5,0.9"))
        # Air to glass of index 1.5: ((1.5 - 1) / (1.5 + 1))^2
        self.assertIn("albedo=0.04\n", self.passes(*rough, "--ior", 1.5).replace(";", ""))

    def test_a_decimal_comma_is_told(self):
        few = ["simulate", "--surface", "flat", *SMALL, "--theta", 30, "--quiet", "--ior"]
        self.assertIn("two bands, 1 and 5; one number of that kind is written 1.5",
                      run(*few, "1,5").stderr)
        for value in ("1.5", "1.5,1.6", "1,2,5"):
            self.assertEqual(run(*few, value).stderr, "")

    def test_reference_of_other_channels(self):
        rough = ["simulate", "--surface", "gaussian", *SMALL, "--theta", 30, "--f0", "0.04,0.5"]
        self.assertNotIn("L1", self.passes(*rough))
        self.fails(2, *rough, "--reference", "ggx:alpha=0.3,material=Au",
                   saying="reference: has 3 channels, the facets have 2")

    def test_one_checksum_for_any_number_of_threads(self):
        sums = {self.json_of("simulate", "--surface", "gaussian", *SMALL, "--threads", threads)
                ["checksum"] for threads in (1, 2, 3, 7)}
        self.assertEqual(len(sums), 1)

    def test_seeds_matter(self):
        sums = {self.json_of("simulate", *SMALL, option, 2)["checksum"]
                for option in ("--seed", "--surface-seed")}
        sums.add(self.json_of("simulate", *SMALL)["checksum"])
        self.assertEqual(len(sums), 3)

    def test_surface_from_a_file(self):
        self.passes("surface", "thesis", "--size", 64, "-o", "s.gsf")
        made = self.json_of("simulate", "--surface", "thesis", *SMALL)
        text = self.passes("simulate", "--surface", "s.gsf", *SMALL[2:], "--tiling", "periodic",
                           "-o", "r.asperity")
        self.assertIn("s.gsf", text)
        read = self.json_of("info", "r.asperity")
        self.assertEqual([layer["exact"] for layer in read["layers"]],
                         [layer["exact"] for layer in made["layers"]])


class StandardOutput(ProgramTest):
    def test_takes_the_file_and_nothing_else(self):
        few = ["simulate", "--surface", "gaussian", *SMALL, "--theta", "0:80:40"]
        self.passes(*few, "-o", "r.asperity")
        sides = (((*few,), "r.asperity", "asperity"),
                 (("surface", "gaussian", "--size", 32), None, "gsf"),
                 (("export", "r.asperity", "--format", "layers-csv"), None, "csv"),
                 (("export", "r.asperity"), None, "png"),
                 (("plot", "r.asperity"), None, "svg"),
                 (("render", "--model", "sphere", "--width", 16, "--height", 16, "--spp", 1), None,
                  "png"))
        for arguments, _, ending in sides:
            with self.subTest(arguments):
                piped = subprocess.run([PROGRAM, *map(str, arguments), "-o", "-"], check=True,
                                       stdout=subprocess.PIPE, stderr=subprocess.PIPE).stdout
                self.passes(*arguments, "-o", f"there.{ending}")
                if ending == "asperity":  # files hold the time it took
                    with open("piped.asperity", "wb") as file:
                        file.write(piped)
                    self.assertEqual(self.json_of("info", "piped.asperity")["checksum"],
                                     self.json_of("info", "r.asperity")["checksum"])
                else:
                    self.assertEqual(piped, content(f"there.{ending}"))
        self.fails(2, *few, "--json", "-o", "-", saying="standard output")
        self.fails(2, *few, "--resume", "-o", "-", saying="-o FILE")
        self.fails(2, "export", "r.asperity", "-o", "-", "--format", "table", saying="layers-csv")
        self.fails(2, "export", "r.asperity", "-o", "-", "--format", "rgl", "--snippet",
                   saying="snippet")

    def test_other_kinds_of_file_are_refused_with_the_way_there(self):
        for ending in ("exr", "csv", "png", "bsdf"):
            self.fails(2, "simulate", *SMALL, "-o", f"r.{ending}",
                       saying=f"asperity export r.asperity -o X.{ending}")
        self.fails(2, "simulate", *SMALL, "-o", "r.gsf", saying="asperity surface")
        self.assert_files()


class Config(ProgramTest):
    def test_round_trip_gives_the_same_checksum(self):
        self.passes("simulate", "--surface", "ggx", *SMALL, "--alpha", "0.3,0.2", "--theta",
                    "10,50", "--phi", 33, "--fresnel", "conductor", "--material", "Au",
                    "--detector", "equal-area", "--seed", 9, "-o", "a.asperity")
        with open("run.txt", "w", encoding="utf-8") as file:
            file.write(self.passes("info", "a.asperity", "--config"))
        self.passes("simulate", "--config", "run.txt", "-o", "b.asperity")
        self.assertEqual(self.json_of("info", "a.asperity")["checksum"],
                         self.json_of("info", "b.asperity")["checksum"])

    def test_sections_belong_to_other_programs(self):
        self.passes("simulate", "--surface", "ggx", *SMALL, "--seed", 9, "-o", "a.asperity")
        with open("session.txt", "w", encoding="utf-8") as file:
            file.write(self.passes("info", "a.asperity", "--config"))
            file.write("\n[studio]\nraiz = 3\nseed = 10\nquiet = true\n\n[ other ]  # one more\n")
        text = self.passes("simulate", "--config", "session.txt", "-o", "b.asperity")
        self.assertNotEqual(text, "")  # that `quiet` was none of ours
        self.assertEqual(self.json_of("info", "a.asperity")["checksum"],
                         self.json_of("info", "b.asperity")["checksum"])
        # Of every verb that reads a config file
        with open("part.txt", "w", encoding="utf-8") as file:
            file.write("[studio]\nraiz = 3\n")
        self.passes("surface", "flat", "--size", 64, "--config", "part.txt")
        self.passes("compare", "lambert", "lambert", "--layers", 2, "--config", "part.txt")
        for line in ("[studio", "[]", "[Studio]", "[studio] x = 1", "[two words]", "raiz = 3"):
            with self.subTest(line), open("session.txt", "w", encoding="utf-8") as file:
                file.write(f"size = 64\n{line}\n[studio]\n")
                file.flush()
                self.fails(3, "simulate", "--config", "session.txt", saying="session.txt:2")

    def test_command_line_wins(self):
        with open("run.txt", "w", encoding="utf-8") as file:
            file.write("# a run\nrays = 3000\nsurface = flat\nsize = 64\ntheta = 10,20,30\n"
                       "quiet = true\nresolution = 16\n")
        info = self.json_of("simulate", "--config", "run.txt", "--rays", 4000)
        self.assertEqual(info["launched_total"], 3 * 4000)
        self.assertEqual(info["experiment"]["surface"], "flat")
        info = self.json_of("simulate", "--config", "run.txt", "--layers", 2)
        self.assertEqual(len(info["layers"]), 2)
        self.assertEqual(run("simulate", "--config", "run.txt").stdout, "")

    def test_ranges_of_angles(self):
        """The same in a file as on the command line, and kept as the angles they stand for."""
        with open("run.txt", "w", encoding="utf-8") as file:
            file.write("surface = flat\nsize = 64\nresolution = 16\nrays = 2000\n"
                       "theta = 0:0.3:0.1, 10:80:35\n")
        told = self.json_of("simulate", "--config", "run.txt", "-o", "r.asperity")
        self.assertIn("theta = 0,0.1,0.2,0.3,10,45,80\n",
                      self.passes("info", "r.asperity", "--config"))
        typed = self.json_of("simulate", "--config", "run.txt", "--theta",
                             "0,0.1,0.2,0.3,10,45,80")
        self.assertEqual(told["checksum"], typed["checksum"])

    def test_lines_without_effect_are_noted(self):
        """Not the defaults, which every file that asperity writes holds."""
        with open("run.txt", "w", encoding="utf-8") as file:
            file.write("surface = thesis\nalpha = 0.3\nhurst = 0.5\nmax-rays = 5000\n"
                       "size = 64\nresolution = 16\nrays = 2000\nlayers = 1\n")
        told = run("simulate", "--config", "run.txt").stderr
        self.assertIn("note: run.txt:3: hurst has no effect: thesis does not use it", told)
        self.assertIn("note: run.txt:4: max-rays has no effect: limits a run with --until", told)
        self.assertEqual(told.count("note:"), 2)
        told = run("simulate", "--config", "run.txt", "--until", "50%").stderr
        self.assertNotIn("max-rays has", told)

    def test_errors_name_file_and_line(self):
        for line, words in (("raiz = 3", "did you mean rays?"), ("rays = many", "rays"),
                            ("rays", "key = value"), ("quiet = perhaps", "quiet"),
                            ("config = run.txt", "config"),
                            ("output = mine.asperity", "output")):
            with self.subTest(line), open("run.txt", "w", encoding="utf-8") as file:
                file.write(f"# first\nsize = 64\n{line}\n")
                file.flush()
                self.assertIn(words, self.fails(3, "simulate", "--config", "run.txt",
                                                saying="run.txt:3"))


def write_exr_of_one_pixel(path, value):
    """An EXR file of one pixel, uncompressed, with this value in R, G and B."""
    def attribute(name, kind, data):
        return name + b"\0" + kind + b"\0" + struct.pack("<i", len(data)) + data
    box = struct.pack("<4i", 0, 0, 0, 0)
    channels = b"".join(name + b"\0" + struct.pack("<iB3xii", 2, 0, 1, 1) for name in (b"B", b"G", b"R"))
    header = (b"\x76\x2f\x31\x01" + struct.pack("<i", 2) +
              attribute(b"channels", b"chlist", channels + b"\0") +
              attribute(b"compression", b"compression", b"\0") +
              attribute(b"dataWindow", b"box2i", box) + attribute(b"displayWindow", b"box2i", box) +
              attribute(b"lineOrder", b"lineOrder", b"\0") +
              attribute(b"pixelAspectRatio", b"float", struct.pack("<f", 1)) +
              attribute(b"screenWindowCenter", b"v2f", struct.pack("<2f", 0, 0)) +
              attribute(b"screenWindowWidth", b"float", struct.pack("<f", 1)) + b"\0")
    with open(path, "wb") as file:
        file.write(header + struct.pack("<Q", len(header) + 8) + struct.pack("<2i", 0, 12) +
                   struct.pack("<3f", value, value, value))


class ComparePictures(ProgramTest):
    def test_what_is_no_number_is_refused(self):
        write_exr_of_one_pixel("good.exr", 0.5)
        self.assertEqual(self.json_of("compare", "good.exr", "good.exr")["relative_difference"], 0)
        for value in (math.nan, math.inf, -math.inf):
            write_exr_of_one_pixel("bad.exr", value)
            for a, b in (("good.exr", "bad.exr"), ("bad.exr", "good.exr"), ("bad.exr", "bad.exr")):
                self.fails(3, "compare", a, b, "--json", saying="bad.exr")


class Compare(ProgramTest):
    def setUp(self):
        super().setUp()
        self.passes("simulate", "--surface", "gaussian", *SMALL, "-o", "a.asperity")
        self.passes("simulate", "--surface", "gaussian", *SMALL, "--seed", 2, "-o", "b.asperity")

    def test_with_itself(self):
        same = self.json_of("compare", "a.asperity", "a.asperity")
        self.assertEqual((same["mean_l1"], same["max_albedo_difference"]), (0, 0))
        self.assertEqual(len(same["layers"]), 15)

    def test_measurements(self):
        seeds = self.json_of("compare", "a.asperity", "b.asperity")
        self.assertGreater(seeds["mean_l1"], 0)
        self.assertLess(seeds["mean_l1"], 0.5)

    def test_model_on_either_side(self):
        model = "beckmann:alpha=0.3"
        right = self.json_of("compare", "a.asperity", model)
        left = self.json_of("compare", model, "a.asperity")
        self.assertEqual((right["a"], right["b"]), ("a.asperity", model))
        self.assertEqual((left["a"], left["b"]), (model, "a.asperity"))
        for r, l in zip(right["layers"], left["layers"]):
            self.assertEqual(r["l1"], l["l1"])
            self.assertEqual(r["albedo_difference"], -l["albedo_difference"])
            self.assertEqual(r["albedo_a"], l["albedo_b"])
        # It is a Beckmann surface: nearer to it than to a Lambert one.
        lambert = self.json_of("compare", "a.asperity", "lambert:albedo=1")
        self.assertLess(right["mean_l1"], lambert["mean_l1"])

    def test_two_models(self):
        same = self.json_of("compare", "lambert:albedo=0.5", "lambert:albedo=0.5", "--theta",
                            "0,30", "--resolution", 32)
        self.assertEqual(same["mean_l1"], 0)
        self.assertAlmostEqual(same["layers"][0]["albedo_a"], 0.5, 6)
        self.assertEqual([round(layer["theta_deg"]) for layer in same["layers"]], [0, 30])
        # Two Lambert models of albedo 0.5 and 0.3 differ by 0.2 everywhere.
        half = self.json_of("compare", "lambert:albedo=0.5", "lambert:albedo=0.3", "--layers", 3,
                            "--resolution", 32)
        self.assertAlmostEqual(half["mean_l1"], 0.2, 6)

    def test_table(self):
        text = self.passes("compare", "a.asperity", "ggx:alpha=0.3")
        self.assertIn("mean L1", text)
        self.assertIn("RMS [1/sr]", text)

    def test_other_layers_are_interpolated_and_it_is_said(self):
        self.passes("simulate", "--surface", "gaussian", *SMALL, "--theta", "10:70:20", "-o",
                    "c.asperity")
        text = self.passes("compare", "a.asperity", "c.asperity")
        self.assertIn("note: one has 15 layers, the other 4: B is interpolated", text)
        found = self.json_of("compare", "c.asperity", "a.asperity")
        self.assertEqual([round(layer["theta_deg"]) for layer in found["layers"]], [10, 30, 50, 70])
        self.assertIn("interpolated", found["note"])
        self.assertLess(found["mean_l1"], 0.5)
        self.assertNotIn("note", self.json_of("compare", "a.asperity", "b.asperity"))

    def test_refusals(self):
        self.fails(2, "compare", "a.asperity", saying="two")
        self.fails(2, "compare", "a.asperity", "b.asperity", "--layers", 3, saying="two models")
        self.fails(4, "compare", "a.asperity", "nosuch", saying="nosuch")
        self.fails(2, "compare", "a.asperity", "ggx:alpha=often", saying="alpha")


class Export(ProgramTest):
    def setUp(self):
        super().setUp()
        self.passes("simulate", "--surface", "gaussian", *SMALL, "--layers", 3, "--fresnel",
                    "conductor", "--material", "Cu", "-o", "r.asperity")

    def test_exr(self):
        self.passes("export", "r.asperity", "-o", "layers.exr")
        self.assert_files("r.asperity", "layers.exr")
        self.assertEqual(content("layers.exr")[:4], b"\x76\x2f\x31\x01")

    def test_snippets(self):
        self.passes("export", "r.asperity", "-o", "x.bsdf", "--snippet")
        self.assert_files("r.asperity", "x.bsdf", "x_mitsuba.xml", "x_mitsuba.py")
        self.fails(2, "export", "r.asperity", "-o", "y.binary", "--snippet", saying="snippet")
        self.fails(2, "export", "r.asperity", "-o", "y.png", "--snippet", saying="snippet")
        self.fails(2, "export", "r.asperity", "-o", "y.mtlx", saying="fit")
        self.assertFalse(os.path.exists("y.binary") or os.path.exists("y.mtlx"))

    def test_folder(self):
        self.passes("export", "r.asperity", "-o", "layers/")
        names = os.listdir("layers")
        self.assertEqual(len(names), 4)
        self.assertIn("sheet.png", names)
        for name in names:
            self.assertTrue(all(side > 0 for side in png_size(f"layers/{name}")))

    def test_looks(self):
        pictures = set()
        for k, options in enumerate(([], ["--colour-map", "viridis"], ["--color-map", "grey"],
                                     ["--scale", "linear"], ["--projection", "disk"],
                                     ["--decades", 2], ["--channel", "R"], ["--channel", 2])):
            self.passes("export", "r.asperity", "-o", f"{k}.png", *options)
            pictures.add(content(f"{k}.png"))
        self.assertEqual(len(pictures), 8)

    def test_refusals(self):
        self.fails(2, "export", "r.asperity", saying="-o")
        self.fails(2, "export", "-o", "x.exr", saying="result")
        for options in (["-o", "x.jpg"], ["-o", "x.png", "--colour-map", "pink"],
                        ["-o", "x.png", "--channel", "U"], ["-o", "x.png", "--channel", 3],
                        ["-o", "x.png", "--scale", "cubic"], ["-o", "x.png", "--decades", 0]):
            self.fails(2, "export", "r.asperity", *options)
        self.fails(4, "export", "r.asperity", "-o", "no/such/layers/")
        self.fails(4, "export", "r.asperity", "-o", "r.asperity/")
        self.assert_files("r.asperity")


class Fit(ProgramTest):
    def setUp(self):
        super().setUp()
        self.passes("simulate", "--surface", "gaussian", *SMALL, "--layers", 3, "--fresnel",
                    "conductor", "--material", "Cu", "-o", "r.asperity")

    def test_table_and_specs(self):
        text = self.passes("fit", "r.asperity", "--model", "ggx,beckmann,cook-torrance:metallic=1",
                           "--png", "map.png")
        self.assertIn("chi2/dof", text)
        specs = [line.strip() for line in text.splitlines() if line.startswith("  ggx:")
                 or line.startswith("  beckmann:") or line.startswith("  cook-torrance:")]
        self.assertEqual(len(specs), 3)
        for spec in specs:  # every verb takes them
            self.passes("compare", "r.asperity", spec)
        self.assertTrue(any("material=Cu" in spec for spec in specs))
        self.assertTrue(all(side > 0 for side in png_size("map.png")))

    def test_json_of_a_file(self):
        self.passes("export", "ggx:alpha=0.5,f0=0.2/0.5/0.8", "-o", "x.bsdf", "--quiet")
        found = json.loads(self.passes("fit", "x.bsdf", "--model", "ggx", "--json",
                                       "--theta", "10,50", "--resolution", 32))
        self.assertEqual(found["metric"], "cube-root")
        (fit,) = found["fits"]
        self.assertIsNone(fit["chi2_per_dof"])
        values = {(p["name"], p["entry"]): p["value"] for p in fit["params"]}
        self.assertAlmostEqual(values["alpha", None], 0.5, delta=0.01)
        for entry, f0 in enumerate((0.2, 0.5, 0.8)):
            self.assertAlmostEqual(values["f0", entry], f0, delta=0.01)

    def test_materialx(self):
        self.passes("fit", "r.asperity", "--model", "beckmann,ggx", "--mtlx", "x.mtlx")
        self.assertIn(b"open_pbr_surface", content("x.mtlx"))
        self.fails(2, "fit", "r.asperity", "--model", "beckmann", "--mtlx", "y.mtlx", saying="mtlx")
        self.assert_files("r.asperity", "x.mtlx")

    def test_refusals(self):
        self.fails(2, "fit", saying="needs")
        self.fails(4, "fit", "nosuch", saying="nosuch")
        for options, words in ((["--model", "phong"], "phong"), (["--model", "ggx:k"], "ggx:k"),
                               (["--metric", "l7"], "metric"), (["--free", "beta"], "free"),
                               (["--theta", "30"], "its own light"), (["--max-theta", 0], "max-theta"),
                               (["--model", "ggx:alpha=0.3"], "free"),
                               (["--model", "ggx", "--png", "no/such/x.png"], "no/such")):
            code = 4 if "--png" in options else 2
            self.fails(code, "fit", "r.asperity", *options, saying=words)
        self.fails(2, "fit", "ggx:alpha=0.3", "--light", "single", saying="light")
        self.fails(2, "fit", "ggx:alpha=0.3", "--metric", "chi2", "--model", "ggx", saying="metric")
        self.assert_files("r.asperity")


class Selftest(ProgramTest):
    def test_all_pass(self):
        text = self.passes("selftest")
        lines = text.splitlines()
        self.assertIn("Texture layer 15, 32 x 32 ... PASSED", lines)
        self.assertEqual(sum(line.startswith("Texture layer") for line in lines), 75)
        self.assertEqual(sum(line.startswith("Model loading") for line in lines), 4)
        thesis = lines.index("79 of 79 passed: the thesis' Run Test")
        self.assertEqual(thesis, 79)
        single = lines[:thesis] + lines[thesis + 1:-1]
        self.assertTrue(all(line.endswith("PASSED") for line in single))
        checks = len(single)
        self.assertEqual(lines[-1], f"{checks} of {checks} passed")


class Streams(ProgramTest):
    def setUp(self):
        super().setUp()
        self.passes("simulate", "--surface", "flat", *SMALL, "-o", "r.asperity")

    def test_full_disk(self):
        with open("/dev/full", "w", encoding="utf-8") as full:
            done = run("info", "r.asperity", stdout=full)
        self.assertEqual(done.returncode, 4)
        self.assertEqual(done.stderr.count("\n"), 1)

    def test_closed_output(self):
        done = subprocess.run(f"'{PROGRAM}' info r.asperity >&-", shell=True, text=True,
                              stderr=subprocess.PIPE, check=False)
        self.assertEqual(done.returncode, 4)
        self.assertIn("standard output", done.stderr)
        # The number of the closed stream must not go to the output file.
        subprocess.run(f"'{PROGRAM}' simulate --quiet --surface flat --size 64 -o b.asperity >&-",
                       shell=True, check=True)
        self.passes("info", "b.asperity")

    def test_reader_that_goes_away(self):
        done = subprocess.run(f"'{PROGRAM}' selftest --threads 1 | head -n 1", shell=True, text=True,
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE, check=False)
        self.assertEqual(done.stderr, "")
        self.assertIn("PASSED", done.stdout)


if __name__ == "__main__":
    sys.exit(main())
