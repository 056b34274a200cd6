# SPDX-License-Identifier: Apache-2.0
"""Sweeps: the same files and the same table, however often they were killed."""
import csv
import os
import pathlib
import random
import signal
import subprocess
import sys
import time

import asperity
import numpy as np
import pytest
from asperity import ErrorCode

from test_surfaces import refused

SMALL = {"surface": "gaussian", "size": 16, "theta_deg": [[0, 40]], "resolution": 8, "rays": 256, "batches": 2}


def contents(folder):
    return {p.name: p.read_bytes() for p in sorted(pathlib.Path(folder).iterdir()) if p.is_file()}


def checksums(folder):
    return {p.name: asperity.load(p).checksum for p in pathlib.Path(folder).glob("*.asperity")}


def test_every_combination_is_measured_once(tmp_path):
    heard = []
    s = asperity.sweep({**SMALL, "alpha": [0.1, 0.2, 0.3], "seed": [1, 2]}, tmp_path, progress=heard.append)
    assert len(s) == 6 and len(set(s.files)) == 6 and heard[-1].done == heard[-1].total == 6
    assert [e["alpha"] for e in s.experiments] == [0.1, 0.1, 0.2, 0.2, 0.3, 0.3]
    direct = asperity.measure(asperity.gaussian(size=16, alpha=0.2), theta_deg=[0, 40], resolution=8, rays=256, batches=2,
                              seed=2)
    assert s[3].checksum == direct.checksum
    assert [m.checksum for m in s][3] == direct.checksum
    with open(s.table_file, newline="") as file:
        rows = list(csv.DictReader(file))
    assert len(rows) == 6 * 2
    row = next(r for r in rows if r["experiment"] == "3" and float(r["theta_i_deg"]) == 40)
    assert float(row["albedo"]) == direct.albedo[1, 0] and row["checksum"] == direct.checksum
    assert float(row["surface_alpha_x"]) == direct.surface["alpha_x"]
    assert s.table["alpha"][0] == 0.1
    # What is there is not measured again
    before = {p: os.stat(p).st_mtime_ns for p in s.files}
    again = asperity.sweep({**SMALL, "alpha": [0.3, 0.1], "seed": [2]}, tmp_path)
    assert set(again.files) < set(before) and {p: os.stat(p).st_mtime_ns for p in s.files} == before
    artists = asperity.plot.curves(s, "alpha", by="theta_i_deg")
    assert len(artists) == 2


def test_the_table_as_parquet(tmp_path, monkeypatch):
    pq = pytest.importorskip("pyarrow.parquet")
    experiments = [{**SMALL, "theta_deg": [0, 40], "alpha": 0.2, "until": 0.5}, {**SMALL, "alpha": 1, "until": "0.5,0.9", "theta_deg": 7, "material": "Au"}]
    s = asperity.sweep(experiments, tmp_path, table="t.parquet")
    assert s.table_file == str(tmp_path / "t.parquet") and not (tmp_path / "sweep.csv").exists()
    back = pq.read_table(s.table_file)
    assert back.column_names == list(s.table) and back.num_rows == 2 + 3
    for name, values in s.table.items():
        there = back[name].to_pylist()
        if name in ("theta_deg", "until", "material"):  # a list and a number, and one that has none
            values = [None if v == "" else str(v) for v in values]
        assert there == values, name
    types = {f.name: str(f.type) for f in back.schema}
    assert (types["alpha"], types["size"], types["albedo"], types["surface"]) == ("double", "int64", "double", "string")
    meta = {f.name: f.metadata or {} for f in back.schema}
    assert meta["theta_deg"][b"unit"] == b"degrees" and meta["theta_i_deg"][b"unit"] == b"degrees"
    assert b"rough" in meta["alpha"][b"doc"].lower() or b"slope" in meta["alpha"][b"doc"].lower()
    assert back["material"].to_pylist() == [None, None, "Au", "Au", "Au"]
    # Afterwards, and the same bytes
    s.save_table(tmp_path / "again.parquet")
    assert (tmp_path / "again.parquet").read_bytes() == pathlib.Path(s.table_file).read_bytes()
    refused(lambda: asperity.sweep(SMALL, tmp_path, table="t.xlsx"), ErrorCode.USAGE, ".csv or .parquet")
    # Without pyarrow it is said before anything is measured
    monkeypatch.setitem(sys.modules, "pyarrow", None)
    error = refused(lambda: asperity.sweep(SMALL, tmp_path / "none", table="t.parquet"), ErrorCode.USAGE, "pyarrow")
    assert error.place.endswith("t.parquet") and not (tmp_path / "none").exists()


