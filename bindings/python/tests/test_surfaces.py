# SPDX-License-Identifier: Apache-2.0
"""Surfaces: made, read, from arrays; what is refused, and how."""
import gc
import inspect
import pickle
import sys

import asperity
import numpy as np
import pytest
from asperity import ErrorCode


def refused(call, code, *words):
    with pytest.raises(asperity.Error) as caught:
        call()
    assert caught.value.code == code, caught.value
    for word in words:
        assert word in str(caught.value)
    assert "\n" not in str(caught.value)
    return caught.value


def test_every_kind_is_a_function_with_the_settings_of_the_table():
    table = asperity.settings()
    for kind, doc in asperity.surface_kinds().items():
        make = getattr(asperity, kind.replace("-", "_"))
        assert doc in make.__doc__
        names = [n for n in inspect.signature(make).parameters if n not in ("progress", "stop", "threads")]
        assert "size" in names and all(n in table for n in names)
        surface = make(size=32)
        assert surface.shape == (32, 32) and surface.periodic and surface.unit == "cell"


def test_settings_count():
    surface = asperity.gaussian(alpha=(0.1, 0.3), size=128, correlation_length=5.0, surface_seed=3, cell_size=0.5)
    assert surface.spacing == (0.5, 0.5)
    # RMS gradient is met exactly: sqrt((0.1^2 + 0.3^2) / 2)
    assert surface.statistics["rms_gradient"] == pytest.approx(np.sqrt(0.05), rel=1e-5)
    same = asperity.surface("gaussian:alpha=0.1/0.3,size=128", correlation_length="5", surface_seed=3, cell_size=0.5)
    np.testing.assert_array_equal(same.heights, surface.heights)
    other = asperity.gaussian(alpha=(0.1, 0.3), size=128, correlation_length=5.0, surface_seed=4, cell_size=0.5)
    assert not np.array_equal(other.heights, surface.heights)
    np.testing.assert_array_equal(asperity.gaussian(size=64, threads=1).heights,
                                  asperity.gaussian(size=64, threads=3).heights)


def test_numbers_of_numpy_are_numbers():
    a = asperity.gaussian(size=np.int64(32), alpha=np.float32(0.25), surface_seed=np.uint64(2**63))
    b = asperity.gaussian(size=32, alpha=0.25, surface_seed=2**63)
    np.testing.assert_array_equal(a.heights, b.heights)


@pytest.mark.parametrize(("typed", "meant"), [("alfa", "alpha"), ("seed", "surface_seed"), ("sizes", "size"),
                                              ("tilt", "tilt_deg"), ("height", "height_scale")])
def test_a_wrong_keyword_is_told_what_was_meant(typed, meant):
    make = asperity.vgroove if typed == "tilt" else asperity.gaussian
    error = refused(lambda: make(**{typed: 1}), ErrorCode.USAGE, f"did you mean {meant!r}?")
    assert error.place == typed


def test_wrong_values_name_their_setting():
    assert refused(lambda: asperity.gaussian(alpha=-1), ErrorCode.USAGE, "-1").place == "alpha"
    assert refused(lambda: asperity.gaussian(size=1.5), ErrorCode.USAGE, "whole number").place == "size"
    refused(lambda: asperity.gaussian(alpha=[0.1, 0.2, 0.3]), ErrorCode.USAGE, "more than 2")
    refused(lambda: asperity.gaussian(alpha=object()), ErrorCode.USAGE, "alpha")
    refused(lambda: asperity.gaussian(alpha=[]), ErrorCode.USAGE, "empty")
    refused(lambda: asperity.gaussian(size=10**9), ErrorCode.USAGE, "size")
    refused(lambda: asperity.gaussian(autocorrelation="bessel"), ErrorCode.USAGE, "bessel")
    refused(lambda: asperity.surface("gausian"), ErrorCode.USAGE, "gausian")
    refused(lambda: asperity.surface("flat", alpha=0.3), ErrorCode.USAGE, "does not use it")
    refused(lambda: asperity.gaussian(threads=0), ErrorCode.USAGE, "threads")
    refused(lambda: asperity.gaussian(hurst=0.5), ErrorCode.USAGE, "hurst")


