# SPDX-License-Identifier: Apache-2.0
"""Runs the program under test, whose path stands in the environment variable ASPERITY."""
import json
import os
import subprocess
import tempfile
import unittest

PROGRAM = os.path.abspath(os.environ.get("ASPERITY", "asperity"))

# Settings of a run that takes a moment.
# Of a made surface; SMALL[2:] of one from a file, which brings its size.
SMALL = ["--size", "64", "--rays", "2000", "--resolution", "16"]


def run(*arguments, **options):
    """The finished process; its output as text unless told otherwise."""
    options.setdefault("stdout", subprocess.PIPE)
    options.setdefault("stderr", subprocess.PIPE)
    return subprocess.run([PROGRAM, *map(str, arguments)], text=True, timeout=120, **options)


class ProgramTest(unittest.TestCase):
    """A test in an empty folder of its own."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.addCleanup(os.chdir, os.getcwd())
        os.chdir(folder.name)

    def passes(self, *arguments):
        """Runs, expects exit code 0, returns what was printed."""
        done = run(*arguments)
        self.assertEqual(done.returncode, 0, f"{arguments}: {done.stderr}")
        return done.stdout

    def json_of(self, *arguments):
        """The one JSON object the program prints."""
        return json.loads(self.passes(*arguments, "--json"))

    def fails(self, code, *arguments, saying=""):
        """Runs, expects this exit code (or one of them), one line of error and no output."""
        done = run(*arguments)
        codes = code if isinstance(code, tuple) else (code,)
        self.assertIn(done.returncode, codes, f"{arguments}: {done.stderr!r}")
        self.assertRegex(done.stderr, r"\Aasperity: error: [^\n]+[^.\n]\n\Z", arguments)
        self.assertIn(saying, done.stderr, arguments)
        return done.stderr

    def assert_files(self, *names):
        """These files, and no others, not even temporary ones, lie in the folder."""
        self.assertEqual(sorted(os.listdir(".")), sorted(names))


def main():
    unittest.main(verbosity=1)
