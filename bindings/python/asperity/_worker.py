# SPDX-License-Identifier: Apache-2.0
"""A process of a sweep: python -m asperity._worker THREADS.

Reads a job a line, answers each with a line: "" for done, else what went wrong. Ends with its input, and gives up
what it is doing when that ends: a parent that was killed leaves nobody behind."""

from __future__ import annotations

import os
import select
import signal
import sys

from ._errors import Error
from ._jobs import Job, run_job


def main() -> None:
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # the parent decides
    threads = int(sys.argv[1])
    answers, sys.stdout = sys.stdout, sys.stderr

    def parent_is_gone() -> bool:
        # No job is sent while one is under way: what can be read is the end
        return bool(select.select([sys.stdin], [], [], 0)[0])

    while line := sys.stdin.readline():
        try:
            done = run_job(Job.from_json(line), threads, parent_is_gone)
        except Error as error:
            answers.write(str(error) + "\n")
        except MemoryError:
            answers.write("not enough memory\n")
        else:
            if not done:
                return
            answers.write("\n")
        answers.flush()


if __name__ == "__main__":
    try:
        main()
    except BrokenPipeError:
        os._exit(0)  # nobody hears any more, nor what Python would say of it
