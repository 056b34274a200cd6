# SPDX-License-Identifier: Apache-2.0
"""Pictures: what goes in, what comes out, what is refused, and what a stop leaves."""
import math
import os
import signal
import struct
import subprocess
import sys
import time
import zlib

from program import PROGRAM, SMALL, ProgramTest, main

# A picture that takes a moment.
TINY = ["--width", "24", "--height", "20", "--spp", "4"]


def png_texts(path):
    """The text chunks of a PNG, by a reader that is not ours."""
    with open(path, "rb") as file:
        data = file.read()
    place, texts = 8, {}
    while place < len(data):
        length, kind = struct.unpack(">I4s", data[place:place + 8])
        body = data[place + 8:place + 8 + length]
        place += 12 + length
        name, _, rest = body.partition(b"\0")
        if kind == b"tEXt":
            texts[name.decode()] = rest.decode("latin-1")
        elif kind == b"zTXt":
            texts[name.decode()] = zlib.decompress(rest[1:]).decode("latin-1")
        elif kind == b"iTXt":
            packed, (_, _, text) = rest[0], rest[2:].split(b"\0", 2)
            texts[name.decode()] = (zlib.decompress(text) if packed else text).decode()
    return texts


def exr_attributes(path):
    """The header of an EXR file: its string attributes and the names of its channels."""
    with open(path, "rb") as file:
        data = file.read()
    assert data[:4] == b"\x76\x2f\x31\x01", path
    place, texts, channels = 8, {}, []
    while data[place]:
        name, kind, rest = data[place:].split(b"\0", 2)
        place = len(data) - len(rest)
        size = struct.unpack("<i", data[place:place + 4])[0]
        value = data[place + 4:place + 4 + size]
        place += 4 + size
        if kind == b"string":
            texts[name.decode()] = value.decode()
        elif kind == b"chlist":
            while value[0]:
                channel, value = value.split(b"\0", 1)
                channels.append(channel.decode())
                value = value[16:]
    return texts, channels


