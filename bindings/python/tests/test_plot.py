# SPDX-License-Identifier: Apache-2.0
"""Plots and labelled arrays."""
import asperity
import numpy as np
import pytest
from asperity import ErrorCode
from matplotlib import pyplot

from test_surfaces import refused


@pytest.fixture(autouse=True)
def no_windows(monkeypatch):
    monkeypatch.setattr(pyplot, "show", lambda *_: pytest.fail("a plot called show()"))
    yield
    pyplot.close("all")


def test_a_lobe_shows_the_measured_values(gold):
    artists = gold.plot.lobe(30, overlays={"GGX": "ggx:alpha=0.3,material=Au"}, channel="G", sigmas=2)
    measured, band, model, mark = artists
    theta, f = measured.get_data()
    assert len(theta) == 32 and theta[0] == -theta[-1] and np.all(np.diff(theta) > 0)
    # At the horizon the strip is the cells beside the plane, columns 15 and 16, but for the last percent
    assert f[-1] == pytest.approx(gold.brdf[1, 1, 15, 15:17].mean(), rel=0.01)
    upper = band.get_paths()[0].vertices[:, 1].max()
    assert upper > f.max() or np.isclose(upper, f.max(), rtol=0.2)
    assert model.get_label() == "GGX" and mark.get_xdata()[0] == 30
    axes = measured.axes
    assert axes.get_xlim() == (-90, 90) and "1/sr" in axes.get_ylabel()


def test_lobes_of_all_sorts(gold):
    _, ax = pyplot.subplots()
    artists = asperity.plot.lobe(gold, [0, 60], overlays=[gold, "lambert:albedo=1"], cosine=True, scale="log", ax=ax)
    assert all(a.axes is ax for a in artists) and ax.get_yscale() == "log"
    polar = gold.plot.lobe(60, polar=True)
    assert polar[0].axes.name == "polar" and polar[0].get_xdata().max() < np.pi / 2
    refused(lambda: gold.plot.lobe(30, polar=True, ax=ax), ErrorCode.USAGE, "polar")
    refused(lambda: gold.plot.lobe(31), ErrorCode.USAGE, "31")
    refused(lambda: gold.plot.lobe(30, channel="X"), ErrorCode.USAGE, "R, G, B")
    refused(lambda: gold.plot.lobe(30, scale="cubic"), ErrorCode.USAGE, "cubic")


def test_other_plots(gold, rough):
    mesh = gold.plot.hemisphere(60, channel="R")
    assert mesh.get_array().size == 16 * 32
    top = gold.brdf[2, 0].max()
    assert mesh.norm.vmax <= top
    artists = gold.plot.albedo(overlays="beckmann:alpha=0.3,material=Au")
    assert len(artists) == 4 + 1 + 1
    np.testing.assert_allclose(artists[4].lines[0].get_ydata(), gold.albedo.mean(axis=1))
    image = rough.plot()
    assert image.get_extent() == (0, 64, 64, 0) or list(image.get_extent()) == [0, 64, 64, 0]
    texts = [t.get_text() for t in image.axes.texts]
    assert texts == ["20 cells"]
    micro = asperity.from_array(np.array(rough.heights) * 0.1, spacing=0.5, unit="um", tiling="periodic").plot()
    assert [t.get_text() for t in micro.axes.texts] == ["10 µm"]
    stairs, beckmann, ggx = rough.plot_normals(bins=30)
    assert beckmann.get_label() == "Beckmann, α = 0.3"
    # cos-weighted means over 3 degrees: sum D cos dw = 1
    edges = np.radians(np.linspace(0, 90, 31))
    projected = np.pi * (np.sin(edges[1:]) ** 2 - np.sin(edges[:-1]) ** 2)
    for density in (stairs.get_data().values, beckmann.get_ydata(), ggx.get_ydata()):
        assert (density * projected).sum() == pytest.approx(1, abs=1e-6)


def test_styles_and_files(gold, tmp_path):
    sizes = []
    for name in ("light", "dark"):
        with asperity.plot.style(name):
            figure, ax = pyplot.subplots()
            gold.plot.lobe(30, ax=ax)
            figure.savefig(tmp_path / f"{name}.png")
        sizes.append((tmp_path / f"{name}.png").read_bytes())
    assert all(s.startswith(b"\x89PNG") for s in sizes) and sizes[0] != sizes[1]
    refused(lambda: asperity.plot.use_style("blue"), ErrorCode.USAGE, "blue")


def test_xarray_keeps_names_units_and_errors(gold, rough):
    ds = gold.to_xarray()
    assert ds.brdf.dims == ("theta_i", "phi_i", "channel", "theta_o", "phi_o")
    assert ds.brdf.attrs["units"] == "sr-1" and ds.theta_i.attrs["units"] == "degrees"
    np.testing.assert_array_equal(ds.brdf.sel(theta_i=30, phi_i=0, channel="G"), gold.brdf[1, 1])
    np.testing.assert_array_equal(ds.stderr.sel(theta_i=60, phi_i=0), gold.stderr[2])
    np.testing.assert_allclose((ds.brdf * ds.projected_solid_angle).sum(["theta_o", "phi_o"]), ds.albedo, rtol=1e-12)
    assert ds.attrs["checksum"] == gold.checksum and "material = Au" in ds.attrs["experiment"]
    import xarray

    back = xarray.Dataset.from_dict(ds.to_dict())
    assert back.identical(ds)
    many = asperity.measure(rough, theta_deg=[20, 40], phi_deg=[0, 90], material="Au", wavelengths=[500, 600],
                            resolution=8, rays=1000)
    ds = many.to_xarray()
    assert ds.sizes["theta_i"] == 2 and ds.sizes["phi_i"] == 2 and ds.wavelength.values.tolist() == [500, 600]
    k = many.layer(40, 90)
    np.testing.assert_array_equal(ds.brdf.sel(theta_i=40, phi_i=90), many.brdf[k])
