# SPDX-License-Identifier: Apache-2.0
"""A sweep of roughness in two processes. Start it again, or after a crash: what is there is not measured again.

With Dask the same is asperity.sweep(..., client=dask.distributed.Client()); as jobs of Slurm
python -m asperity sweep FILE.toml FOLDER --slurm 32 prints the script."""

import asperity
from matplotlib import pyplot

sweep = asperity.sweep({"surface": "gaussian", "size": 128, "material": "Cu", "alpha": [0.1, 0.2, 0.3, 0.4, 0.5],
                        "theta_deg": [[0, 45, 70]], "isotropic": True, "resolution": 32, "jitter": 2},
                       "roughness", processes=2)
print(sweep.table_file, "has", len(sweep.table["alpha"]), "rows")

with asperity.plot.style("light"):
    figure, ax = pyplot.subplots(figsize=(4.8, 3.6))
    asperity.plot.curves(sweep, "alpha", "albedo", by="theta_i_deg", ax=ax)
    figure.savefig("sweep.png")
assert max(sweep.table["albedo"]) <= 1