class Pictures(ProgramTest):
    def test_both_formats_tell_where_they_come_from(self):
        told = self.json_of("render", "--model", "knot", "--brdf", "ggx:alpha=0.3", "--brdf",
                            "lambert:albedo=0.5", "--seed", 7, *TINY, "-o", "a.png", "-o", "a.exr")
        self.assert_files("a.png", "a.exr")
        self.assertEqual(told["files"], ["a.png", "a.exr"])
        texts, channels = exr_attributes("a.exr")
        self.assertEqual(channels, ["B", "G", "R", "stderr.Y"])
        for texts in (texts, png_texts("a.png")):
            self.assertEqual(texts["asperity:model"], "knot")
            self.assertEqual(texts["asperity:brdf"], "ggx:alpha=0.3")
            self.assertEqual(texts["asperity:brdf.2"], "lambert:albedo=0.5")
            self.assertEqual(texts["asperity:seed"], "7")
            self.assertEqual(texts["asperity:samples"], "4")
            self.assertEqual(float(texts["asperity:noise"]), told["noise"])

    def test_a_result_brings_its_experiment(self):
        self.passes("simulate", "--surface", "gaussian", *SMALL, "-o", "r.asperity")
        self.passes("render", "--brdf", "r.asperity", *TINY, "-o", "a.png")
        texts = png_texts("a.png")
        self.assertIn("surface = gaussian", texts["asperity:experiment"])
        self.assertEqual(texts["asperity:experiment-checksum"],
                         self.passes("info", "r.asperity").split("checksum ")[1].split()[0])

    def test_same_bits_for_any_number_of_threads(self):
        self.passes("simulate", "--surface", "gaussian", *SMALL, "-o", "r.asperity")
        scene = ["render", "--model", "bowl", "--floor", "--brdf", "r.asperity", "--brdf",
                 "cook-torrance:roughness=0.5", "--light", "sky", "--light", "point", *TINY]
        sums = {self.json_of(*scene, "--threads", threads, "-o", f"{threads}.exr")["checksum"]
                for threads in (1, 2, 3)}
        self.assertEqual(len(sums), 1)
        other = self.json_of(*scene, "--seed", 2, "-o", "other.exr")
        self.assertNotIn(other["checksum"], sums)

    def test_white_furnace(self):
        # A white sphere in white light cannot be told from what is behind it.
        told = self.json_of("render", "--model", "sphere", "--brdf", "lambert:albedo=1", "--light",
                            "constant", "--direct", "brdf", *TINY, "-o", "a.exr")
        self.assertAlmostEqual(told["mean_luminance"], 1, delta=1e-5)
        self.assertEqual(told["rays"]["invalid"], 0)
        grey = self.json_of("render", "--model", "sphere", "--brdf", "lambert:albedo=0.5",
                            "--light", "constant", "--background", 0, *TINY, "-o", "a.exr")
        more = self.json_of("render", "--model", "sphere", "--brdf", "lambert:albedo=0.25",
                            "--albedo", 0.25, "--light", "constant", "--light-intensity", 2,
                            "--background", 0, *TINY, "-o", "a.exr")
        self.assertGreater(grey["mean_luminance"], 0.05)
        self.assertAlmostEqual(more["mean_luminance"] / grey["mean_luminance"], 2, delta=0.01)

    def test_split_shows_either_side(self):
        def checksum(*options):
            return self.json_of("render", "--model", "knot", *options, *TINY, "-o",
                                "a.exr")["checksum"]
        left, right = ["--brdf", "ggx:alpha=0.2"], ["--brdf", "lambert:albedo=0.4"]
        self.assertEqual(checksum(*left, *right, "--split", 1), checksum(*left))
        self.assertEqual(checksum(*left, *right, "--split", 0), checksum(*right))
        self.assertNotIn(checksum(*left, *right), (checksum(*left), checksum(*right)))

    def test_until_it_is_clean(self):
        told = self.json_of("render", "--model", "sphere", "--light", "constant", "--brdf",
                            "cook-torrance:roughness=0.5", *TINY[:4], "--until", "1%", "-o",
                            "a.exr")
        self.assertLessEqual(told["noise"], 0.01)
        self.assertLess(told["samples"], 4096)
        few = self.json_of("render", "--until", "0.01%", *TINY, "-o", "a.exr")
        self.assertEqual(few["samples"], 4)

    def test_every_way_to_integrate_agrees(self):
        means = [self.json_of("render", "--model", "sphere", "--brdf", "lambert:albedo=0.8",
                              "--light", "constant", "--depth", 1, *TINY[:4], "--spp", 256, *way,
                              "-o", "a.exr")["mean_luminance"]
                 for way in ([], ["--direct", "light"], ["--direct", "brdf"], ["--filter", "box"],
                             ["--integrator", "stratified", "--strata", 16])]
        for mean in means:
            self.assertAlmostEqual(mean / means[0], 1, delta=0.002)

    def test_models_from_files(self):
        with open("tetra.obj", "w") as file:
            file.write("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n"
                       "f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\nf 1 1 2\n")
        told = self.json_of("render", "--model", "tetra.obj", "--normals", "facet", *TINY, "-o",
                            "a.png")
        self.assertEqual(told["model"]["unique_triangles"], 4)
        self.assertEqual(told["model"]["dropped_triangles"], 1)
        self.assertEqual(told["model"]["meshes"], 1)

    def test_a_picture_lights_a_picture(self):
        self.passes("render", "--model", "ball", *TINY, "-o", "light.exr")
        told = self.json_of("render", "--light", "env:light.exr", "--light-rotation", 90,
                            "--light-scale", 2, *TINY, "-o", "a.exr")
        self.assertIn("light.exr", told["lights"][0])
        self.assertGreater(told["mean_luminance"], 0)

    def test_looks(self):
        pictures = set()
        for k, look in enumerate(([], ["--tonemap", "aces"], ["--tonemap", "reinhard"],
                                  ["--tonemap", "thesis"], ["--exposure", -1],
                                  ["--transfer", "linear"])):
            self.passes("render", *TINY, *look, "-o", f"{k}.png")
            with open(f"{k}.png", "rb") as file:
                pictures.add(file.read())
        self.assertEqual(len(pictures), 6)


class Sheets(ProgramTest):
    def test_side_by_side_and_apart(self):
        for name, albedo in (("a", 0.4), ("b", 0.5)):
            self.passes("render", "--brdf", f"lambert:albedo={albedo}", "--model", "sphere",
                        "--light", "constant", "--background", 0, *TINY, "-o", f"{name}.exr")
        self.passes("sheet", "a.exr", "b.exr", "a.exr", "--columns", 2, "--title", "three",
                    "--heads", "left,right", "--labels", "a,b,c", "-o", "s.png")
        self.assert_files("a.exr", "b.exr", "s.png")
        told = self.json_of("compare", "a.exr", "b.exr")
        self.assertAlmostEqual(told["mean_b"] / told["mean_a"], 1.25, delta=0.02)
        self.assertAlmostEqual(told["relative_difference"], 0.25, delta=0.02)
        self.assertEqual(self.json_of("compare", "a.exr", "a.exr")["rms_difference"], 0)
        self.assertIn("root mean square", self.passes("compare", "a.exr", "b.exr"))

    def test_refusals(self):
        self.passes("render", *TINY, "-o", "a.exr")
        self.passes("render", "--width", 10, "--height", 10, "--spp", 1, "-o", "b.exr")
        self.fails(2, "sheet", "-o", "s.png", saying="pictures")
        self.fails(2, "sheet", "a.exr", "-o", "s.jpg", saying=".png")
        self.fails(2, "sheet", "a.exr", "--heads", "x,y", "-o", "s.png", saying="heads")
        self.fails(2, "sheet", "a.exr", "--labels", "x,y", "-o", "s.png", saying="labels")
        self.fails(2, "sheet", "a.exr", "--columns", 2, "-o", "s.png", saying="columns")
        self.fails(3, "sheet", "a.exr", "b.exr", "-o", "s.png", saying="10 x 10")
        self.fails(4, "sheet", "none.exr", "-o", "s.png", saying="none.exr")
        self.fails(2, "compare", "a.exr", "b.exr", saying="image")
        self.fails(2, "compare", "a.exr", "a.exr", "--theta", 3, saying="models")


