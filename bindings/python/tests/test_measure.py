# SPDX-License-Identifier: Apache-2.0
"""measure(): the program's bits, arrays, stopping, threads and processes."""
import concurrent.futures
import gc
import json
import multiprocessing
import os
import pickle
import resource
import signal
import subprocess
import sys
import threading
import time

import asperity
import numpy as np
import pytest
from asperity import ErrorCode

from test_surfaces import refused


def test_the_same_checksum_as_the_program(program, tmp_path):
    cases = [
        ("gaussian:alpha=0.3,size=64", dict(material="Au", theta_deg=[0, 45], resolution=32),
         ["--material", "Au", "--theta", "0,45", "--resolution", "32"]),
        ("thesis:roughness=0.4,size=32", dict(layers=3, resolution=16, seed=7, bounces=4, isotropic=True),
         ["--layers", "3", "--resolution", "16", "--seed", "7", "--bounces", "4", "--isotropic"]),
        ("ggx:alpha=0.2,size=64", dict(f0=[0.9, 0.5, 0.1], theta_deg=30, phi_deg=[0, 90], until=0.01, orders=1,
                                       detector="equal-area", resolution=16, launch="random"),
         ["--f0", "0.9,0.5,0.1", "--theta", "30", "--phi", "0,90", "--until", "0.01", "--orders", "1",
          "--detector", "equal-area", "--resolution", "16", "--launch", "random"])]
    for spec, keywords, options in cases:
        told = subprocess.run([program, "simulate", "--surface", spec, "--json", "--reference", "none", *options],
                              check=True, capture_output=True, text=True).stdout
        m = asperity.measure(asperity.surface(spec), **keywords)
        assert m.checksum == json.loads(told)["checksum"], spec
    # A file's surface, too, and a result that the program reads
    path = tmp_path / "s.gsf"
    asperity.gaussian(size=32).save(path)
    told = subprocess.run([program, "simulate", "--surface", path, "--theta", "10", "--json", "--reference", "none"],
                          check=True, capture_output=True, text=True).stdout
    m = asperity.measure(asperity.read(path), theta_deg=10)
    assert m.checksum == json.loads(told)["checksum"]
    assert m.save(tmp_path / "m.asperity") == m.checksum
    info = subprocess.run([program, "info", tmp_path / "m.asperity", "--json"], check=True, capture_output=True,
                          text=True).stdout
    assert json.loads(info)["checksum"] == m.checksum


def test_threads_change_nothing(rough):
    results = [asperity.measure(rough, theta_deg=[0, 60], resolution=16, threads=t).checksum for t in (1, 2, 5)]
    assert len(set(results)) == 1
    with concurrent.futures.ThreadPoolExecutor(4) as pool:
        again = list(pool.map(lambda _: asperity.measure(rough, theta_deg=[0, 60], resolution=16).checksum, range(8)))
    assert set(again) == set(results)


def test_arrays_have_their_axes_and_add_up(gold):
    assert gold.brdf.shape == gold.stderr.shape == (3, 3, 16, 32)
    assert gold.brdf_by_order.shape == (3, 2, 3, 16, 32)
    assert gold.albedo.shape == gold.albedo_stderr.shape == (3, 3)
    assert gold.albedo_by_bounce.shape == (3, 3, 16)
    assert gold.energy(0).shape == (2, 3, 16, 32) and gold.energy(0).dtype == np.uint64
    np.testing.assert_array_equal(gold.theta_deg, [0, 30, 60])
    assert gold.channel_names == ["R", "G", "B"]
    # f integrated with its cosine is the albedo; the cells are pi together
    albedo = (gold.brdf * gold.projected_solid_angle[:, None]).sum(axis=(2, 3))
    np.testing.assert_allclose(albedo, gold.albedo, rtol=1e-12)
    assert gold.projected_solid_angle.sum() * 32 == pytest.approx(np.pi, rel=1e-14)
    np.testing.assert_allclose(gold.brdf_by_order.sum(axis=1), gold.brdf, rtol=1e-12)
    np.testing.assert_allclose(gold.albedo + gold.absorbed + gold.truncated + gold.edge, 1, rtol=1e-12)
    np.testing.assert_allclose(gold.albedo_by_bounce.sum(axis=2), gold.albedo, rtol=1e-12)
    rays = gold.rays[1].astype(float)
    np.testing.assert_allclose(gold.energy(1)[:, 2].sum() / 2**32 / rays, gold.albedo[1, 2], rtol=1e-12)
    assert gold.theta_edges_deg[[0, -1]].tolist() == [0, 90] and gold.phi_edges_deg[-1] == pytest.approx(360)
    assert gold.experiment["material"] == "Au"
    for array in (gold.brdf, gold.energy(0), gold.albedo):
        with pytest.raises(ValueError):
            array[...] = 0
    with pytest.raises(IndexError):
        gold.energy(3)


