"""Writes one small analytic ocean in every dialect that the readers must understand,
and what xarray reads back from each file (expected.csv).

Run in this directory: python make.py
"""
import csv
import glob
import warnings

import h5netcdf
import netCDF4
import numpy as np
import xarray as xr

warnings.simplefilter("ignore")

LONGITUDE = 118.0 + np.arange(4) / 12
LATITUDE = 21.5 + np.arange(3) / 12
DEPTH = np.array([0.494025, 92.326073, 1062.439941])
TIME = np.array(["2025-10-09T00:00", "2025-10-09T06:00"], dtype="datetime64[s]")
FILL = np.float32(9.96921e36)


def field(a, b, c, d, e):
    """Linear in everything, NaN at one land corner and at one node below the bottom."""
    hours = (TIME - TIME[0]).astype(float) / 3600
    t, z, y, x = np.meshgrid(hours, DEPTH, LATITUDE - 21.5, LONGITUDE - 118.0, indexing="ij")
    values = a + b * x + c * y + d * z + e * t
    values[:, :, 0, 0] = np.nan
    values[:, -1, -1, -1] = np.nan
    return values


FIELDS = {
    "thetao": (field(28.0, 3.0, -2.0, -0.02, 0.01), "sea_water_potential_temperature", "degrees_C"),
    "so": (field(34.2, 0.3, 0.2, 0.0004, 0.001), "sea_water_salinity", "1e-3"),
    "uo": (field(0.15, 0.2, -0.1, -0.0001, 0.004), "eastward_sea_water_velocity", "m s-1"),
    "vo": (field(-0.05, 0.1, 0.3, 0.0001, -0.003), "northward_sea_water_velocity", "m s-1"),
}


def dataset(names, vertical="depth"):
    ds = xr.Dataset()
    for name in names:
        values, standard_name, units = FIELDS[name]
        ds[name] = (("time", vertical, "latitude", "longitude"), values)
        ds[name].attrs = {"standard_name": standard_name, "units": units}
    z = DEPTH.astype("f4") if vertical == "depth" else -DEPTH.astype("f4")
    ds = ds.assign_coords(
        time=TIME.astype("datetime64[ns]"),
        latitude=("latitude", LATITUDE.astype("f4"), {"units": "degrees_north", "axis": "Y"}),
        longitude=("longitude", LONGITUDE.astype("f4"), {"units": "degrees_east", "axis": "X"}),
    )
    positive = "down" if vertical == "depth" else "up"
    ds[vertical] = (vertical, z, {"units": "m", "positive": positive, "standard_name": vertical})
    ds.time.attrs = {"standard_name": "time", "axis": "T"}
    return ds


HOURS = {"time": {"units": "hours since 1950-01-01", "dtype": "f4", "calendar": "gregorian"}}
SECONDS = {"time": {"units": "seconds since 1970-01-01", "dtype": "f8", "calendar": "gregorian"}}


def packed(names, **more):
    out = {}
    for name in names:
        lowest, highest = np.nanmin(FIELDS[name][0]), np.nanmax(FIELDS[name][0])
        scale = (highest - lowest) / 60000
        out[name] = {"dtype": "i2", "scale_factor": scale, "add_offset": (lowest + highest) / 2,
                     "_FillValue": np.int16(-32767), **more}
    return out


def single(names, fill=FILL, **more):
    return {name: {"dtype": "f4", "_FillValue": fill, **more} for name in names}


# Copernicus Marine: separate files, f32 hours, deflate and shuffle.
compressed = {"zlib": True, "complevel": 4, "shuffle": True}
for names, file in [(["thetao"], "t"), (["so"], "s"), (["uo", "vo"], "uv")]:
    dataset(names).to_netcdf(f"cmems_{file}.nc", engine="netcdf4",
                             encoding={**single(names, **compressed), **HOURS})
ALL = list(FIELDS)
dataset(ALL).to_netcdf("seconds_nan_fill.nc", engine="netcdf4",
                       encoding={**single(ALL, np.float32(np.nan)), **SECONDS})
dataset(ALL).to_netcdf("int16.nc", engine="netcdf4",
                       encoding={**packed(ALL, **compressed), **SECONDS})
dataset(ALL).to_netcdf("netcdf3.nc", format="NETCDF3_CLASSIC", engine="netcdf4",
                       encoding={**single(ALL), **HOURS})
dataset(ALL, "elevation").isel(elevation=slice(None, None, -1)).to_netcdf(
    "elevation_axis.nc", engine="netcdf4", encoding={**single(ALL), **HOURS})
descending = dataset(ALL).isel(latitude=slice(None, None, -1), depth=slice(None, None, -1))
descending.transpose("time", "longitude", "latitude", "depth").to_netcdf(
    "descending_transposed.nc", engine="netcdf4", encoding={**single(ALL), **SECONDS})
days = {"time": {"units": "days since 2025-10-01 12:00:00", "dtype": "f8"}}
dataset(["uo", "vo"]).to_netcdf("currents_only_days.nc", engine="netcdf4",
                                encoding={**single(["uo", "vo"]), **days})