def test_a_damaged_or_foreign_file_is_measured_again(tmp_path):
    s = asperity.sweep({**SMALL, "alpha": [0.1, 0.2]}, tmp_path)
    right = checksums(tmp_path)
    a, b = (pathlib.Path(f) for f in s.files)
    a.write_bytes(a.read_bytes()[:-7])
    b.write_bytes(pathlib.Path(asperity.sweep({**SMALL, "alpha": 0.3}, tmp_path / "o").files[0]).read_bytes())
    asperity.sweep({**SMALL, "alpha": [0.1, 0.2]}, tmp_path)
    assert checksums(tmp_path) == right


def test_arrays_and_lists_of_experiments(tmp_path, rough):
    z = np.array(rough.heights)[:16, :16]
    one = {"surface": asperity.from_array(z), "theta_deg": 10, "resolution": 8, "rays": 100}
    two = {"surface": "thesis", "roughness": 0.1, "size": 16, "theta_deg": 10, "resolution": 8, "rays": 100}
    three = {**one, "surface": asperity.from_array(2 * z)}
    s = asperity.sweep([one, two, three, one], tmp_path, processes=2, threads=1)
    assert len(s) == 4 and len(set(s.files)) == 3
    assert s[0].checksum == asperity.measure(one["surface"], theta_deg=10, resolution=8, rays=100).checksum
    assert s[0] != s[2]


def test_wrong_experiments_are_told_before_any_is_measured(tmp_path):
    error = refused(lambda: asperity.sweep({**SMALL, "alpha": [0.1, -1]}, tmp_path), ErrorCode.USAGE, "alpha")
    assert error.place == "experiment 1" and not list(tmp_path.glob("*.asperity"))
    refused(lambda: asperity.sweep([{"alpha": 1}], tmp_path), ErrorCode.USAGE, "surface")
    refused(lambda: asperity.sweep({**SMALL, "alfa": 1}, tmp_path), ErrorCode.USAGE, "did you mean 'alpha'")
    refused(lambda: asperity.sweep({**SMALL, "alpha": []}, tmp_path), ErrorCode.USAGE, "empty")
    refused(lambda: asperity.sweep(SMALL, tmp_path, processes=0), ErrorCode.USAGE, "processes")


def test_one_that_fails_leaves_the_others(tmp_path):
    wrong = {"surface": str(tmp_path / "none.gsf"), "theta_deg": 10}
    experiments = [{**SMALL, "theta_deg": 5}, wrong, {**SMALL, "theta_deg": 6}]
    for options in ({"processes": 2, "threads": 1}, {}):
        error = refused(lambda: asperity.sweep(experiments, tmp_path / "s", **options), ErrorCode.INVALID_INPUT,
                        "1 of 3")
        assert error.place == "experiment 1"
    s = asperity.sweep(experiments, tmp_path / "s", on_error="keep")
    assert [bool(e) for e in s.errors] == [False, True, False] and "none.gsf" in s.errors[1]


def test_stop_keeps_what_is_complete(tmp_path):
    turns = iter(range(10**9))
    refused(lambda: asperity.sweep({**SMALL, "alpha": list(np.linspace(0.1, 1, 50))}, tmp_path,
                                   stop=lambda: next(turns) > 20), ErrorCode.STOPPED, "of 50")
    assert 0 < len(list(tmp_path.glob("*.asperity"))) < 50


