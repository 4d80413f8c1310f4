"""What a run writes, read by other programs.

    python check_files.py SONARFLEET DIRECTORY

Runs the small scenario with the given executable into DIRECTORY/run, writes its
synthetic ocean, and compares what xarray, NumPy, SciPy and an XML and a JSON
parser read with what the program itself says. Needs numpy, scipy, xarray,
netCDF4, h5netcdf and h5py.
"""

import csv
import io
import json
import os
import subprocess
import sys
import xml.etree.ElementTree
from pathlib import Path

import numpy as np
import xarray as xr
from scipy.optimize import linear_sum_assignment

program, directory = Path(sys.argv[1]).resolve(), Path(sys.argv[2])
directory.mkdir(parents=True)
scenario = Path(__file__).resolve().parent.parent / "scenarios" / "small.toml"


def sonarfleet(*arguments):
    command = [program, *map(str, arguments)]
    environment = {**os.environ, "SONARFLEET_CACHE": str(directory / "cache")}
    return subprocess.run(
        command, cwd=directory, env=environment, check=True, capture_output=True, text=True
    ).stdout


def check(what, holds):
    if not holds:
        sys.exit(f"FAILED: {what}")
    print(f"ok: {what}")


said = json.loads(sonarfleet("run", scenario, "--output", "run", "--json"))

for engine in ("netcdf4", "h5netcdf"):
    for k, numbers in enumerate(said["epochs"]):
        epoch = xr.open_dataset(directory / "run" / f"epoch-{k}.nc", engine=engine)
        utility = float((epoch.prior * epoch.detection_probability).sum())
        check(
            f"{engine}: epoch {k}: sum of prior times detection probability is J_d",
            np.isclose(utility, numbers["detection_utility"], rtol=1e-9)
            and np.isclose(epoch.attrs["detection_utility"], utility, rtol=1e-9),
        )
        check(f"{engine}: epoch {k}: conventions", epoch.attrs["Conventions"] == "CF-1.8")
        check(
            f"{engine}: epoch {k}: tracks are as long as their counts say",
            int(epoch.track_count.sum()) == epoch.sizes["track_point"],
        )

metrics = [json.loads(line) for line in (directory / "run" / "metrics.jsonl").open()]
check("metrics.jsonl has a line per epoch", len(metrics) == len(said["epochs"]))
routes = json.load((directory / "run" / "routes.geojson").open())
check("routes.geojson is a feature collection", routes["type"] == "FeatureCollection")
for name in ("routes.kml", "routes.gpx"):
    xml.etree.ElementTree.parse(directory / "run" / name)
    check(f"{name} is well-formed XML", True)

sonarfleet("ocean", "synth", "ocean", "--scenario", scenario)
files = [f"ocean/{name}" for name in ("thetao.nc", "so.nc", "uo_vo.nc")]
ocean = xr.merge([xr.open_dataset(directory / name) for name in files])
check("the synthetic ocean has the CMEMS layout", set(ocean.sizes) == {"time", "depth", "latitude", "longitude"})
longitude, latitude = float(ocean.longitude[3]), float(ocean.latitude[3])
place = ("--longitude", longitude, "--latitude", latitude)
column = list(csv.DictReader(io.StringIO(sonarfleet("ocean", "profile", *files, *place))))
there = ocean.isel(time=0, latitude=3, longitude=3)
for name, key in (("so", "salinity_psu"), ("uo", "current_east_m_s"), ("vo", "current_north_m_s")):
    values = there[name].values
    ours = np.array([float(row[key] or "nan") for row in column])
    wet = np.isfinite(values)
    check(f"ocean profile reads {name} as xarray does", np.allclose(ours[wet], values[wet], atol=1e-6))

sonarfleet("tl", scenario, "--output", "tl.nc")
sonarfleet("tl", scenario, "--output", "tl.npz")
table = xr.open_dataset(directory / "tl.nc")
check("tl.nc and tl.npz hold the same losses",
      np.array_equal(table.transmission_loss.values, np.load(directory / "tl.npz")["tl"]))
epoch = xr.open_dataset(directory / "run" / "epoch-0.nc")
excerpt = table.transmission_loss.values[int(epoch.attrs["transmission_loss_source_cell"])]
check("epoch-0.nc holds a row of tl.nc", np.array_equal(epoch.transmission_loss.values.ravel(), excerpt))

costs = np.random.default_rng(5).uniform(1, 100, (60, 60))
np.savez_compressed(directory / "costs.npz", cost=costs)
ours = json.loads(sonarfleet("assign", "costs.npz", "--json"))
rows, columns = linear_sum_assignment(costs)
check("assign agrees with SciPy", np.isclose(ours["total"], costs[rows, columns].sum()) and ours["certified"])
