#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""check_pbrt.py PROGRAM: the scene of pbrt-v4 that export --snippet writes, and the file it names, by
the rules of pbrt's manual and of its reader. pbrt comes in no package: this stands in its place. It
takes the words of a scene apart, knows which parameters each statement has (pbrt ends with an error
at one it does not know) and of the measured file which fields there must be, of which type and shape.
"""
import os
import re
import struct
import subprocess
import sys
import tempfile
import unittest

program = os.path.abspath(sys.argv.pop(1))

TOKEN = re.compile(r'"(?:[^"\\\n]|\\["\\/bfnrt])*"|\[|\]|#[^\n\r]*|[^\s"\[\]]+|(?P<bad>\S)')
# Statements of numbers alone; where a statement may stand: before or after WorldBegin, or both
NUMBERS = {"LookAt": 9, "Translate": 3, "Scale": 3, "Rotate": 4}
BEFORE = {"Camera", "Sampler", "Film", "Integrator", "PixelFilter", "Accelerator", "ColorSpace"}
AFTER = {"LightSource", "Material", "Shape", "AttributeBegin", "AttributeEnd"}
# Statement and its kind -> parameters: type and how many values
PARAMETERS = {
    ("Camera", "perspective"): {"fov": ("float", 1), "lensradius": ("float", 1),
                                "focaldistance": ("float", 1), "frameaspectratio": ("float", 1),
                                "screenwindow": ("float", 4)},
    ("Sampler", "halton"): {"pixelsamples": ("integer", 1), "seed": ("integer", 1),
                            "randomization": ("string", 1)},
    ("Film", "rgb"): {"filename": ("string", 1), "xresolution": ("integer", 1),
                      "yresolution": ("integer", 1), "cropwindow": ("float", 4)},
    ("LightSource", "infinite"): {"L": ("rgb", 3), "scale": ("float", 1), "illuminance": ("float", 1),
                                  "filename": ("string", 1)},
    ("LightSource", "distant"): {"L": ("rgb", 3), "scale": ("float", 1), "illuminance": ("float", 1),
                                 "from": ("point3", 3), "to": ("point3", 3)},
    ("Material", "measured"): {"filename": ("string", 1), "displacement": ("float", 1)},
    ("Shape", "sphere"): {"radius": ("float", 1), "zmin": ("float", 1), "zmax": ("float", 1),
                          "phimax": ("float", 1)},
}


class SceneError(Exception):
    pass


def words_of(text):
    words = []
    for match in TOKEN.finditer(text):
        if match.group("bad"):
            raise SceneError(f"a string does not end: {match.group()}")
        if not match.group().startswith("#"):
            words.append(match.group())
    return words


def is_text(word):
    return len(word) >= 2 and word[0] == word[-1] == '"'


def number(word, whole=False):
    if not re.fullmatch(r"[+-]?\d+" if whole else r"[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?", word):
        raise SceneError(f"{word} is no number")
    return float(word)


class Scene:
    """Statements in their order: (name, kind, {parameter: values})."""

    def __init__(self, text):
        self.words = words_of(text)[::-1]
        self.statements = []
        self.world = False
        while self.words:
            self.statement(self.words.pop())

    def next(self):
        if not self.words:
            raise SceneError("the file ends too early")
        return self.words.pop()

    def statement(self, name):
        if name in NUMBERS:
            values = [number(self.next()) for _ in range(NUMBERS[name])]
            self.statements.append((name, None, {"": values}))
        elif name == "WorldBegin":
            if self.world:
                raise SceneError("WorldBegin stands twice")
            self.world = True
            self.statements.append((name, None, {}))
        elif name in BEFORE | AFTER:
            if (name in BEFORE) == self.world:
                raise SceneError(f"{name} stands on the wrong side of WorldBegin")
            kind = self.next()
            if not is_text(kind) or (name, kind[1:-1]) not in PARAMETERS:
                raise SceneError(f"{name} {kind} is not known")
            self.statements.append((name, kind[1:-1], self.parameters((name, kind[1:-1]))))
        else:
            raise SceneError(f"unknown statement {name}")

    def parameters(self, owner):
        found = {}
        while self.words and is_text(self.words[-1]):
            declared = self.words.pop()[1:-1].split()
            if len(declared) != 2:
                raise SceneError(f"{declared} is not a type and a name")
            kind, name = declared
            if PARAMETERS[owner].get(name, ("",))[0] != kind:
                raise SceneError(f"{owner} has no {kind} {name}")
            if name in found:
                raise SceneError(f"{name} stands twice")
            values = self.values(kind)
            if len(values) != PARAMETERS[owner][name][1]:
                raise SceneError(f"{name} has {len(values)} values")
            found[name] = values
        return found

    def values(self, kind):
        words = [self.next()]
        if words == ["["]:
            words = []
            while (word := self.next()) != "]":
                words.append(word)
        if kind == "string":
            if not all(map(is_text, words)):
                raise SceneError(f"{words} is no text")
            return [re.sub(r"\\(.)", r"\1", word[1:-1]) for word in words]
        return [number(word, kind == "integer") for word in words]


def fields_of(path):
    """Of a tensor file: name -> (type, shape, bytes)."""
    with open(path, "rb") as file:
        data = file.read()
    assert data[:12] == b"tensor_file\0" and data[12:14] == b"\1\0"
    count, at, fields = struct.unpack_from("<I", data, 14)[0], 18, {}
    sizes = {1: 1, 10: 4}
    for _ in range(count):
        length = struct.unpack_from("<H", data, at)[0]
        name = data[at + 2:at + 2 + length].decode()
        at += 2 + length
        rank, kind, offset = struct.unpack_from("<HBQ", data, at)
        shape = struct.unpack_from(f"<{rank}Q", data, at + 11)
        at += 11 + 8 * rank
        size = sizes[kind]
        for extent in shape:
            size *= extent
        assert offset + size <= len(data), name
        fields[name] = ({1: "uint8", 10: "float32"}[kind], shape, data[offset:offset + size])
    return fields


class Pbrt(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)

    def export(self, model, name):
        path = os.path.join(self.folder.name, name)
        subprocess.run([program, "export", model, "-o", path, "--format", "rgl:colour=spectral,n=16",
                        "--snippet", "--quiet"], check=True)
        with open(path[:-5] + "_pbrt.pbrt", encoding="utf-8") as file:
            return path, file.read()

    def test_the_scene_is_one(self):
        for name in ("copper.bsdf", "two words.bsdf", 'a "name".bsdf', "back\\slash.bsdf"):
            path, text = self.export("ggx:alpha=0.3", name)
            scene = Scene(text)
            kinds = [statement[0] for statement in scene.statements]
            for needed in ("LookAt", "Camera", "Film", "WorldBegin", "LightSource", "Material", "Shape"):
                self.assertIn(needed, kinds)
            # A material holds for the shapes behind it
            self.assertLess(kinds.index("Material"), kinds.index("Shape"))
            material = next(s for s in scene.statements if s[0] == "Material")
            self.assertEqual(material[2]["filename"], [os.path.basename(path)])

    def test_damaged_scenes_are_seen(self):
        _, text = self.export("ggx:alpha=0.3", "copper.bsdf")
        Scene(text)
        for old, new in (('"copper.bsdf"', '"copper.bsdf'), ('"copper.bsdf"', "copper.bsdf"),
                         ("WorldBegin\n", ""), ("[2 2 2]", "[2 2]"), ("[2 2 2]", "[2 2 2"),
                         ("string filename", "string brdffile"), ("float fov", "integer fov"),
                         ("LookAt 0", "LookAt"), ('"measured"', '"glossy"'), ("512 ", "512.5 "),
                         ("Shape", "Shapes"), ("64", '"64"')):
            self.assertIn(old, text)
            with self.assertRaises(SceneError, msg=new):
                Scene(text.replace(old, new, 1))

    def test_the_file_has_what_the_reader_asks_for(self):
        for model in ("beckmann:alpha=0.2", "ggx:alpha=0.3,alpha_y=0.5"):
            path, _ = self.export(model, "m.bsdf")
            fields = fields_of(path)
            rank = {"theta_i": 1, "phi_i": 1, "ndf": 2, "sigma": 2, "vndf": 4, "spectra": 5,
                    "luminance": 4, "wavelengths": 1, "description": 1, "jacobian": 1}
            self.assertLessEqual(set(rank), set(fields))
            for name, count in rank.items():
                kind, shape, _ = fields[name]
                self.assertEqual(len(shape), count, name)
                self.assertEqual(kind, "uint8" if name in ("description", "jacobian") else "float32")
            shape = {name: field[1] for name, field in fields.items()}
            light = (shape["phi_i"][0], shape["theta_i"][0])
            n = shape["luminance"][2]
            self.assertEqual(shape["luminance"], light + (n, n))
            self.assertEqual(shape["vndf"][:2], light)
            self.assertEqual(shape["spectra"], light + shape["wavelengths"] + (n, n))
            self.assertEqual(shape["jacobian"], (1,))
            phi = struct.unpack(f"<{light[0]}f", fields["phi_i"][2])
            if "alpha_y" in model:
                # A turn divided by the azimuths' range is the order of the symmetry: whole
                self.assertGreater(light[0], 2)
                turns = 2 * 3.14159265 / (phi[-1] - phi[0])
                self.assertAlmostEqual(turns, round(turns), delta=1e-3)
            else:
                self.assertLessEqual(light[0], 2)
            for name in ("theta_i", "wavelengths"):
                values = struct.unpack(f"<{shape[name][0]}f", fields[name][2])
                self.assertEqual(list(values), sorted(set(values)), name)
            self.assertGreaterEqual(min(struct.unpack(f"<{n * n * light[0] * light[1]}f",
                                                      fields["luminance"][2])), 0)


if __name__ == "__main__":
    unittest.main()
