# SPDX-License-Identifier: Apache-2.0
"""BSDFs as functions of arrays; comparison, exports, pictures; BSDFs of one's own."""
import pickle

import asperity
import numpy as np
import pytest
from asperity import ErrorCode

from test_surfaces import refused


def directions(count, seed=1):
    rng = np.random.default_rng(seed)
    z, phi = rng.uniform(0.05, 1, count), rng.uniform(0, 2 * np.pi, count)
    r = np.sqrt(1 - z * z)
    return np.stack([r * np.cos(phi), r * np.sin(phi), z], axis=-1)


def ggx(wi, wo, alpha):
    """Walter et al. 2007, equations 20, 33, 34 with Heitz 2014's height-correlated masking; F = 1."""
    wm = wi + wo
    wm /= np.linalg.norm(wm, axis=-1, keepdims=True)
    tan2 = 1 / wm[..., 2] ** 2 - 1
    d = 1 / (np.pi * alpha**2 * wm[..., 2] ** 4 * (1 + tan2 / alpha**2) ** 2)

    def smith(w):
        return (np.sqrt(1 + alpha**2 * (1 / w[..., 2] ** 2 - 1)) - 1) / 2

    return d / (1 + smith(wi) + smith(wo)) / (4 * wi[..., 2] * wo[..., 2])


class Phong:
    """One of a user: a normalised Phong lobe of one channel, F = 1."""

    isotropic = True

    def __init__(self, exponent):
        self.exponent, self.calls = exponent, 0

    def eval(self, wi, wo):
        self.calls += 1
        cos = np.clip(wi[:, 2] * wo[:, 2] - wi[:, 0] * wo[:, 0] - wi[:, 1] * wo[:, 1], 0, None)
        return (self.exponent + 2) / (2 * np.pi) * cos**self.exponent


class OfLibrary:
    """A model of the library in the clothes of a user's."""

    def __init__(self, spec, isotropic=True):
        self.f, self.isotropic = asperity.bsdf(spec), isotropic

    def eval(self, wi, wo):
        return self.f.eval(wi, wo)


def test_eval_is_the_closed_form():
    wi, wo = directions(5000), directions(5000, 2)
    f = asperity.bsdf("ggx:alpha=0.3")
    assert (f.channels, f.isotropic) == (1, True)
    np.testing.assert_allclose(f.eval(wi, wo)[:, 0], ggx(wi, wo, 0.3), rtol=1e-9)
    lambert = asperity.bsdf("lambert:albedo=0.5/0.4/0.3")
    np.testing.assert_allclose(lambert.eval(wi[:3], wo[:3]), np.tile([0.5, 0.4, 0.3], (3, 1)) / np.pi, rtol=1e-14)
    np.testing.assert_allclose(lambert.albedo(wi[:3]), np.tile([0.5, 0.4, 0.3], (3, 1)), rtol=1e-14)
    assert lambert.eval([0, 0, 1], [0, 0, -1]).tolist() == [0, 0, 0]


def test_shapes_broadcast():
    f = asperity.bsdf("ggx:alpha=0.3,material=Au")
    wi, wo = directions(6).reshape(2, 3, 3), directions(3, 2)
    whole = f.eval(wi, wo)
    assert whole.shape == (2, 3, 3) and f.pdf(wi, wo).shape == (2, 3)
    for a in range(2):
        for b in range(3):
            np.testing.assert_array_equal(whole[a, b], f.eval(wi[a, b], wo[b]))
    assert f.eval([0, 0, 1], wo).shape == (3, 3) and f.eval([0, 0, 1], [0, 0, 1]).shape == (3,)
    assert f.eval(np.empty((0, 3)), [0, 0, 1]).shape == (0, 3)
    assert f.eval(np.empty((0, 3)), np.empty((0, 3))).shape == (0, 3)
    np.testing.assert_array_equal(f.eval(wi[:, ::-1], wo[::-1]), whole[:, ::-1])
    np.testing.assert_allclose(f.eval(wi.astype(np.float32), wo.astype(np.float32)), whole, rtol=1e-4)
    big = directions(20_000)
    np.testing.assert_array_equal(f.eval(big, [0, 0, 1], threads=1), f.eval(big, [0, 0, 1], threads=2))


