# SPDX-License-Identifier: Apache-2.0
"""lecture_strip.py PROGRAM SCRIPT: the script makes its pictures, and they are what they say."""
import os
import pathlib
import subprocess
import sys
import tempfile

PROGRAM, SCRIPT = map(os.path.abspath, sys.argv[1:])

with tempfile.TemporaryDirectory() as name:
    folder = pathlib.Path(name)
    (folder / "bin").mkdir()
    (folder / "bin" / "asperity").symlink_to(PROGRAM)
    environment = dict(os.environ, PATH=f"{folder}/bin:{os.environ['PATH']}")
    subprocess.run([SCRIPT, folder / "out", "16", "1"], env=environment, check=True)
    strip = (folder / "out" / "strip.png").read_bytes()
    width, height = (int.from_bytes(strip[at:at + 4], "big") for at in (16, 20))
    assert width >= 5 * 16 and height >= 2 * 16, (width, height)
    assert b"<svg" in (folder / "out" / "lobes.svg").read_bytes()
    assert len(list((folder / "out").glob("*.asperity"))) == 5
    usage = subprocess.run([SCRIPT], env=environment, text=True, capture_output=True)
    assert usage.returncode == 2 and "lecture_strip.sh FOLDER" in usage.stderr, usage