def test_an_array_is_a_surface_whatever_its_layout(rough):
    z = np.array(rough.heights)
    made = asperity.from_array(z, tiling="periodic")
    np.testing.assert_array_equal(made.heights, z)
    big = np.zeros((128, 192), dtype=np.float32)
    big[::2, ::3] = z
    for other in (z.astype(np.float64), np.asfortranarray(z), big[::2, ::3], z[::-1][::-1], z.astype(">f4")):
        assert not other.flags.c_contiguous or other.dtype != np.float32 or other.base is not None
        np.testing.assert_array_equal(asperity.from_array(other, tiling="periodic").heights, z)
    whole = np.arange(12, dtype=np.int16).reshape(3, 4)
    np.testing.assert_array_equal(asperity.from_array(whole, tiling="finite").heights, whole)
    assert asperity.from_array(whole, tiling="finite").shape == (3, 4)


def test_units_and_spacing_become_metres():
    z = np.array([[0.0, 1.0], [2.0, 3.0], [4.0, 5.0]])
    micro = asperity.from_array(z, spacing=(0.2, 0.4), unit="um", tiling="finite")
    assert micro.unit == "m"
    assert micro.spacing == pytest.approx((2e-7, 4e-7), rel=1e-15)
    np.testing.assert_allclose(micro.heights, z * 1e-6, rtol=1e-6)
    nano = asperity.from_array(z * 1000, spacing=(200, 400), unit="nm", tiling="finite")
    np.testing.assert_allclose(nano.heights, micro.heights, rtol=1e-6)
    # Slopes have no unit: the same whatever the unit
    cells = asperity.from_array(z, spacing=(0.2, 0.4), tiling="finite")
    assert cells.statistics["rms_gradient"] == pytest.approx(micro.statistics["rms_gradient"], rel=1e-6)
    # dh/dx = 1 / 0.2, dh/dy = 2 / 0.4: the plane is tilted by atan(5 sqrt 2)
    assert cells.statistics["rms_gradient"] == pytest.approx(5 * np.sqrt(2), rel=1e-6)


def test_what_is_no_surface_is_refused():
    z = np.zeros((8, 8))
    hole = z.copy()
    hole[2, 3] = hole[4, 4] = np.nan
    refused(lambda: asperity.from_array(hole), ErrorCode.INVALID_INPUT, "2 of 64")
    masked = np.ma.masked_array(z, np.isnan(hole))
    refused(lambda: asperity.from_array(masked), ErrorCode.INVALID_INPUT, "2 of 64")
    infinite = z.copy()
    infinite[0, 0] = np.inf
    refused(lambda: asperity.from_array(infinite), ErrorCode.INVALID_INPUT)
    refused(lambda: asperity.from_array(1e300 * np.eye(8)), ErrorCode.INVALID_INPUT)
    refused(lambda: asperity.from_array(np.zeros((0, 0))), ErrorCode.INVALID_INPUT)
    refused(lambda: asperity.from_array(np.zeros((1, 8))), ErrorCode.INVALID_INPUT)
    refused(lambda: asperity.from_array(np.zeros((2, 40000))), ErrorCode.INVALID_INPUT)
    refused(lambda: asperity.from_array(np.zeros(8)), ErrorCode.USAGE, "no grid")
    refused(lambda: asperity.from_array(z.astype(complex)), ErrorCode.USAGE, "complex")
    refused(lambda: asperity.from_array([["a", "b"], ["c", "d"]]), ErrorCode.USAGE)
    assert refused(lambda: asperity.from_array(z, unit="inch"), ErrorCode.USAGE, "inch").place == "unit"
    for spacing in (0, -1, np.nan, (1, 2, 3)):
        assert refused(lambda: asperity.from_array(z, spacing=spacing), ErrorCode.USAGE).place == "spacing"
    refused(lambda: asperity.from_array(z, cell_size=2), ErrorCode.USAGE, "spacing=")