def test_sampling_follows_the_density():
    f = asperity.bsdf("ggx:alpha=0.5")
    wi = [0.6, 0.0, 0.8]
    u = np.random.default_rng(3).random((200_000, 2))
    wo, pdf = f.sample(wi, u)
    hit = pdf > 0
    np.testing.assert_allclose(pdf[hit], f.pdf(wi, wo[hit]), rtol=1e-9)
    # E[f cos / pdf] is the albedo
    weight = np.where(hit, f.eval(wi, np.where(hit[:, None], wo, [0, 0, 1]))[:, 0] * wo[:, 2] /
                      np.where(hit, pdf, 1), 0)
    assert weight.mean() == pytest.approx(f.albedo(wi)[0], abs=5 * weight.std() / np.sqrt(weight.size))
    assert f.sample(wi, u[:6].reshape(2, 3, 2))[0].shape == (2, 3, 3)
    refused(lambda: f.sample(wi, [[0.5, 1.0]]), ErrorCode.USAGE, "outside [0, 1)")


def test_what_is_no_direction_is_refused():
    f = asperity.bsdf("ggx:alpha=0.3")
    assert refused(lambda: f.eval([0, 0, 2], [0, 0, 1]), ErrorCode.USAGE, "unit vector").place == "wi"
    assert refused(lambda: f.eval([0, 0, 1], [0, 0, np.nan]), ErrorCode.USAGE, "unit vector").place == "wo"
    refused(lambda: f.eval([0, 1], [0, 0, 1]), ErrorCode.USAGE, "[..., 3]")
    refused(lambda: f.eval(directions(2), directions(3)), ErrorCode.USAGE, "broadcast")
    refused(lambda: f.eval("abc", [0, 0, 1]), ErrorCode.USAGE)
    refused(lambda: asperity.bsdf("ggz:alpha=0.3"), ErrorCode.USAGE, "ggz")
    refused(lambda: asperity.bsdf("ggx:alfa=0.3"), ErrorCode.USAGE, "alfa")
    refused(lambda: asperity.bsdf("none/there.bsdf"), ErrorCode.INPUT_OUTPUT, "none/there.bsdf")


def test_models_are_listed_and_pickled():
    assert "alpha" in asperity.bsdf_models()["ggx"] and "Au" in asperity.materials()
    f = asperity.bsdf("beckmann:alpha=0.2,material=Cu")
    back = pickle.loads(pickle.dumps(f))
    np.testing.assert_array_equal(back.eval([0, 0, 1], [0, 0, 1]), f.eval([0, 0, 1], [0, 0, 1]))


def test_compare_is_that_of_the_program(gold, program, tmp_path):
    import json
    import subprocess

    gold.save(tmp_path / "gold.asperity")
    told = json.loads(subprocess.run([program, "compare", tmp_path / "gold.asperity", "ggx:alpha=0.3,material=Au",
                                      "--json"], check=True, capture_output=True, text=True).stdout)
    c = asperity.compare(gold, "ggx:alpha=0.3,material=Au")
    assert c.mean_l1 == pytest.approx(told["mean_l1"], rel=1e-12)
    assert [layer["l1"] for layer in told["layers"]] == pytest.approx(c.l1.tolist(), rel=1e-12)
    for name in ("l1_stderr", "rms_stderr"):
        assert [layer[name] for layer in told["layers"]] == pytest.approx(getattr(c, name).tolist(), rel=1e-9)
        # Straight down, isotropic, all of this surface's facets are solved: nothing is left to chance
        assert (getattr(c, name)[1:] > 0).all()
    assert c.mean_l1_stderr == pytest.approx(told["mean_l1_stderr"], rel=1e-9) and 0 < c.mean_l1_stderr < c.mean_l1
    turned = asperity.compare("ggx:alpha=0.3,material=Au", gold)
    np.testing.assert_array_equal(turned.albedo_b, c.albedo_a)
    assert asperity.compare(gold, str(tmp_path / "gold.asperity")).mean_l1 == 0
    assert "mean L1" in str(c) and "<table>" in c._repr_html_()
    two = asperity.compare("lambert:albedo=0.5", "lambert:albedo=0.25", theta_deg=[0, 40], resolution=16)
    # The integral of (0.5 - 0.25) / pi cos is 0.25
    np.testing.assert_allclose(two.l1, 0.25, rtol=1e-9)
    assert (two.l1_stderr == 0).all() and two.mean_rms_stderr == 0
    refused(lambda: asperity.compare(gold, "lambert:albedo=1", resolution=8), ErrorCode.USAGE, "brings its own")
    refused(lambda: asperity.compare(gold, 3.5), ErrorCode.USAGE, "no eval")


