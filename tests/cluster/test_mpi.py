# SPDX-License-Identifier: Apache-2.0
"""asperity-mpi: the result of asperity simulate on any number of ranks, killed and resumed too."""
import os
import pathlib
import signal
import subprocess
import sys
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "cli"))
from program import ProgramTest, main  # noqa: E402

MPI = os.environ["ASPERITY_MPI"]
WORK = ["simulate", "--surface", "gaussian:alpha=0.3,size=128", "--theta", "0,50", "--material", "Au",
        "--resolution", "32", "--seed", "3"]
# Ranks of a machine that has fewer processors, as root too
RUN = ["mpirun", "--allow-run-as-root", "--oversubscribe", "--mca", "btl_vader_single_copy_mechanism",
       "none"]


def on_ranks(count, *arguments, **options):
    return subprocess.run([*RUN, "-n", str(count), *arguments], text=True, capture_output=True,
                          timeout=200, **options)


class Mpi(ProgramTest):
    def measured(self, count, *arguments):
        done = on_ranks(count, MPI, *arguments)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout

    def test_sums_over_ranks_in_pieces(self):
        for count in (1, 2, 3):
            done = on_ranks(count, os.environ["REDUCE_TEST"])
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)

    def test_any_number_of_ranks_gives_the_same(self):
        for more in ([], ["--until", "0.1%,60%"]):
            whole = self.json_of(*WORK, *more)["checksum"]
            for ranks, threads in ((1, 2), (2, 1), (3, 1)):
                out = self.measured(ranks, *WORK, *more, "--threads", str(threads), "-o",
                                    "r.asperity", "--checkpoint", "0.2")
                self.assertEqual(out.count("checksum"), 1)
                self.assertIn("checksum " + whole, out)
                self.assert_files("r.asperity")

    def test_a_killed_rank_ends_the_job_and_the_checkpoint_survives(self):
        work = [*WORK, "--jitter", "2500", "--batches", "256", "--threads", "1"]
        whole = self.json_of(*work[:-2])["checksum"]
        process = subprocess.Popen([*RUN, "-n", "2", MPI, *work, "-o", "r.asperity", "--checkpoint",
                                    "0.2"], text=True, stdout=subprocess.PIPE,
                                   stderr=subprocess.PIPE)
        for _ in range(400):
            if os.path.exists("r.asperity.checkpoint"):
                break
            time.sleep(0.02)
        ranks = subprocess.run(["pgrep", "-P", str(process.pid)], text=True, capture_output=True)
        os.kill(int(ranks.stdout.split()[-1]), signal.SIGKILL)
        _, err = process.communicate(timeout=60)
        self.assertNotEqual(process.returncode, 0)
        self.assertIn("signal 9", err)
        self.assert_files("r.asperity.checkpoint")
        out = self.measured(3, *work, "-o", "r.asperity", "--resume")
        self.assertIn("going on from r.asperity.checkpoint", out)
        self.assertIn("checksum " + whole, out)
        self.assert_files("r.asperity")

    def test_what_all_ranks_refuse_is_said_once(self):
        done = on_ranks(2, MPI, "simulate", "--surface", "gaussian:alpha=-1")
        self.assertEqual(done.returncode, 2)
        self.assertEqual(done.stderr.count("asperity-mpi: error:"), 1, done.stderr)


if __name__ == "__main__":
    main()
