#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Plants right and wrong includes in a small tree and expects check_layers to tell them apart."""

import tempfile
import unittest
from pathlib import Path

from check_layers import check


class Layers(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = Path(folder.name)
        for module in ("core", "surface", "optics", "tracing", "gonio", "bsdf", "render", "formats",
                       "formats/heights"):
            self.write(f"src/asperity/{module}/a.h", "#pragma once\n#include <vector>\n")
        self.write("apps/cli/main.cpp", "#include <asperity/formats/a.h>\n#include <CLI/CLI.hpp>\n")

    def write(self, name, text):
        path = self.root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")

    def complaints_about(self, name, include):
        self.write(name, f"// first line\n#include {include}\n")
        complaints, _ = check(self.root)
        return [line for line in complaints if line.startswith(f"{self.root / name}:2: ")]

    def test_a_right_tree_passes(self):
        self.write("src/asperity/gonio/b.cpp", "#include <asperity/gonio/a.h>\n"
                                               "#include <asperity/tracing/a.h>\n"
                                               "#include <asperity/core/a.h>\n")
        self.write("src/asperity/formats/heights/b.cpp", "#include <asperity/formats/a.h>\n"
                                                         "#include <png.h>\n")
        complaints, read = check(self.root)
        self.assertEqual(complaints, [])
        self.assertEqual(read, 9 + 1 + 2)

    def test_each_wrong_arrow_is_found(self):
        for module, target in (("core", "surface"), ("surface", "optics"), ("optics", "surface"),
                               ("surface", "tracing"), ("tracing", "gonio"), ("gonio", "bsdf"),
                               ("bsdf", "render"), ("render", "gonio"), ("gonio", "formats"),
                               ("formats", "formats/heights"), ("render", "formats"), ("core", "apps")):
            with self.subTest(module=module, target=target):
                name = f"src/asperity/{module}/wrong.cpp"
                self.assertEqual(len(self.complaints_about(name, f"<asperity/{target}/a.h>")), 1)
                (self.root / name).unlink()

    def test_files_are_written_through_one_door(self):
        for line in ("std::ofstream out(path);", "QSaveFile file(path);", "std::fopen(p, \"wb\");",
                     "Imf::OutputFile image(path.c_str(), header);", "picture.save(path, \"PNG\");"):
            self.write("src/asperity/formats/heights/b.cpp", line)
            self.assertEqual(len(check(self.root)[0]), 1, line)
        for line in ("picture.save(&buffer, \"PNG\");", "// no std::ofstream here",
                     "Imf::OutputFile image(stream, header);"):
            self.write("src/asperity/formats/heights/b.cpp", line)
            self.assertEqual(check(self.root)[0], [], line)

    def test_spaces_do_not_hide_an_include(self):
        self.write("src/asperity/core/b.h", "  #  include   <asperity/formats/a.h>\n")
        self.assertEqual(len(check(self.root)[0]), 1)

    def test_relative_includes_are_found(self):
        self.assertEqual(len(self.complaints_about("src/asperity/core/b.h", '"../formats/a.h"')), 1)

    def test_numerics_in_a_program_are_found(self):
        self.assertEqual(len(self.complaints_about("apps/cli/b.cpp", "<Eigen/Dense>")), 1)

    def test_an_unknown_folder_is_found(self):
        self.write("src/asperity/extra/a.h", "")
        self.assertEqual(len(check(self.root)[0]), 1)

    def test_an_empty_tree_does_not_pass_for_a_right_one(self):
        with tempfile.TemporaryDirectory() as empty:
            (Path(empty) / "src" / "asperity").mkdir(parents=True)
            (Path(empty) / "apps").mkdir()
            self.assertEqual(check(Path(empty)), ([], 0))


if __name__ == "__main__":
    unittest.main()
