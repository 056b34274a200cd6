# SPDX-License-Identifier: Apache-2.0
"""The scripts of examples/cluster do what docs/cluster.md says: one checksum, however it is divided."""
import os
import pathlib
import shutil
import stat
import subprocess
import sys
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "cli"))
from program import PROGRAM, ProgramTest, main  # noqa: E402

SCRIPTS = pathlib.Path(__file__).resolve().parents[2] / "examples" / "cluster"
WORK = ["--surface", "gaussian:alpha=0.3,size=64", "--theta", "0,50", "--material", "Au",
        "--resolution", "32", "--seed", "3"]

# A sbatch that does at once what it is given, as Slurm would: the tasks of an array one after the
# other, and then what depends on them.
SBATCH = """#!/usr/bin/env bash
set -euo pipefail
count=0
while [[ $1 == --* ]]; do
    case $1 in
        --array=1-*) count=${1#--array=1-} ;;
        --dependency=afterok:77) ;;
        --parsable) ;;
        *) echo "sbatch does not know $1" >&2; exit 2 ;;
    esac
    shift
done
if ((count)); then
    for ((k = 1; k <= count; ++k)); do
        SLURM_ARRAY_TASK_ID=$k SLURM_ARRAY_TASK_COUNT=$count SLURM_CPUS_PER_TASK=2 bash "$@"
    done
else
    bash "$@"
fi
echo 77
"""


class Scripts(ProgramTest):
    def setUp(self):
        super().setUp()
        os.mkdir("bin")
        os.symlink(PROGRAM, "bin/asperity")
        self.environment = dict(os.environ, PATH=f"{os.getcwd()}/bin:{os.environ['PATH']}")
        self.whole = self.json_of("simulate", *WORK)["checksum"]

    def script(self, name, *arguments):
        done = subprocess.run([SCRIPTS / name, *arguments], env=self.environment, text=True,
                              capture_output=True, timeout=200)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout

    def checksum(self, file):
        return self.json_of("info", file)["checksum"]

    def test_parallel(self):
        self.script("parallel.sh", "5", "r.asperity", *WORK)
        self.assertEqual(self.checksum("r.asperity"), self.whole)
        self.assert_files("bin", "r.asperity")

    def test_slurm_scripts_without_slurm(self):
        pathlib.Path("bin/sbatch").write_text(SBATCH)
        os.chmod("bin/sbatch", stat.S_IRWXU)
        self.script("slurm.sh", "4", "r.asperity", *WORK)
        self.assertEqual(self.checksum("r.asperity"), self.whole)
        self.assert_files("bin", "r.asperity")

    def test_slurm(self):
        if not shutil.which("sbatch") or subprocess.run(["sinfo"], capture_output=True).returncode:
            print("skipped: no Slurm runs here; tools/setup --cluster installs it")
            self.skipTest("no Slurm runs here")
        self.script("slurm.sh", "4", "r.asperity", *WORK)
        for _ in range(600):
            if os.path.exists("r.asperity"):
                break
            time.sleep(0.1)
        self.assertEqual(self.checksum("r.asperity"), self.whole)


if __name__ == "__main__":
    main()
