#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Takes includes away from a small tree and expects check_includes to miss what they brought."""

import tempfile
import unittest
from pathlib import Path

from check_includes import check

HEADER = """#pragma once
#include <vector>
namespace asperity {
inline constexpr int kMostCells = 3;
struct Heightfield { enum class Side { Left, Right }; std::vector<float> heights; };
using Heights = std::vector<float>;
}
"""
SOURCE = """#include <asperity/surface/heightfield.h>
// What a Facet is, and "std::map" in a string, needs nothing
const char* kText = "std::map Facet";
struct Own {};
asperity::Heightfield f(Own) { Heights h(kMostCells); return {std::vector<float>(h)}; }
"""


class Includes(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = Path(folder.name)
        self.write("src/asperity/surface/heightfield.h", HEADER)
        self.write("src/asperity/surface/facet.h",
                   "#pragma once\n#include <asperity/surface/heightfield.h>\nclass Facet {};\n")
        self.write("src/asperity/surface/a.cpp", SOURCE)

    def write(self, name, text):
        path = self.root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")

    def missed(self, text):
        self.write("src/asperity/surface/b.cpp", text)
        complaints, read = check(self.root)
        self.assertEqual(read, 4)
        return [line.split(": ")[1] for line in complaints]

    def test_what_is_included_is_there(self):
        self.assertEqual(self.missed(SOURCE), [])

    def test_what_an_include_includes_is_there(self):
        self.assertEqual(self.missed(SOURCE.replace("heightfield", "facet")), [])

    def test_what_nothing_brings_is_missed(self):
        own = "src/asperity/surface/heightfield.h"
        self.assertEqual(self.missed("#include <cmath>\n" + "".join(SOURCE.splitlines(True)[1:])),
                         [f"{name} needs {own}" for name in ("Heightfield", "Heights", "kMostCells")]
                         + ["std::vector needs <vector>"])

    def test_names_inside_of_others_are_no_names_of_headers(self):
        for text in ("enum class Kind { Facet, Edge };\nKind k = Facet;", "Imf::Facet f;",
                     "struct S {\n    struct Facet {};\n    Facet f;\n};", "int n = s.Facet;",
                     "template <class Facet>\nvoid f(Facet);"):
            self.assertEqual(self.missed(text + "\n"), [], text)
        self.assertEqual(self.missed("Facet f;\n"), ["Facet needs src/asperity/surface/facet.h"])


if __name__ == "__main__":
    unittest.main()