def test_a_class_of_surfaces_tells_what_its_rays_add():
    settings = dict(theta_deg=30, material="Au", resolution=16)
    rough = asperity.gaussian(size=64, alpha=0.3)
    m = asperity.measure(rough, surfaces=20, **settings)
    assert m.batches.tolist() == [20] and m.experiment["surfaces"] == "20"
    assert (m.albedo_stderr_rays < m.albedo_stderr).all() and m.stderr_rays.shape == m.stderr.shape
    assert 0 < (m.stderr_rays**2).sum() < 0.5 * (m.stderr**2).sum()
    assert asperity.measure(rough, surfaces="auto", **settings).batches.tolist() == [16]
    one = asperity.measure(rough, **settings)
    np.testing.assert_array_equal(one.stderr_rays, one.stderr)
    with pytest.raises(asperity.Error, match="surface"):
        asperity.measure(asperity.from_array(rough.heights), surfaces=4, **settings)


def test_a_flat_mirror_sends_light_where_a_mirror_does():
    m = asperity.measure(asperity.flat(size=16), theta_deg=[22, 52], phi_deg=33, resolution=36, rays=1000)
    for k, theta in enumerate((22, 52)):
        row, column = np.unravel_index(m.brdf[k, 0].argmax(), (18, 36))
        assert m.theta_edges_deg[row] <= theta < m.theta_edges_deg[row + 1]
        assert m.phi_edges_deg[column] <= 213 < m.phi_edges_deg[column + 1]
        assert m.albedo[k, 0] == 1 and np.count_nonzero(m.brdf[k, 0]) == 1


def test_layers_are_found_by_their_angle(gold):
    assert gold.layer(30) == 1 and gold.layer(60.2) == 2
    refused(lambda: gold.layer(45), ErrorCode.USAGE, "0, 30, 60")


def test_wrong_settings_are_told(rough):
    for keywords, words in (({"theta": 30}, "did you mean 'theta_deg'?"), ({"seeds": 1}, "did you mean 'seed'?"),
                            ({"alpha": 1}, "no such keyword"), ({"theta_deg": 95}, "95"),
                            ({"rays": 1e30}, "rays"), ({"material": "Xx"}, "Xx"), ({"until": "lots"}, "lots"),
                            ({"f0": 0.5, "material": "Au"}, "f0"), ({"threads": 2.5}, "threads"),
                            ({"progress": 3}, "progress"), ({"stop": 1}, "stop")):
        refused(lambda: asperity.measure(rough, **keywords), ErrorCode.USAGE, words)
    refused(lambda: asperity.measure(np.zeros((8, 8))), ErrorCode.USAGE, "from_array")
    refused(lambda: asperity.load(__file__), ErrorCode.INVALID_INPUT, "test_measure.py")
    refused(lambda: asperity.load("/nowhere/m.asperity"), ErrorCode.INPUT_OUTPUT)