SCRIPT = """
import asperity, numpy, sys
asperity.sweep({"surface": "gaussian", "size": 16, "theta_deg": [[0, 40]], "resolution": 8, "rays": 256,
                "batches": 2, "alpha": numpy.linspace(0.05, 1, 60), "seed": [1, 2, 3]}, sys.argv[1], processes=2)
"""


def children(pid):
    found = subprocess.run(["ps", "-o", "pid=", "--ppid", str(pid)], capture_output=True, text=True).stdout.split()
    return [int(p) for p in found]


def alive(pid):
    try:
        return "Z" not in pathlib.Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()[0]
    except OSError:
        return False


def test_killed_at_random_it_ends_with_the_same(tmp_path):
    """180 experiments in two processes, parent or worker killed five times, then left alone."""
    calm, wild = tmp_path / "calm", tmp_path / "wild"
    subprocess.run([sys.executable, "-c", SCRIPT, calm], check=True)
    rng = random.Random(5)
    left = []
    for turn in range(5):
        process = subprocess.Popen([sys.executable, "-c", SCRIPT, wild])
        time.sleep(0.5 + rng.random() * 0.5)
        workers = children(process.pid)
        if turn == 4 and workers:
            os.kill(workers[0], signal.SIGKILL)  # a worker alone: the sweep goes on without it
            assert process.wait(timeout=60) == 0
        else:
            process.kill()
            process.wait()
        left += workers
    subprocess.run([sys.executable, "-c", SCRIPT, wild], check=True)
    results = [n for n in contents(wild) if n.endswith(".asperity")]
    assert len(results) == 180
    assert checksums(wild) == checksums(calm)
    assert contents(wild)["sweep.csv"] == contents(calm)["sweep.csv"]
    deadline = time.monotonic() + 5
    while any(alive(p) for p in left) and time.monotonic() < deadline:
        time.sleep(0.05)
    assert not [p for p in left if alive(p)], "a worker outlived its parent"


def test_parts_make_the_whole(program, tmp_path):
    """As an array of Slurm jobs does it, from a file, each part a process of its own."""
    plan = tmp_path / "sweep.toml"
    plan.write_text('surface = "gaussian"\nsize = 16\ntheta_deg = [[0, 40]]\nresolution = 8\nrays = 256\nbatches = 2\n'
                    "alpha = [0.1, 0.2, 0.3]\nseed = [1, 2]\n")

    def asperity_sweep(folder, *options):
        return subprocess.run([program, "sweep", plan, folder, *options], capture_output=True, text=True)

    script = asperity_sweep(tmp_path / "parts", "--slurm", "4", "--threads", "2").stdout
    assert "#SBATCH --array=1-4" in script and "6 experiments" in script
    command = next(line for line in script.splitlines() if " --part " in line)
    for task in range(1, 5):
        subprocess.run(["bash", "-euc", command], check=True, capture_output=True,
                       env={**os.environ, "SLURM_ARRAY_TASK_ID": str(task)})
    assert len(checksums(tmp_path / "parts")) == 6 and not (tmp_path / "parts" / "sweep.csv").exists()
    before = contents(tmp_path / "parts")
    table = next(line for line in script.splitlines() if "the table:" in line).split("the table:")[1]
    subprocess.run(["bash", "-euc", table], check=True, capture_output=True)
    asperity.sweep({**SMALL, "alpha": [0.1, 0.2, 0.3], "seed": [1, 2]}, tmp_path / "whole")
    after = contents(tmp_path / "parts")
    assert {n: after[n] for n in before} == before
    assert after["sweep.csv"] == contents(tmp_path / "whole")["sweep.csv"]
    assert asperity_sweep(tmp_path / "parts", "--table", "t.parquet").returncode == 0
    assert (tmp_path / "parts" / "t.parquet").read_bytes()[:4] == b"PAR1"
    told = asperity_sweep(tmp_path, "--part", "5/4")
    assert told.returncode == 2 and "K/N" in told.stderr and told.stderr.count("\n") == 1
    plan.write_text("surface = ")
    told = asperity_sweep(tmp_path)
    assert told.returncode == 3 and "sweep.toml" in told.stderr
    plan.unlink()
    assert asperity_sweep(tmp_path).returncode == 4