def test_a_bsdf_of_ones_own_is_compared(gold):
    spec = "beckmann:alpha=0.3,material=Au"
    own, library = asperity.compare(gold, OfLibrary(spec)), asperity.compare(gold, spec)
    # Of its own models the library looks at one side of the plane of incidence: sums in another order
    np.testing.assert_allclose(own.l1, library.l1, rtol=1e-12)
    np.testing.assert_allclose(own.albedo_b, library.albedo_b, rtol=1e-12)
    phong = Phong(20)
    c = asperity.compare("lambert:albedo=1", phong, theta_deg=[0], resolution=32)
    assert phong.calls < 40  # by arrays, not pair by pair
    # Of light along the normal it reflects all: the integral of (n + 2) / 2 pi cos^(n+1) is 1
    assert c.albedo_b[0] == pytest.approx(1, abs=3e-4)
    refused(lambda: asperity.compare(gold, OfWrongShape()), ErrorCode.USAGE, "shape")
    refused(lambda: asperity.compare(gold, Negative()), ErrorCode.USAGE, "no BRDF")
    with pytest.raises(ZeroDivisionError):
        asperity.compare(gold, Raises())


class OfWrongShape:
    def eval(self, wi, wo):
        return np.zeros((3, 3, 3))


class Negative:
    def eval(self, wi, wo):
        return np.full(len(wi), -1.0)


class Raises:
    def eval(self, wi, wo):
        return 1 / 0


def test_exports_tell_their_fidelity(gold, tmp_path):
    e = gold.export(tmp_path / "gold.exr")
    assert (tmp_path / "gold.exr").exists() and e.format
    rgl = gold.export(tmp_path / "gold.bsdf", n=16)
    assert rgl.format == "rgl" and 0 < rgl.fidelity.mean_l1 < 1 and rgl.fidelity.l1.shape == (3,)
    assert "L1" in str(rgl)
    back = asperity.bsdf(tmp_path / "gold.bsdf")
    assert back.channels == 3
    model = asperity.bsdf("ggx:alpha=0.4").export(tmp_path / "ggx.bsdf", threads=2)
    assert model.fidelity.mean_l1 < 0.02
    wi, wo = np.array([0.5, 0, np.sqrt(0.75)]), directions(50)
    np.testing.assert_allclose(asperity.bsdf(tmp_path / "ggx.bsdf").eval(wi, wo)[:, 0], ggx(wi, wo, 0.4), rtol=0.1,
                               atol=0.01)
    refused(lambda: gold.export(tmp_path / "gold.xyz"), ErrorCode.USAGE)
    refused(lambda: gold.export(tmp_path / "gold.bsdf", m=3), ErrorCode.USAGE, "m")
    assert "rgl" in asperity.bsdf_formats()


def test_a_measurement_is_a_function(gold):
    f = asperity.bsdf(gold)
    assert f.channels == 3
    assert f.albedo([0, 0, 1])[0] == pytest.approx(gold.albedo[0, 0], rel=0.01)


def test_a_white_furnace_is_white():
    picture = asperity.render("sphere", "lambert:albedo=0.5", light=asperity.light("constant", intensity=2),
                              width=32, height=24, spp=4, depth=1, background=(0, 0, 0), filter="centre")
    assert picture.shape == (24, 32, 3) and picture.dtype == np.float32
    np.testing.assert_allclose(picture[12, 16], 1, rtol=0.3)
    middle = asperity.render("sphere", "lambert:albedo=0.5", light=asperity.light("constant", intensity=2), width=16,
                             height=16, spp=256, depth=1, filter="centre")[8, 8]
    np.testing.assert_allclose(middle, 1, rtol=0.03)  # 0.5 x 2
    assert picture[0, 0].tolist() == [0, 0, 0]
    bytes_ = asperity.tonemap(picture)
    assert bytes_.dtype == np.uint8 and bytes_.shape == (24, 32, 3) and bytes_[12, 16].min() > 200


def test_render_is_that_of_the_program(program, tmp_path, gold):
    import subprocess

    gold.save(tmp_path / "gold.asperity")
    subprocess.run([program, "render", "--model", "knot", "--brdf", tmp_path / "gold.asperity", "--width", "24",
                    "--height", "16", "--spp", "2", "--floor", "--camera-elevation", "20", "-o",
                    tmp_path / "a.png"], check=True, capture_output=True)
    from matplotlib.image import imread

    picture = asperity.render("knot", gold, width=24, height=16, spp=2, floor=True, camera_elevation_deg=20)
    np.testing.assert_allclose(imread(tmp_path / "a.png")[..., :3] * 255, asperity.tonemap(picture), atol=0.51)


