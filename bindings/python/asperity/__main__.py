# SPDX-License-Identifier: Apache-2.0
"""asperity sweep: sweeps from a file, in processes here or as an array of Slurm jobs.

The command asperity hands the verb over to the program asperity-sweep, which is this; python -m asperity sweep as well."""

from __future__ import annotations

import argparse
import os
import shlex
import sys
import tomllib

from ._errors import Error, ErrorCode
from ._sweep import Experiments, expand, sweep

_SCRIPT = """#!/bin/bash
# {count} experiments of {file} in {jobs} jobs; submit with: sbatch {name}
#SBATCH --job-name=asperity
#SBATCH --array=1-{jobs}
#SBATCH --cpus-per-task={threads}
#SBATCH --output={folder}/slurm-%A_%a.txt
# A job that was killed is simply submitted again: results that are there are not measured again.
{python} -m asperity sweep {file} {folder} --part "$SLURM_ARRAY_TASK_ID/{jobs}" --threads {threads}
# When all jobs are done, the table: {python} -m asperity sweep {file} {folder}
"""

_EPILOG = """\
FILE.toml has a keyword a line, a list being an axis:
    surface = "gaussian"
    alpha = [0.1, 0.2, 0.3]
    theta_deg = [[0, 30, 60]]
    material = "Au"
"""


def read_experiments(path: str) -> Experiments:
    """The experiments of a TOML file: keywords, or tables [[experiment]]."""
    try:
        with open(path, "rb") as file:
            content = tomllib.load(file)
    except OSError as error:
        raise Error(error.strerror or "cannot be read", ErrorCode.INPUT_OUTPUT, path) from None
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
        raise Error(str(error), ErrorCode.INVALID_INPUT, path) from None
    listed = content.get("experiment")
    if listed is None:
        return content
    if len(content) > 1 or not isinstance(listed, list):
        raise Error("has both keywords and tables [[experiment]]", ErrorCode.INVALID_INPUT, path)
    return [e for table in listed for e in expand(table)]


def slurm_script(path: str, folder: str, jobs: int, threads: int, name: str) -> str:
    """A script that a person can read and sbatch takes."""
    count = len(expand(read_experiments(path)))
    jobs = min(jobs, count)
    return _SCRIPT.format(count=count, jobs=jobs, threads=threads, name=name,
                          file=shlex.quote(os.path.abspath(path)), folder=shlex.quote(os.path.abspath(folder)),
                          python=shlex.quote(sys.executable))


def main(arguments: list[str] | None = None) -> int:
    parser = argparse.ArgumentParser("asperity", description=(__doc__ or "").split("\n")[0], epilog=_EPILOG,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    verbs = parser.add_subparsers(dest="verb", required=True)
    verb = verbs.add_parser("sweep", help="measure many experiments", epilog=_EPILOG,
                            formatter_class=argparse.RawDescriptionHelpFormatter)
    verb.add_argument("file", metavar="FILE.toml")
    verb.add_argument("folder", metavar="FOLDER", help="where results and the table go")
    verb.add_argument("--processes", type=int, default=1, help="at once, here")
    verb.add_argument("--threads", type=int, default=None, help="of each; no influence on the results")
    verb.add_argument("--part", metavar="K/N", default=None, help="only every N-th experiment, from the K-th on")
    verb.add_argument("--table", metavar="NAME", default="sweep.csv",
                      help="of the table: .csv, or .parquet, which needs pyarrow (default %(default)s)")
    verb.add_argument("--slurm", metavar="N", type=int, default=None,
                      help="measure nothing, print the script of an array of N Slurm jobs")
    options = parser.parse_args(arguments)
    try:
        if options.slurm is not None:
            if options.slurm < 1:
                raise Error(f"{options.slurm} is below 1", place="slurm")
            print(slurm_script(options.file, options.folder, options.slurm, options.threads or 1, "sweep.sh"), end="")
            return 0
        result = sweep(read_experiments(options.file), options.folder, processes=options.processes,
                       threads=options.threads, part=options.part, table=options.table,
                       progress=sys.stderr.isatty())
        print(f"{len(result)} experiments" + ("" if options.part else f", table {result.table_file}"))
    except Error as error:
        print(f"error: {error}", file=sys.stderr)
        return int(error.code)
    except KeyboardInterrupt:
        return int(ErrorCode.STOPPED)
    return 0


def sweep_program() -> int:
    """The program asperity-sweep."""
    return main(["sweep", *sys.argv[1:]])


if __name__ == "__main__":
    sys.exit(main())
