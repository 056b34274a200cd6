# SPDX-License-Identifier: Apache-2.0
"""What an editor and a type checker see."""
import os
import pathlib
import shutil
import subprocess
import sys

import asperity

GOOD = """
import asperity
import numpy as np

surface = asperity.gaussian(alpha=0.3, size=64, autocorrelation="exponential")
m = asperity.measure(surface, material="Au", theta_deg=[0, 30], until=0.01, seed=2)
shape: tuple[int, ...] = m.brdf.shape
f = asperity.bsdf("ggx:alpha=0.3")
values: np.ndarray = f.eval([0, 0, 1], [0, 0, 1])
mean: float = asperity.compare(m, f).mean_l1
picture = asperity.render("knot", m, width=32)
table = asperity.sweep({"surface": "flat"}, "folder").table
asperity.read("a.x3p", tiling="mirror")
asperity.plot.lobe(m, 30)
m.plot.hemisphere(30)
"""
EXAMPLES = sorted((pathlib.Path(__file__).parents[3] / "examples" / "python").glob("*.py"))
BAD = ["asperity.gaussian(alfa=0.3)", "asperity.gaussian(autocorrelation='bessel')", "asperity.measure(s, theta=3)",
       "asperity.measure(s, seed='x' * 2 + 1)", "asperity.measure(3)", "asperity.nothing()", "m.bdrf"]


def test_package_stubs_and_examples_pass_and_mistakes_do_not(tmp_path):
    """One strict look at all of them: what mypy knows of NumPy and matplotlib takes most of its time."""
    # Where packages are installed errors are passed over
    shutil.copytree(pathlib.Path(asperity.__file__).parent, tmp_path / "asperity",
                    ignore=lambda _, names: [n for n in names if not n.endswith((".py", ".pyi", ".typed"))])
    (tmp_path / "good.py").write_text(GOOD)
    (tmp_path / "bad.py").write_text("import asperity\ns = asperity.flat()\nm = asperity.measure(s)\n" + "\n".join(BAD) + "\n")
    # One of the examples has a client that need not be there
    told = subprocess.run([sys.executable, "-m", "mypy", "--strict", "--cache-dir", os.devnull, "--scripts-are-modules",
                           "--disable-error-code=import-not-found", "asperity", "good.py", "bad.py", *EXAMPLES],
                          capture_output=True, text=True, cwd=tmp_path).stdout
    wrong = [line for line in told.splitlines() if ": error:" in line]
    others = [line for line in wrong if not line.startswith("bad.py:")]
    assert not others, told
    assert {int(line.split(":")[1]) for line in wrong} == set(range(4, 4 + len(BAD))), told


def test_the_package_is_typed_and_documented():
    folder = pathlib.Path(asperity.__file__).parent
    for name in ("py.typed", "_core.pyi", "_made.pyi"):
        assert (folder / name).exists()
    for name in asperity.__all__:
        assert getattr(asperity, name).__doc__, f"{name} has no docstring"
    for kind in (asperity.Surface, asperity.Measurement, asperity.Bsdf):
        for name, member in vars(kind).items():
            if not name.startswith("_") and name != "surface_name":
                assert member.__doc__, f"{kind.__name__}.{name} has no docstring"
