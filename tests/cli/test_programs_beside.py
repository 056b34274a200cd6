# SPDX-License-Identifier: Apache-2.0
"""A verb that is a program of its own: asperity-WORD beside the program or on PATH."""
import os
import subprocess
import tempfile
import unittest
from pathlib import Path

PROGRAM = os.environ["ASPERITY"]


class ProgramsBeside(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.other = Path(self.folder.name) / "asperity-sweep"
        self.other.write_text("#!/bin/sh\nprintf '%s|' \"$@\"\nexit 7\n")
        self.other.chmod(0o755)

    def run_program(self, *arguments, path=""):
        return subprocess.run([PROGRAM, *arguments], capture_output=True, text=True,
                              env={**os.environ, "PATH": f"{path}:/usr/bin:/bin"})

    def test_becomes_it_with_what_follows(self):
        told = self.run_program("sweep", "a b", "--slurm", "3", path=self.folder.name)
        self.assertEqual((told.returncode, told.stdout), (7, "a b|--slurm|3|"))

    def test_without_it_says_where_it_comes_from(self):
        told = self.run_program("sweep", "a.toml")
        self.assertEqual(told.returncode, 2)
        self.assertIn("Python package", told.stderr)
        self.assertEqual(told.stderr.count("\n"), 1)

    def test_verbs_of_its_own_stay(self):
        self.other.rename(Path(self.folder.name) / "asperity-info")
        self.assertEqual(self.run_program("info", "/nowhere", path=self.folder.name).returncode, 4)
        self.assertEqual(self.run_program("--version", path=self.folder.name).returncode, 0)
        self.assertEqual(self.run_program("../sweep", path=self.folder.name).returncode, 2)


if __name__ == "__main__":
    unittest.main()
