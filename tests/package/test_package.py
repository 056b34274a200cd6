# SPDX-License-Identifier: Apache-2.0
"""Debian packages: made by CPack from the build, unpacked by dpkg, used from where they lie."""
import glob
import os
import re
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree as ElementTree

BUILD, SOURCE, VERSION = sys.argv[1:4]
RESULT = ["simulate", "--surface", "gaussian", "--size", "32", "--rays", "2000", "--resolution", "16"]


def said(*command, **options):
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                          timeout=300, check=False, **options)
    assert done.returncode == 0, f"{command}: {done.stdout}{done.stderr}"
    return done.stdout


class Package(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.folder.cleanup)
        made, cls.root = os.path.join(cls.folder.name, "made"), os.path.join(cls.folder.name, "root")
        # What is packed is under test, not how small: the quickest compression
        said("cpack", "--config", f"{BUILD}/CPackConfig.cmake", "-B", made,
             "-D", "CPACK_DEBIAN_COMPRESSION_TYPE=gzip", "-D", "CPACK_THREADS=0")
        cls.packages = {}
        for path in glob.glob(f"{made}/*.deb"):
            said("dpkg", "-x", path, cls.root)
            cls.packages[said("dpkg-deb", "-f", path, "Package").strip()] = path

    def field(self, package, name):
        return said("dpkg-deb", "-f", self.packages[package], name).strip()

    def files(self, package):
        lines = said("dpkg-deb", "-c", self.packages[package]).splitlines()
        return [line.split()[5][1:] for line in lines if not line.endswith("/")]

    def test_packages_say_what_they_are_and_need(self):
        self.assertLessEqual({"asperity", "libasperity-dev"}, set(self.packages))
        for package in self.packages:
            with self.subTest(package):
                self.assertEqual(self.field(package, "Version"), VERSION + "-1")
                self.assertIn("gonioreflectometer", self.field(package, "Description"))
                with open(f"{self.root}/usr/share/doc/{package}/copyright", encoding="utf-8") as file:
                    self.assertIn("Apache License", file.read())
        # Found by dpkg-shlibdeps in what the program links
        for library in ("libc6", "libtbb12", "libembree3-3", "libpng16-16"):
            self.assertRegex(self.field("asperity", "Depends"), rf"\b{re.escape(library)}\b")
        # The archives of the library name these when they are linked
        with open(f"{SOURCE}/tools/apt.txt", encoding="utf-8") as file:
            known = {line.split()[0] for line in file if line.strip() and line[0] != "#"}
        needs = {name.strip() for name in self.field("libasperity-dev", "Depends").split(",")}
        self.assertLessEqual(needs, known)

    def test_the_program_runs_from_there(self):
        program = f"{self.root}/usr/bin/asperity"
        self.assertEqual(said(program, "--version"), f"asperity {VERSION}\n")
        path = os.path.join(self.folder.name, "r.asperity")
        said(program, *RESULT, "-o", path)
        again = said(f"{BUILD}/apps/cli/asperity", "info", path)
        self.assertEqual(said(program, "info", path), again)

    @unittest.skipIf(os.geteuid() != 0, "dpkg gives files to root")
    def test_installed_run_and_removed(self):
        """By dpkg itself, into a root that holds nothing else."""
        root = os.path.join(self.folder.name, "clean")
        for folder in ("info", "updates", "triggers"):
            os.makedirs(f"{root}/var/lib/dpkg/{folder}")
        for file in ("status", "available"):
            with open(f"{root}/var/lib/dpkg/{file}", "w", encoding="utf-8"):
                pass
        # What they depend on stands outside of that root
        dpkg = ["dpkg", f"--root={root}", "--force-depends"]
        said(*dpkg, "-i", *self.packages.values())
        self.assertEqual(said(f"{root}/usr/bin/asperity", "--version"), f"asperity {VERSION}\n")
        said(*dpkg, "-r", *self.packages)
        left = [name for folder, _, names in os.walk(f"{root}/usr") for name in names]
        self.assertEqual(left, [])

    def test_manual(self):
        folder = f"{self.root}/usr/share/man/man1"
        verbs = re.findall(r"^  (\w+) ", said(f"{self.root}/usr/bin/asperity", "help"), re.M)
        pages = {"asperity.1"} | {f"asperity-{verb}.1" for verb in verbs if verb != "asperity"}
        self.assertIn("asperity-simulate.1", pages)
        others = {f"{package}.1" for package in ("asperity-studio", "asperity-mpi")
                  if package in self.packages}
        self.assertEqual(set(os.listdir(folder)), pages | others)
        for page in pages | others:
            done = subprocess.run(["groff", "-man", "-k", "-ww", "-z", f"{folder}/{page}"],
                                  stderr=subprocess.PIPE, check=True, text=True)
            self.assertEqual(done.stderr, "", page)

    def test_completion(self):
        script = f"{self.root}/usr/share/bash-completion/completions/asperity"
        ask = (f"source {script}; COMP_WORDS=(asperity simulate --material A); COMP_CWORD=3; "
               "_asperity; echo ${COMPREPLY[@]}")
        self.assertEqual(sorted(said("bash", "-c", ask).split()), ["Ag", "Al", "Au"])
        with open(f"{self.root}/usr/share/zsh/vendor-completions/_asperity", encoding="utf-8") as file:
            self.assertTrue(file.read().startswith("#compdef asperity\n"))

    def test_library(self):
        files = self.files("libasperity-dev")
        self.assertIn("/usr/include/asperity/asperity.h", files)
        self.assertTrue(any(name.endswith("/AsperityConfig.cmake") for name in files))
        self.assertTrue(any(name.endswith("/libasperity_gonio.a") for name in files))
        self.assertFalse([name for name in files if name.startswith("/usr/bin")])

    def test_studio(self):
        if "asperity-studio" not in self.packages:
            self.skipTest("the studio is not built")
        self.assertIn("libqt6widgets6", self.field("asperity-studio", "Depends"))
        with open(f"{self.root}/usr/share/applications/asperity-studio.desktop",
                  encoding="utf-8") as file:
            entry = dict(line.rstrip("\n").split("=", 1) for line in file if "=" in line)
        self.assertEqual(entry["Type"], "Application")
        self.assertTrue(os.access(f"{self.root}/usr/bin/{entry['Exec'].split()[0]}", os.X_OK))
        icon = f"{self.root}/usr/share/icons/hicolor/scalable/apps/{entry['Icon']}.svg"
        self.assertEqual(ElementTree.parse(icon).getroot().get("viewBox"), "0 0 128 128")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