@pytest.mark.parametrize(("own", "spec"), [
    (OfLibrary("ggx:alpha=0.05"), "ggx:alpha=0.05"),
    (OfLibrary("lambert:albedo=0.5", isotropic=False), "lambert:albedo=0.5")])
def test_a_bsdf_of_ones_own_is_rendered(own, spec):
    options = dict(model="sphere", width=24, height=24, spp=16)
    a, b = asperity.render(brdf=own, **options), asperity.render(brdf=spec, **options)
    assert np.abs(a - b).mean() < 0.02 * b.mean()
    assert a.mean() == pytest.approx(b.mean(), rel=0.005)


def test_wrong_scenes_are_told():
    refused(lambda: asperity.render("teapot"), ErrorCode.USAGE, "teapot")
    refused(lambda: asperity.render("sphere", light="moon"), ErrorCode.USAGE, "moon")
    refused(lambda: asperity.light("sky", sun=3), ErrorCode.USAGE, "did you mean")
    refused(lambda: asperity.render("sphere", width=0), ErrorCode.USAGE, "width")
    refused(lambda: asperity.render("sphere", width=1.5), ErrorCode.USAGE, "width")
    refused(lambda: asperity.render("sphere", integrator="magic"), ErrorCode.USAGE, "magic")
    refused(lambda: asperity.render("sphere", camera_target=(1, 2)), ErrorCode.USAGE, "camera_target")


def test_models_are_fitted(program, tmp_path):
    import json
    import subprocess

    # A table of a model gives the model back
    gold = dict(theta_deg=[0, 30, 60], resolution=32)
    report = asperity.fit(asperity.bsdf("ggx:alpha=0.35,material=Au"), "ggx:material=Au,beckmann:material=Au", **gold)
    assert report.best.model.startswith("ggx") and report.best["alpha"] == pytest.approx(0.35, rel=1e-3)
    assert len(report) == 2 and report[1].misfit > report[0].misfit
    back = report.best.bsdf().eval([0, 0, 1], [0, 0, 1])
    np.testing.assert_allclose(back, asperity.bsdf("ggx:alpha=0.35,material=Au").eval([0, 0, 1], [0, 0, 1]), rtol=2e-3)
    assert "alpha" in str(report) and report.verdict and "<table>" in report._repr_html_()
    # A measurement gives what the program finds
    m = asperity.measure(asperity.gaussian(alpha=0.3, size=128), theta_deg=[0, 30, 60], resolution=32, material="Au")
    m.save(tmp_path / "m.asperity")
    told = json.loads(subprocess.run([program, "fit", tmp_path / "m.asperity", "--model", "beckmann", "--light", "single",
                                      "--json"], check=True, capture_output=True, text=True).stdout)
    best = asperity.fit(m, "beckmann", light="single").best
    assert best.spec == told["fits"][0]["spec"] and best.mean_l1 == pytest.approx(told["fits"][0]["mean_l1"], rel=1e-12)
    assert best["alpha"] == pytest.approx(0.3, rel=0.1) and 0 < best.errors["alpha"] < 0.02
    own = asperity.fit(OfLibrary("ggx:alpha=0.35,material=Au"), "ggx:material=Au", **gold)
    assert own.best["alpha"] == pytest.approx(0.35, rel=1e-3)
    assert asperity.bsdf("ggx:alpha=0.3,material=Au,wavelengths=500/600").channel_names == ["500nm", "600nm"]
    # Of one surface the errors are those of its rays; of a class they hold both
    assert "speckle" in asperity.fit(m, "beckmann").note and "speckle" in str(asperity.fit(m, "beckmann"))
    several = asperity.measure(asperity.gaussian(alpha=0.3, size=64), theta_deg=30, resolution=16, surfaces=16)
    heard = []
    assert asperity.fit(several, "beckmann,ggx", progress=heard.append).note == "" and heard[-1].total == 2
    refused(lambda: asperity.fit(m, "gxx"), ErrorCode.USAGE, "gxx")
    refused(lambda: asperity.fit(m, resolution=3), ErrorCode.USAGE, "its own light")
    refused(lambda: asperity.fit(m, lights="single"), ErrorCode.USAGE, "did you mean 'light'")
