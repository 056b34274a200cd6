# SPDX-License-Identifier: Apache-2.0
"""The scripts of examples/cluster do what docs/cluster.md says: one checksum, however it is divided."""
import os
import pathlib
import stat
import subprocess
import sys
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "cli"))
from program import PROGRAM, ProgramTest, main  # noqa: E402

from one_node_slurm import OneNodeSlurm, is_installed

MPI = os.environ.get("ASPERITY_MPI")
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
        if not is_installed():
            print("skipped: Slurm is not installed; tools/setup --cluster installs it")
            self.skipTest("Slurm is not installed")
        with OneNodeSlurm() as slurm:
            self.environment.update(SLURM_CONF=slurm["SLURM_CONF"])
            self.script("slurm.sh", "4", "r.asperity", *WORK)
            self.wait_for_file("r.asperity")
            self.assertEqual(self.checksum("r.asperity"), self.whole)
            self.check_task_that_fails()
            if MPI:
                self.check_mpi()

    def check_task_that_fails(self):
        """What depends on the parts never runs, and no result appears."""
        self.script("slurm.sh", "2", "never.asperity", *WORK[2:], "--surface", "no-such-kind")
        for _ in range(600):
            jobs = subprocess.run(["squeue", "--noheader", "--format=%r"], env=self.environment, text=True,
                                  capture_output=True, check=True).stdout.split()
            if jobs == ["DependencyNeverSatisfied"]:
                break
            time.sleep(0.1)
        self.assertEqual(jobs, ["DependencyNeverSatisfied"])
        self.assertFalse(os.path.exists("never.asperity"))

    def check_mpi(self):
        """Two ranks of one job. Root may be all there is where tests run, and mpirun asks about it."""
        os.symlink(MPI, "bin/asperity-mpi")
        root = {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}
        subprocess.run(["sbatch", "--ntasks=2", "--cpus-per-task=1", SCRIPTS / "slurm_mpi.sh", "-o", "m.asperity",
                        *WORK], env={**self.environment, **root}, check=True, capture_output=True, timeout=60)
        self.wait_for_file("m.asperity")
        self.assertEqual(self.checksum("m.asperity"), self.whole)

    def wait_for_file(self, name):
        for _ in range(1200):
            if os.path.exists(name):
                return
            time.sleep(0.1)
        jobs = subprocess.run(["squeue"], env=self.environment, text=True, capture_output=True).stdout
        logs = "".join(p.read_text() for p in sorted(pathlib.Path().glob("slurm-*.out")))
        self.fail(f"no {name} after two minutes\n{jobs}{logs}")


if __name__ == "__main__":
    main()
