# SPDX-License-Identifier: Apache-2.0
"""What tools/wheel runs in an empty environment: every part of the package once, and where its libraries are."""

import json
import pathlib
import re
import subprocess
import tempfile

import asperity
import numpy as np

surface = asperity.gaussian(alpha=0.3, size=64)
m = asperity.measure(surface, material="Au", theta_deg=[0, 45], resolution=32)
assert np.allclose(m.albedo + m.absorbed + m.truncated, 1)
with tempfile.TemporaryDirectory() as folder:
    m.plot.lobe(45)[0].axes.figure.savefig(f"{folder}/lobe.png")
    assert m.export(f"{folder}/m.exr").format
    surface.save(f"{folder}/s.gsf")
    assert asperity.read(f"{folder}/s.gsf").shape == (64, 64)
    assert asperity.render("knot", m, width=32, height=32, spp=2).mean() > 0
    told = subprocess.run(["asperity", "simulate", "--surface", "gaussian:alpha=0.3,size=64", "--material", "Au",
                           "--theta", "0,45", "--resolution", "32", "--json", "--reference", "none"],
                          check=True, capture_output=True, text=True).stdout
assert json.loads(told)["checksum"] == m.checksum, "the program that came along measures something else"

# Whatever Debian has and Python does not is brought along
system = re.compile(r"/(ld-linux|lib(c|m|dl|pthread|rt|gcc_s|stdc\+\+|z|bz2|lzma|ffi|expat|util|crypt|ssl|crypto|"
                    r"uuid|mpdec|python3)[-.\w]*\.so)")
here = str(pathlib.Path(asperity.__file__).parent.parent)
strangers = {line.split()[-1] for line in open("/proc/self/maps") if ".so" in line.split()[-1]
             and here not in line and "python3" not in line and not system.search(line)}
assert not strangers, f"not in the wheel: {strangers}"
print(f"asperity {asperity.__version__}: measured, exported, rendered, plotted; the program's checksum is the same")
