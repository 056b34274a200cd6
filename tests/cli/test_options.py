# SPDX-License-Identifier: Apache-2.0
"""Silly values of every numeric option, names that are nearly right, places that cannot be written:
one clear line, the right exit code, and no file left."""
import json
import os
import resource
import signal
import sys
import unittest

from program import ProgramTest, main, run

SILLY = ["nan", "inf", "-inf", "-1", "0", "1e308", "abc", "", " ", "1,2,3,4", "0x10", "1e", "--",
         "99999999999999999999999", "1;2", "½"]

# Option: what it needs beside it, and the silly values that are no mistake for it.
OPTIONS = {
    "size": ([], []),
    "land": (["--surface", "ridges"], ["0"]),
    "roughness": ([], ["0"]),
    "alpha": (["--surface", "gaussian"], []),
    "correlation-length": (["--surface", "gaussian"], []),
    "hurst": (["--surface", "gaussian", "--autocorrelation", "self-affine"], []),
    "max-slope": (["--surface", "ggx"], []),
    "surface-seed": ([], ["0"]),
    "tilt": (["--surface", "vgroove"], ["0"]),
    "period": (["--surface", "vgroove"], []),
    "amplitude": (["--surface", "sinusoid"], ["0"]),
    "cell-size": ([], []),
    "height-scale": ([], ["-1"]),
    "layers": ([], []),
    "theta": ([], ["0", "1,2,3,4"]),
    "phi": ([], ["-1", "0", "1,2,3,4"]),
    "f0": (["--fresnel", "schlick"], ["0"]),
    "ior": (["--fresnel", "dielectric"], ["1,2,3,4"]),
    "k": (["--fresnel", "conductor", "--ior", "1.5"], ["0", "1,2,3,4"]),
    "wavelengths": (["--fresnel", "conductor", "--material", "Au"], []),
    "bounces": ([], []),
    "surfaces": ([], []),
    "jitter": ([], []),
    "rays": ([], []),
    "until": ([], []),
    "max-rays": (["--until", "50%"], []),
    "batches": ([], []),
    "resolution": ([], []),
    "orders": ([], []),
    "seed": ([], ["0"]),
    "threads": ([], []),
    "checkpoint": ([], ["0"]),
}

# The same for those of files of heights.
OF_FILES = {
    "outliers": ["0"],
    "filter-s": [],
    "filter-l": [],
    "crop": ["1,2,3,4"],
    "resample": [],
    "wavelength": [],
}

TINY = ["--size", "32", "--resolution", "8", "--layers", "1", "--quiet", "-o", "r.asperity"]


class SillyNumbers(ProgramTest):
    def test_every_option_is_in_the_table(self):
        """A numeric option is one whose value help shows in capitals that stand for numbers."""
        names = {"--surface", "--autocorrelation", "--tiling", "--boundary", "--diagonal",
                 "--format", "--channel", "--decimal", "--fill", "--level", "--fresnel", "--material", "--detector",
                 "--launch", "--config", "--reference", "--output", "--along-y", "--isotropic",
                 "--json", "--quiet", "--help", "--engine", "--part", "--resume"}
        help_lines = self.passes("simulate", "--help").split("\nExamples")[0].splitlines()
        listed = {word.rstrip(",") for line in help_lines for word in line.split()[:2]
                  if line.startswith("  ") and word.startswith("--")}
        self.assertEqual(listed - names, {"--" + option for option in [*OPTIONS, *OF_FILES]})

    def test_refused_of_files(self):
        self.passes("surface", "gaussian", "--size", "32", "--quiet", "-o", "heights.txt")
        for option, fine in OF_FILES.items():
            for value in SILLY:
                with self.subTest(option=option, value=value):
                    arguments = ["surface", "heights.txt", "--quiet", "-o", "r.gsf", "--" + option,
                                 value]
                    if value not in fine:
                        self.fails(2, *arguments, saying=option)
                        self.assertEqual(os.listdir("."), ["heights.txt"])
                        continue
                    self.passes(*arguments)
                    os.remove("r.gsf")

    def test_refused(self):
        for option, (others, fine) in OPTIONS.items():
            for value in SILLY:
                with self.subTest(option=option, value=value):
                    # What comes last counts: the option under test. Angles and layers go not together.
                    tiny = [word for word in TINY if option != "theta" or word not in ("--layers", "1")]
                    arguments = ["simulate", *tiny, *others, "--" + option, value]
                    if value not in fine:
                        self.fails(2, *arguments, saying=option)
                        self.assert_files()
                        continue
                    self.passes(*arguments)
                    os.remove("r.asperity")

    def test_names(self):
        for option in ("autocorrelation", "tiling", "boundary", "diagonal", "fresnel", "material",
                       "detector", "launch", "surface", "reference"):
            for value in ("", "nonsense", "1"):
                with self.subTest(option=option, value=value):
                    self.fails(2, "simulate", *TINY, "--" + option, value)
                    self.assert_files()


class Names(ProgramTest):
    def test_two_dashes_end_the_options(self):
        self.passes("simulate", *TINY)
        self.assertEqual(self.passes("info", "--", "r.asperity"), self.passes("info", "r.asperity"))
        self.fails(4, "info", "--", "none.asperity", saying="none.asperity")

    def test_control_characters_do_not_reach_the_terminal(self):
        for name in ("a\x1b[2Jb", "a\x07b", "a\x9bb", "a\x7fb"):
            with self.subTest(name=name):
                said = self.fails((3, 4), "info", name + ".asperity")
                self.assertFalse([c for c in said[:-1] if ord(c) < 32 or 127 <= ord(c) < 160], said)