def test_heights_are_a_view_that_keeps_its_memory():
    heights = asperity.gaussian(size=64).heights
    gc.collect()
    asperity.gaussian(size=64, surface_seed=9)
    np.testing.assert_array_equal(heights, asperity.gaussian(size=64).heights)
    with pytest.raises(ValueError):
        heights[0, 0] = 1
    surface = asperity.gaussian(size=64)
    assert np.shares_memory(surface.heights, surface.heights)
    before = sys.getrefcount(surface)
    views = [surface.heights for _ in range(100)]
    assert sys.getrefcount(surface) == before
    del views
    assert np.asarray(surface).shape == (64, 64)


def test_files_come_back_and_say_what_they_are(tmp_path, rough):
    path = tmp_path / "s.gsf"
    rough.save(path)
    back = asperity.read(path)
    np.testing.assert_array_equal(back.heights, rough.heights)
    assert back.periodic and back.source
    np.testing.assert_array_equal(asperity.read(path, height_scale=2).heights, rough.heights * 2)
    (tmp_path / "bad.gsf").write_text("Gwyddion Simple Field 1.0\nXRes = 4\n")
    assert "bad.gsf" in refused(lambda: asperity.read(tmp_path / "bad.gsf"), ErrorCode.INVALID_INPUT).place
    refused(lambda: asperity.read(tmp_path / "none.gsf"), ErrorCode.INPUT_OUTPUT, "none.gsf")
    refused(lambda: asperity.read(path, alpha=1), ErrorCode.USAGE, "no such keyword")
    refused(lambda: rough.save(tmp_path / "no" / "folder.gsf"), ErrorCode.INPUT_OUTPUT)


def test_pickles_and_pictures(rough):
    back = pickle.loads(pickle.dumps(rough))
    np.testing.assert_array_equal(back.heights, rough.heights)
    assert (back.name, back.spacing, back.unit, back.periodic) == (rough.name, rough.spacing, rough.unit, True)
    assert "64 x 64" in repr(rough)
    assert "<table>" in rough._repr_html_() and "RMS height" in rough._repr_html_()
    assert rough._repr_png_().startswith(b"\x89PNG")
    error = pickle.loads(pickle.dumps(asperity.Error("m", ErrorCode.INPUT_OUTPUT, "p")))
    assert (str(error), error.code, error.place) == ("p: m", ErrorCode.INPUT_OUTPUT, "p")


def test_normals_are_a_distribution(rough):
    density = rough.normal_distribution(45, 8)
    assert density.shape == (45, 8)
    edges = np.radians(np.linspace(0, 90, 46))
    projected = (np.sin(edges[1:]) ** 2 - np.sin(edges[:-1]) ** 2) / 2 * 2 * np.pi / 8
    assert (density * projected[:, None]).sum() == pytest.approx(1, rel=1e-12)


def test_readers_of_surface_topography_are_tried_where_ours_do_not_know_a_file(tmp_path, monkeypatch):
    """Its package is not needed for it: what stands for it here has the members that are used."""
    import types

    class Topography:
        physical_sizes, nb_grid_pts, unit = (6.0, 2.0), (3, 2), "um"

        def heights(self):  # [x, y]
            return np.ma.masked_array([[0.0, 3.0], [1.0, 4.0], [2.0, 5.0]], self.hidden)

        hidden = False

    Topography.topography = lambda self: self
    module = types.ModuleType("SurfaceTopography")
    module.open_topography = lambda path: Topography()
    path = tmp_path / "a.unheard-of"
    path.write_bytes(b"\x00\x01 something else")
    refused(lambda: asperity.read(path), ErrorCode.INVALID_INPUT)
    monkeypatch.setitem(sys.modules, "SurfaceTopography", module)
    surface = asperity.read(path, tiling="finite")
    np.testing.assert_allclose(surface.heights, [[0, 1e-6, 2e-6], [3e-6, 4e-6, 5e-6]], rtol=1e-6)
    assert surface.spacing == pytest.approx((2e-6, 1e-6)) and "SurfaceTopography" in surface.source
    Topography.hidden = [[False, True], [False, False], [False, False]]
    refused(lambda: asperity.read(path, tiling="finite"), ErrorCode.INVALID_INPUT, "1 of 6")
    module.open_topography = lambda path: 1 / 0
    refused(lambda: asperity.read(path), ErrorCode.INVALID_INPUT, "unheard-of")
