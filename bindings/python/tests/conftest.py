# SPDX-License-Identifier: Apache-2.0
import pathlib
import sys

import matplotlib
import pytest

matplotlib.use("Agg")

import asperity  # noqa: E402


@pytest.fixture(scope="session")
def program():
    """The command that came along with the package."""
    path = pathlib.Path(sys.executable).parent / "asperity"
    assert path.exists(), "the package brings no program"
    return path


@pytest.fixture(scope="session")
def rough():
    return asperity.gaussian(alpha=0.3, size=64)


@pytest.fixture(scope="session")
def gold(rough):
    """Three layers of gold, 3 channels, 16 rows, 32 columns, 2 bounce orders."""
    return asperity.measure(rough, material="Au", theta_deg=[0, 30, 60], resolution=32, orders=2, rays=200_000)


@pytest.fixture(scope="session")
def large():
    """A surface that takes a while."""
    return asperity.thesis(size=512, roughness=0.5)