def test_results_come_back(gold, tmp_path):
    gold.save(tmp_path / "m.asperity")
    for back in (asperity.load(tmp_path / "m.asperity"), pickle.loads(pickle.dumps(gold))):
        assert back == gold and back.checksum == gold.checksum
        np.testing.assert_array_equal(back.brdf, gold.brdf)
        np.testing.assert_array_equal(back.stderr, gold.stderr)
    assert "3 layers" in repr(gold) and "±" in gold._repr_html_()
    assert gold._repr_png_().startswith(b"\x89PNG")


def test_progress_is_told(large):
    heard = []
    asperity.measure(large, theta_deg=[30], jitter=16, bounces=8, progress=heard.append)
    assert heard[-1].done == heard[-1].total > 0 and heard[-1].stage == "tracing"
    done = [p.done for p in heard if p.stage == "tracing"]
    assert done == sorted(done) and 0 <= heard[0].share <= 1


def test_what_a_callback_raises_comes_out(large):
    def complain(_):
        raise LookupError("enough")

    with pytest.raises(LookupError, match="enough"):
        asperity.measure(large, theta_deg=[30], rays=10**9, progress=complain)


def stopped_after(run):
    """Seconds from the wish to stop to the return, the best of three: other tests run beside this one."""
    return min(run() for _ in range(3))


class Watch:
    """A progress listener that calls `act` once, when a few batches of a layer are done."""

    def __init__(self, act=lambda: None):
        self.act, self.enough, self.when = act, False, 0.0

    def __call__(self, progress):
        if not self.enough and progress.stage == "tracing" and progress.done > 5_000_000:
            self.enough, self.when = True, time.perf_counter()
            self.act()


def test_stop_gives_what_is_complete(large):
    def run():
        watch = Watch()
        m = asperity.measure(large, theta_deg=[0, 30], rays=10**9, batches=4096, progress=watch,
                             stop=lambda: watch.enough)
        seconds = time.perf_counter() - watch.when
        assert m.stopped and m.layers >= 1 and 0 < m.rays[0] < 10**9
        np.testing.assert_allclose(m.albedo + m.absorbed + m.truncated + m.edge, 1, rtol=1e-12)
        return seconds

    assert stopped_after(run) < 0.1
    refused(lambda: asperity.measure(large, theta_deg=[0], rays=10**9, stop=lambda: True), ErrorCode.STOPPED)


def test_ctrl_c_gives_what_is_complete(large):
    def run():
        watch = Watch(lambda: threading.Timer(0.01, os.kill, (os.getpid(), signal.SIGINT)).start())
        with pytest.warns(asperity.StoppedWarning):
            m = asperity.measure(large, theta_deg=[0], rays=10**9, batches=4096, progress=watch)
        assert m.stopped and m.rays[0] < 10**9
        return time.perf_counter() - watch.when - 0.01

    assert stopped_after(run) < 0.1
    with pytest.raises(KeyboardInterrupt):
        threading.Timer(0.02, os.kill, (os.getpid(), signal.SIGINT)).start()
        asperity.measure(large, theta_deg=[0], rays=10**9, batches=2)


def test_stop_ends_an_export_and_a_fit(gold, tmp_path):
    def run():
        asked = []

        def stop():
            asked.append(time.perf_counter())
            return True

        refused(lambda: gold.export(tmp_path / "a.xml", "klems", stop=stop), ErrorCode.STOPPED, "stopped")
        return time.perf_counter() - asked[0]

    assert stopped_after(run) < 0.1 and not list(tmp_path.iterdir())
    refused(lambda: asperity.fit(gold, "all", stop=lambda: True), ErrorCode.STOPPED, "fitting")
    with pytest.raises(KeyboardInterrupt):
        threading.Timer(0.05, os.kill, (os.getpid(), signal.SIGINT)).start()
        gold.export(tmp_path / "a.xml", "klems")
    assert not list(tmp_path.iterdir())


