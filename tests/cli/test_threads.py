# SPDX-License-Identifier: Apache-2.0
"""Where the system gives few threads or little memory, there are fewer, or a refusal with figures."""
import os
import resource
import shutil
import subprocess
import sys

from program import PROGRAM, SMALL, ProgramTest, main

NOBODY = 65534


def with_processes(count):
    """The child may have no more than so many threads; root's children become nobody's first, as
    root has no such limit."""
    def limit():
        if os.getuid() == 0:
            os.setgid(NOBODY)
            os.setuid(NOBODY)
        hard = resource.getrlimit(resource.RLIMIT_NPROC)[1]
        most = count if hard == resource.RLIM_INFINITY else min(count, hard)
        resource.setrlimit(resource.RLIMIT_NPROC, (most, hard))
    return limit


class FewThreads(ProgramTest):
    def test_as_many_as_there_can_be_give_the_same(self):
        # Where nobody may read and write
        os.chmod(".", 0o777)
        program = shutil.copy(PROGRAM, "program")
        os.chmod(program, 0o755)
        sums = set()
        for processes in (1, 2, 4, 100000):
            done = subprocess.run([os.path.abspath(program), "simulate", *SMALL, "--surface",
                                   "gaussian", "--threads", "8", "-o", f"{processes}.asperity"],
                                  stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                                  timeout=120, check=False, preexec_fn=with_processes(processes))
            self.assertEqual((done.returncode, done.stdout.count("checksum")), (0, 1), done.stderr)
            sums.add(done.stdout.split("checksum")[1])
        self.assertEqual(len(sums), 1)


class LittleMemory(ProgramTest):
    def test_refused_with_both_figures_before_it_starts(self):
        # 9000 layers of 8192 x 4096 cells and 4 orders: no machine has that
        text = self.fails(5, "simulate", "--surface", "flat", "--size", 16, "--layers", 9000,
                          "--resolution", 8192, "--rays", 10, "-o", "r.asperity")
        self.assertRegex(text, r"needs at least 169\d\d.\d GB of memory, \d+.* are free ")
        self.assert_files()


if __name__ == "__main__":
    sys.exit(main())