# The oldest HDF5 superblock, which h5py writes; that of the netCDF library is version 2.
with h5netcdf.File("superblock_v0.nc", "w", libver=("earliest", "v108")) as f:
    ds = dataset(["uo", "vo"])
    f.dimensions = {"time": 2, "depth": 3, "latitude": 3, "longitude": 4}
    minutes = (TIME - np.datetime64("1970-01-01T00:00:00")).astype("i8") // 60
    f.create_variable("time", ("time",), "i4", data=minutes)
    f["time"].attrs["units"] = "minutes since 1970-01-01 00:00:00"
    for name in ["depth", "latitude", "longitude"]:
        f.create_variable(name, (name,), "f4", data=ds[name].values)
    f["depth"].attrs["positive"] = "down"
    for name in ["uo", "vo"]:
        f.create_variable(name, ds[name].dims, "f8", data=ds[name].values, fillvalue=np.nan)
        f[name].attrs["units"] = "m s-1"

# HYCOM: its names, longitudes in 0-360 across Greenwich, int16, temperature in situ.
hycom = dataset(ALL).rename(thetao="water_temp", so="salinity", uo="water_u", vo="water_v")
hycom = hycom.rename(latitude="lat", longitude="lon")
hycom["lon"] = ("lon", np.array([359.84, 359.92, 0.0, 0.08]), {"units": "degrees_east"})
hycom.water_temp.attrs["standard_name"] = "sea_water_temperature"
names = dict(zip(FIELDS, ["water_temp", "salinity", "water_u", "water_v"]))
encoding = {names[k]: {**v, "missing_value": v["_FillValue"]} for k, v in packed(ALL).items()}
encoding["time"] = {"units": "hours since 2000-01-01 00:00:00", "dtype": "f8"}
hycom.to_netcdf("hycom.nc", engine="netcdf4", encoding=encoding)

# GLORYS cut to one time: a scalar time coordinate.
dataset(ALL).isel(time=0).to_netcdf("scalar_time.nc", engine="netcdf4",
                                    encoding={**single(ALL), **SECONDS})

# Bathymetry: 2500 m in the west, rising eastward to land.
lon, lat = 118.0 + np.arange(6) / 10, 21.5 + np.arange(4) / 10
height = -2500.0 + 500 * np.arange(6)[None, :] + 40 * np.arange(4)[:, None] + 0.0
coords = {"lat": ("lat", lat, {"units": "degrees_north"}), "lon": ("lon", lon, {"units": "degrees_east"})}
gebco = xr.Dataset({"elevation": (("lat", "lon"), height.astype("i2"))}, coords)
gebco.to_netcdf("bathymetry_gebco.nc", format="NETCDF3_CLASSIC", engine="netcdf4")
etopo = xr.Dataset({"z": (("lat", "lon"), height.astype("f4"))}, coords)
etopo.isel(lat=slice(None, None, -1)).to_netcdf("bathymetry_etopo2022.nc", engine="netcdf4")
etopo2 = xr.Dataset({"z": (("y", "x"), height.astype("i2"))}, {"x": lon, "y": lat})
etopo2.to_netcdf("bathymetry_etopo2.nc", format="NETCDF3_CLASSIC", engine="netcdf4")
etopo5 = xr.Dataset({"topo": (("lat", "lon"), height.astype("i2"))})
etopo5["topo_lon"], etopo5["topo_lat"] = ("lon", lon), ("lat", lat)
etopo5.to_netcdf("bathymetry_etopo5.nc", engine="netcdf4")
depth = xr.DataArray(np.where(height < 0, -height, np.nan), dims=("latitude", "longitude"))
deptho = xr.Dataset({"deptho": depth}, {"latitude": lat.astype("f4"), "longitude": lon.astype("f4")})
deptho.deptho.attrs = {"standard_name": "sea_floor_depth_below_geoid", "units": "m"}
deptho.to_netcdf("bathymetry_deptho.nc", engine="netcdf4", encoding={"deptho": {"dtype": "f4", "_FillValue": FILL}})

with open("expected.csv", "w") as out:
    rows = csv.writer(out)
    rows.writerow(["file", "variable", "time", "depth_m", "latitude_deg", "longitude_deg", "value"])
    for file in sorted(glob.glob("*.nc")):
        ds = xr.open_dataset(file)
        for name in ds.data_vars:
            if file.startswith("bathymetry") and name.startswith("topo_"):
                continue
            frame = ds[name].to_dataframe().reset_index()
            for _, row in frame[::3].iterrows():
                if "time" in row:
                    time = np.datetime_as_string(np.datetime64(row["time"], "s")) + "Z"
                else:
                    time = ""
                z = row.get("depth", -row.get("elevation", np.nan))
                y = next(row[k] for k in ["latitude", "lat", "y"] if k in row)
                x = next(row[k] for k in ["longitude", "lon", "x"] if k in row)
                if file == "bathymetry_etopo5.nc":
                    y, x = ds.topo_lat.values[int(y)], ds.topo_lon.values[int(x)]
                rows.writerow([file, name, time, f"{z:.6f}", f"{y:.7f}", f"{x:.7f}", repr(float(row[name]))])