def test_others_run_while_it_measures(large):
    turns = 0
    done = threading.Event()

    def count():
        nonlocal turns
        while not done.is_set():
            turns += 1
            time.sleep(0.001)

    thread = threading.Thread(target=count)
    thread.start()
    begin = time.perf_counter()
    asperity.measure(large, theta_deg=[30], jitter=32)
    seconds = time.perf_counter() - begin
    done.set()
    thread.join()
    assert turns > 50 * seconds


def test_views_outlive_their_measurement(rough):
    view = asperity.measure(rough, theta_deg=[0], resolution=16).energy(0)
    kept = view.copy()
    gc.collect()
    asperity.measure(rough, theta_deg=[50], resolution=16)
    np.testing.assert_array_equal(view, kept)


def test_memory_does_not_grow():
    surface = asperity.flat(size=4)

    def measure():
        m = asperity.measure(surface, theta_deg=[0], resolution=8, rays=16, batches=2, threads=1)
        m.brdf, m.energy(0), m.checksum

    for _ in range(100):
        measure()
    gc.collect()
    before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    for _ in range(1000):
        measure()
    gc.collect()
    assert resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before < 4096  # KiB


def checksum_of(surface):
    return asperity.measure(surface, theta_deg=[0, 60], resolution=16, threads=2).checksum


@pytest.mark.parametrize("method", ["fork", "spawn"])
@pytest.mark.filterwarnings("ignore:.*fork:DeprecationWarning")
def test_other_processes_get_the_same(rough, method):
    expected = checksum_of(rough)  # threads are there already when it forks
    with multiprocessing.get_context(method).Pool(2) as pool:
        assert pool.map_async(checksum_of, [rough] * 4).get(timeout=60) == [expected] * 4


def loaded_by(code):
    """What Python has loaded after some lines that it had not before."""
    told = subprocess.run([sys.executable, "-c", f"import sys; before = set(sys.modules)\n{code}\nprint(*set(sys.modules) - before)"],
                          check=True, capture_output=True, text=True).stdout
    return set(told.split())


def test_it_is_quickly_there():
    """The import loads the extension module, not even NumPy; to make a surface takes NumPy and no more."""
    loaded = loaded_by("import asperity")
    assert {name for name in loaded if name.startswith("asperity")} == {"asperity", "asperity._core", "asperity._errors"}
    assert not loaded & {"numpy", "typing", "re", "inspect", "dataclasses", "pathlib", "json", "ctypes", "subprocess"}
    loaded = loaded_by("import numpy, numpy.typing, sys; before = set(sys.modules); import asperity; asperity.flat(size=4)")
    assert not loaded & {"json", "subprocess", "tempfile", "shutil", "pathlib", "hashlib", "html", "csv", "difflib", "queue",
                         "multiprocessing", "concurrent.futures", "matplotlib", "xarray", "asperity._sweep"}


def test_what_was_done_is_not_done_again(rough, large):
    options = dict(theta_deg=[0, 40], resolution=16, rays=100_000)
    whole = asperity.measure(rough, **options)
    parts = [asperity.measure(rough, **options, part=f"{k}/3") for k in (2, 3, 1)]
    assert asperity.merge(parts).checksum == whole.checksum
    refused(lambda: asperity.merge(parts[:2]), ErrorCode.INVALID_INPUT)
    refused(lambda: asperity.merge([parts[0], parts[0]]), ErrorCode.INVALID_INPUT)
    refused(lambda: asperity.measure(rough, **options, part="0/3"), ErrorCode.USAGE, "K/N")
    # Stopped, and gone on with
    options = dict(theta_deg=[0, 40], resolution=16, rays=2**22, batches=256, bounces=4)
    begin = time.perf_counter()
    stopped = asperity.measure(large, **options, stop=lambda: time.perf_counter() - begin > 0.3)
    done = asperity.measure(large, **options, so_far=stopped)
    assert not done.stopped and done.checksum == asperity.measure(large, **options).checksum
    refused(lambda: asperity.measure(rough, **options, so_far=stopped), ErrorCode.INVALID_INPUT)
    refused(lambda: asperity.measure(rough, so_far=3), ErrorCode.USAGE, "no Measurement")