@pytest.fixture(scope="module")
def cluster():
    """Two workers; one that is killed is started anew."""
    distributed = pytest.importorskip("distributed")
    with distributed.LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as cluster:
        yield cluster


@pytest.fixture
def client(cluster):
    import distributed

    with distributed.Client(cluster) as client:
        client.wait_for_workers(2)
        yield client


class KillOne:
    """A `stop` that kills a worker when it is asked for the third time."""

    def __init__(self, client):
        self.worker, self.asked = next(iter(client.run(os.getpid).values())), 0

    def __call__(self):
        self.asked += 1
        if self.asked == 3:
            os.kill(self.worker, signal.SIGKILL)
        return False


def test_on_dask(tmp_path, client):
    experiments = {**SMALL, "alpha": list(np.linspace(0.1, 1, 20))}
    there = asperity.sweep(experiments, tmp_path / "dask", client=client, stop=KillOne(client))
    here = asperity.sweep(experiments, tmp_path / "here")
    assert checksums(tmp_path / "dask") == checksums(tmp_path / "here")
    assert there.table == here.table


def test_one_measurement_on_dask(client):
    """In rounds until an error is reached, a worker killed meanwhile; and gone on with."""
    rough = asperity.thesis(size=96, roughness=0.5)
    settings = dict(theta_deg=[0, 50], material="Au", resolution=16, rays=50_000, bounces=4)
    fine, loose = (0.001, 0.15), (0.01, 0.5)
    here = asperity.measure(rough, **settings, until=fine)
    assert here.rays.max() > 100_000
    heard, kill = [], KillOne(client)
    there = asperity.measure(rough, **settings, until=fine, client=client, parts=6, progress=heard.append, stop=kill)
    assert kill.asked > 3 and not os.path.exists(f"/proc/{kill.worker}")
    assert there.checksum == here.checksum and there.notes == here.notes and not there.stopped
    assert heard[-1].stage == "parts" and heard[-1].done == heard[-1].total > 6
    np.testing.assert_array_equal(there.stderr, here.stderr)
    # To a looser error first, then the rest
    before = asperity.measure(rough, **settings, until=loose, client=client)
    assert asperity.measure(rough, **settings, until=fine, so_far=before, client=client, parts=3).checksum == here.checksum
    # An array of one's own, whose heights the workers get
    own = asperity.from_array(np.array(rough.heights)[:32, :32], tiling="mirror")
    assert asperity.measure(own, theta_deg=20, client=client).checksum == asperity.measure(own, theta_deg=20).checksum


def test_a_measurement_on_dask_stops(client):
    large = asperity.thesis(size=128, roughness=0.5)
    settings = dict(theta_deg=[0], resolution=16, rays=2**27, batches=256, bounces=4)
    heard, begin = [], []

    def enough():
        if heard and not begin:
            begin.append(time.perf_counter())
        return bool(heard)

    some = asperity.measure(large, **settings, client=client, parts=256, progress=heard.append, stop=enough)
    assert time.perf_counter() - begin[0] < 0.5  # of a cluster; other tests run beside this one
    assert some.stopped and some.layers == 1 and 0 < some.rays[0] < 2**27
    deadline = time.monotonic() + 5
    while any(client.processing().values()) and time.monotonic() < deadline:
        time.sleep(0.02)
    assert not any(client.processing().values()), "workers go on with what nobody wants"
    refused(lambda: asperity.measure(large, **settings, client=client, stop=lambda: True), ErrorCode.STOPPED, "anything")
    refused(lambda: asperity.measure(large, theta_deg=[0], part="1/2", client=client), ErrorCode.USAGE, "all parts")
    refused(lambda: asperity.measure(large, theta_deg=[0], parts=2), ErrorCode.USAGE, "client")
    refused(lambda: asperity.measure(large, theta_deg=[0], parts=0, client=client), ErrorCode.USAGE, "whole number")
    refused(lambda: asperity.measure(large, theta_deg=[0], until=3, client=client), ErrorCode.USAGE, "until")