class Panorama(ProgramTest):
    LIGHT = ["--model", "none", "--camera", "panorama", "--width", 64, "--height", 32, "--filter",
             "centre", "--spp", 1]

    def test_a_map_seen_all_round_is_the_map(self):
        """In the middle of its texels a map shows them as they are: camera and light agree."""
        self.passes("render", *self.LIGHT, "--sun-diameter", 20, "-o", "sky.exr")
        self.passes("render", *self.LIGHT, "--light", "env:sky.exr", "-o", "again.exr")
        difference = self.json_of("compare", "sky.exr", "again.exr")
        self.assertGreater(difference["mean_a"], 0)
        self.assertLess(difference["relative_difference"], 1e-6)
        turned = ["--light", "env:sky.exr", "--light-rotation", 90]
        self.passes("render", *self.LIGHT, *turned, "-o", "turned.exr")
        self.assertGreater(
            self.json_of("compare", "sky.exr", "turned.exr")["relative_difference"], 0.1)

    def test_models_are_seen_from_a_place(self):
        """A black sphere of radius 1 seen from 3 away hides a cone of asin(1 / 3) about -z."""
        white = ["--light", "constant", "--camera-position", "0,0,3"]
        self.passes("render", *self.LIGHT[2:], "--model", "sphere", "--brdf", "lambert:albedo=0",
                    *white, "-o", "a.exr")
        self.passes("render", *self.LIGHT, *white, "-o", "b.exr")
        hidden = 0
        for row in range(32):
            for column in range(64):
                theta, phi = math.pi * (row + 0.5) / 32, 2 * math.pi * ((column + 0.5) / 64 - 0.5)
                hidden += math.sin(theta) * math.cos(phi) > math.sqrt(8) / 3
        found = self.json_of("compare", "a.exr", "b.exr")
        self.assertAlmostEqual(found["mean_a"] * 2048, 2048 - hidden, delta=2.5)
        self.assertEqual(found["mean_b"], 1)