class NearlyRight(ProgramTest):
    def test_suggestions(self):
        for arguments, words in (
                (["simulte"], "did you mean simulate?"),
                (["infos"], "did you mean info?"),
                (["simulate", "--raiz", "3"], "did you mean --rays?"),
                (["simulate", "--size=3", "--jiter=2"], "did you mean --jitter?"),
                (["simulate", "--autocor", "gaussian"], "did you mean --autocorrelation?"),
                (["export", "x", "--colour-mop", "grey"], "did you mean --colour-map?"),
                (["surface", "gaussian", "--state"], "did you mean --stats?"),
                (["xyzzy"], "unknown verb 'xyzzy'"),
                (["simulate", "--xyzzy"], "no option --xyzzy"),
                (["info", "a", "b"], "'b'"),
                (["simulate", "--rays"], "--rays needs a value"),
                (["simulate", "--quiet=perhaps"], "quiet"),
                ([], "no verb"),
                (["surface"], "needs"), (["info"], "needs"), (["compare", "a"], "needs"),
                (["--rays", "3"], "--rays")):
            with self.subTest(arguments):
                self.fails(2, *arguments, saying=words)

    def test_help_is_a_verb(self):
        self.assertEqual(self.passes("help"), self.passes("--help"))
        for verb in ("simulate", "render", "help", "reference"):
            self.assertEqual(self.passes("help", verb), self.passes(verb, "--help"))
        self.fails(2, "help", "simulte", saying="did you mean simulate?")

    def test_help_teaches(self):
        for verb in ("surface", "simulate", "refine", "merge", "info", "compare", "fit", "render",
                     "export",
                     "selftest"):
            with self.subTest(verb):
                text = self.passes(verb, "--help")
                self.assertIn(f"Usage: asperity {verb}", text)
                self.assertGreaterEqual(text.count(f"\n  asperity {verb}"), 3)
                self.assertLessEqual(max(map(len, text.splitlines())), 100)
                self.assertIn(verb, self.passes("--help"))
        text = self.passes("simulate", "--help")
        for group in ("Surface", "Light", "Facets", "Detector", "Run", "Output"):
            self.assertIn(f"\n{group}\n", text)
        self.assertIn("asperity", self.passes("--version"))


class Outputs(ProgramTest):
    def test_refused_before_computing(self):
        os.mkdir("folder")
        # Too much work to finish within the time limit: the refusal comes first.
        for path in ("no/such/r.asperity", "folder", "folder/", "new/", "/dev/full", "/dev/null",
                     "/proc/r.asperity"):
            with self.subTest(path):
                self.fails(4, "simulate", "--rays", "1e9", "-o", path, saying=path)
                self.assertEqual(os.listdir("folder"), [])
        self.fails(2, "simulate", "--rays", "1e9", "-o", "")
        self.fails(2, "surface", "flat", "-o", "heights.doc", saying=".gsf")
        self.fails(2, "surface", "flat", "--png", "s.jpg", saying=".png")
        self.fails(2, "surface", "flat", "--png", "s.png", "--look", "nice", saying="look")
        for path in ("no/s.gsf", "/dev/full.gsf/s.gsf"):
            self.fails(4, "surface", "flat", "-o", path, saying=path)
        self.assert_files("folder")

    @unittest.skipIf(os.geteuid() == 0, "root may write everywhere")
    def test_closed_folder(self):
        os.mkdir("closed", mode=0o500)
        self.fails(4, "simulate", "--rays", "1e9", "-o", "closed/r.asperity", saying="closed")

    def test_disk_that_fills_up(self):
        """A result larger than files may be: refused, and nothing is left."""
        def limit_files():
            signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
            resource.setrlimit(resource.RLIMIT_FSIZE, (4096, 4096))

        for arguments in (["simulate", "--size", "32", "--quiet", "-o", "r.asperity"],
                          ["surface", "flat", "-o", "s.gsf"], ["surface", "thesis", "-o", "s.exr"],
                          ["surface", "thesis", "-o", "s.txt"],
                          ["surface", "thesis", "--png", "s.png"]):
            with self.subTest(arguments):
                done = run(*arguments, preexec_fn=limit_files)
                self.assertEqual(done.returncode, 4, done.stderr)
                self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
                self.assert_files()

    def test_little_memory(self):
        """Not enough memory for the surface: error 5, and nothing is left."""
        def limit_memory():
            resource.setrlimit(resource.RLIMIT_AS, (2 << 30, 2 << 30))

        done = run("simulate", "--size", "32768", "--quiet", "-o", "r.asperity",
                   preexec_fn=limit_memory)
        self.assertEqual(done.returncode, 5, done.stderr)
        self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
        self.assert_files()

    def test_layers_set_by_the_lobe(self):
        common = ["simulate", "--surface", "gaussian:size=16", "--layers", "auto", "--rays", "500",
                  "--resolution", "8"]
        done = run(*common, "-o", "r.asperity", "--json", "--quiet")
        self.assertEqual(done.returncode, 0, done.stderr)
        chosen = json.loads(done.stdout)["experiment"]["theta"]
        self.assertEqual(chosen[0], 0)
        self.assertGreater(chosen[-1], 89.5)
        # The result is the one of its angles, and goes on as either
        self.assertEqual(run(*common, "-o", "r.asperity", "--resume", "--quiet").returncode, 0)
        other = run("simulate", "--surface", "gaussian:size=16", "--layers", "15", "--rays", "500",
                    "--resolution", "8", "-o", "r.asperity", "--resume", "--quiet")
        self.assertEqual(other.returncode, 3, other.stderr)
        # Models have no surface that would say which
        done = run("compare", "ggx:alpha=0.3", "beckmann:alpha=0.3", "--layers", "auto")
        self.assertEqual(done.returncode, 2)
        self.assertEqual(done.stderr.count("\n"), 1, done.stderr)


if __name__ == "__main__":
    sys.exit(main())
