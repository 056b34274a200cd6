#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Plants right and wrong links in a small graph and expects check_links to tell them apart."""

import unittest

from check_links import check, read_graph

RIGHT = [
    "asperity_core src/asperity/core Threads::Threads;$<BUILD_INTERFACE:asperity_flags>",
    "asperity_surface src/asperity/surface asperity_core;$<LINK_ONLY:Eigen3::Eigen>",
    "asperity_gonio src/asperity/gonio asperity_surface",
    "asperity_bsdf src/asperity/bsdf asperity_surface;fmt::fmt",
    "asperity_render src/asperity/render asperity_bsdf;embree",
    "asperity_files src/asperity/formats asperity_core",
    "asperity_images src/asperity/formats/images asperity_render;asperity_files;PNG::PNG",
    "asperity_cli apps/cli asperity_gonio;asperity_images",
]


class Links(unittest.TestCase):
    def complaints(self, *lines):
        return check(read_graph(RIGHT + list(lines)))

    def test_a_right_graph_passes(self):
        self.assertEqual(self.complaints(), [])

    def test_each_wrong_arrow_is_found(self):
        for line in ("asperity_render src/asperity/render asperity_bsdf;asperity_gonio",
                     "asperity_render src/asperity/render $<LINK_ONLY:asperity_gonio>",
                     "asperity_core src/asperity/core $<BUILD_INTERFACE:asperity_surface>",
                     "asperity_images src/asperity/formats/images asperity_gonio",
                     "asperity_new src/asperity/new asperity_core"):
            with self.subTest(line=line):
                self.assertEqual(len(self.complaints(line)), 1)

    def test_embree_on_the_way_to_a_measurement_is_found(self):
        # Through a target of the same room, which no arrow between rooms would tell.
        lines = ("asperity_gonio src/asperity/gonio asperity_surface;asperity_mesh",
                 "asperity_mesh src/asperity/gonio embree")
        self.assertEqual(self.complaints(*lines),
                         ["asperity_gonio: needs embree, and so would all who measure",
                          "asperity_mesh: needs embree, and so would all who measure"])

    def test_the_rest_of_the_build_is_not_its_business(self):
        self.assertEqual(read_graph(["asperity_cli apps/cli asperity_gonio", ""]), {})


if __name__ == "__main__":
    unittest.main()