class Refusals(ProgramTest):
    # Options that no picture can be made with, and a word of the answer.
    SILLY = [
        (["--width", 0], "width"), (["--height", "many"], "height"), (["--spp", 0], "spp"),
        (["--width", 16384, "--height", 16384], "width"), (["--spp", "1e9"], "spp"),
        (["--until", "0"], "until"), (["--until", "200%"], "until"), (["--depth", 0], "depth"),
        (["--integrator", "magic"], "integrator"), (["--strata", 3], "stratified"),
        (["--direct", "no"], "direct"), (["--filter", "sinc"], "filter"), (["--seed", -1], "seed"),
        (["--model", "teapot"], "knot"), (["--normals", "bumpy"], "normals"),
        (["--crease", 181], "crease"), (["--no-fit"], "no-fit"), (["--threads", 0], "threads"),
        (["--brdf", "ggx"], "alpha"), (["--brdf", "ggx:alpha=often"], "alpha"),
        (["--brdf", "lambert:albedo=0.1/0.2"], "channels"), (["--stage", "felt"], "felt"),
        (["--brdf", "lambert"] * 3, "twice"), (["--split", 0.3], "--brdf"),
        (["--brdf", "lambert", "--brdf", "lambert", "--split", 2], "split"),
        (["--normalize-factor", -1], "normalize-factor"), (["--normalize-factor", "1,2"], "second"),
        (["--albedo", 2], "albedo"), (["--albedo", "1/0"], "albedo"), (["--albedo", "0,1"], "second"),
        (["--light", "lamp"], "env:FILE"), (["--light", "env:"], "env:FILE"),
        (["--light-position", "1,1,1"], "point"), (["--turbidity", 1], "turbidity"),
        (["--light", "point", "--light-position", "1,1"], "X,Y,Z"),
        (["--light", "point", "--light-intensity", -1], "light-intensity"),
        (["--light", "point", "--light-colour", "red"], "light-colour"),
        (["--light", "directional", "--light-direction", "0,0,0"], "light-direction"),
        (["--light", "point", "--sun-azimuth", 3], "sky"), (["--sun-elevation", -3], "sun-elevation"),
        (["--sun-diameter", 0], "sun-diameter"), (["--light-scale", 0], "light-scale"),
        (["--sun-azimuth", "east"], "sun-azimuth"), (["--light-rotation", 3], "env"),
        (["--background", "blue"], "background"), (["--camera-fov", 0], "camera-fov"),
        (["--camera-distance", 0], "camera-distance"), (["--camera-elevation", 90], "elevation"),
        (["--camera-azimuth", "left"], "azimuth"), (["--camera-target", "0,0,1e999"], "target"),
        (["--camera-position", "0,0,0"], "camera"),
        (["--camera-position", "0,0,1", "--camera-distance", 2], "camera-position"),
        (["--camera", "fisheye"], "panorama"), (["--camera", "panorama"], "twice as wide"),
        (["--camera", "panorama", "--width", 64, "--height", 32, "--camera-fov", 50], "camera-fov"),
        (["--model", "none", "--brdf", "lambert"], "no model"),
        (["--tonemap", "film"], "tonemap"), (["--exposure", 101], "exposure"),
        (["--transfer", "log"], "transfer"), (["--modle", "knot"], "did you mean --model?"),
    ]

    def test_silly_options(self):
        for options, word in self.SILLY:
            with self.subTest(options):
                self.fails(2, "render", *options, "-o", "a.png", saying=word)
        self.assert_files()

    def test_every_option_is_tried(self):
        tried = {word for options, _ in self.SILLY for word in options}
        for line in self.passes("render", "--help").split("Examples")[0].splitlines():
            if not line.startswith("      --"):
                continue
            name = line.split()[0]
            if name not in ("--floor", "--json", "--quiet", "--help"):
                self.assertIn(name, tried)

    def test_files(self):
        self.fails(4, "render", "--model", "no.obj", "-o", "a.png", saying="no.obj")
        self.fails(4, "render", "--brdf", "no.asperity", "-o", "a.png", saying="no such model")
        self.fails(4, "render", "--light", "env:no.exr", "-o", "a.png", saying="no.exr")
        self.fails(2, "render", saying="-o")
        self.fails(2, "render", "-o", "a.jpg", saying=".png")
        self.fails(4, "render", "-o", "no/a.png", saying="no folder")
        for name in ("bad.obj", "bad.ply", "bad.stl", "bad.glb", "bad.exr", "bad.asperity"):
            with open(name, "wb") as file:
                file.write(b"\x76\x2f\x31\x01 nothing of the kind\n")
        for name in ("bad.obj", "bad.ply", "bad.stl", "bad.glb"):
            self.fails(3, "render", "--model", name, *TINY, "-o", "a.png", saying=name)
        self.fails(3, "render", "--light", "env:bad.exr", *TINY, "-o", "a.png", saying="bad.exr")
        self.fails(3, "render", "--brdf", "bad.asperity", *TINY, "-o", "a.png", saying="bad.asp")
        self.assertFalse(os.path.exists("a.png"))

    def test_four_colours_are_no_picture(self):
        self.passes("simulate", "--surface", "flat", *SMALL, "--material", "Au", "--wavelengths",
                    "450,500,550,600", "-o", "r.asperity")
        self.fails(3, "render", "--brdf", "r.asperity", "-o", "a.png",
                   saying="--wavelengths 650,550,450")


class Stop(ProgramTest):
    def test_keeps_what_is_there(self):
        process = subprocess.Popen([PROGRAM, "render", "--model", "sphere", "--spp", "100000",
                                    "--width", "64", "--height", "64", "-o", "a.exr"],
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        self.addCleanup(process.kill)
        while "light:" not in process.stdout.readline():
            self.assertIsNone(process.poll())
        time.sleep(2)
        process.send_signal(signal.SIGINT)
        out, err = process.communicate(timeout=60)
        self.assertEqual(process.returncode, 130, err)
        self.assertIn("wrote a.exr (partial)", out)
        self.assert_files("a.exr")
        texts, _ = exr_attributes("a.exr")
        self.assertIn("asperity:stopped", texts)
        self.assertGreater(int(texts["asperity:samples"]), 0)
        self.assertLess(int(texts["asperity:samples"]), 100000)


if __name__ == "__main__":
    sys.exit(main())
