#!/usr/bin/env python3
"""Runs a real BELLHOP and ours on the same cases, and reads what both write with arlpy.

usage: check_bellhop.py SONARFLEET BELLHOP DATA WORK

SONARFLEET and BELLHOP are the programs, DATA holds cases (folders with case.env, and
features/*.env), WORK is a directory to work in. Prints how far the fields are apart, as a
Markdown table, and fails where they are further apart than two correct programs may be.
"""
import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np

# Medians, dB: incoherent fields are compared by value; coherent ones shift by interference.
MOST_APART_DB = {"I": 0.1, "S": 0.2, "C": 0.3}


def run_type(env):
    """The letters of the run type: the last quoted text of an environment file."""
    quoted = [line for line in env.read_text().splitlines() if line.strip().startswith("'")]
    return quoted[-1].strip()[1:].split("'")[0]


def stage(env, folder):
    """Copies a case's files to a folder of its own, where paths are short."""
    folder.mkdir(parents=True)
    for file in env.parent.glob(env.stem + ".*"):
        if file.suffix in (".env", ".bty", ".ssp", ".ati", ".brc", ".trc", ".sbp"):
            shutil.copy(file, folder / f"case{file.suffix}")


def results(folder):
    return {suffix for suffix in (".shd", ".arr", ".ray") if (folder / f"case{suffix}").exists()}


def close(ours, theirs, tolerance):
    return np.allclose(np.asarray(ours, float), np.asarray(theirs, float), rtol=tolerance, atol=tolerance)


def read_by_arlpy(name, ours, theirs, letters):
    """Both files must mean the same to an independent reader: axes, counts, angles."""
    import arlpy.uwapm

    reader = arlpy.uwapm._Bellhop()
    bases = [str(folder / "case") for folder in (ours, theirs)]
    kind = letters[0]
    if kind in "CSI" and (len(letters) < 5 or letters[4] != "I"):
        a, b = (reader._load_shd(base) for base in bases)
        assert a.shape == b.shape, name
        assert close(a.index, b.index, 1e-6) and close(a.columns, b.columns, 1e-6), name
    elif kind == "A":
        a, b = (reader._load_arrivals(base) for base in bases)
        for column in ("tx_depth", "rx_depth", "rx_range"):
            assert close(sorted(set(a[column])), sorted(set(b[column])), 1e-6), f"{name}: {column}"
        first = [frame.groupby(["rx_depth_ndx", "rx_range_ndx"])["time_of_arrival"].min() for frame in (a, b)]
        assert close(*first, 1e-3), f"{name}: first arrivals"
    elif kind == "R":
        a, b = (reader._load_rays(base) for base in bases)
        # Rays may end at other places, so their bounces may differ.
        assert close(a["angle_of_departure"], b["angle_of_departure"], 1e-6), f"{name}: angles"
        for ours, theirs in zip(a["ray"], b["ray"]):
            assert close(ours[0], theirs[0], 1e-6), f"{name}: sources"
    else:
        return False
    return True


def main():
    sonarfleet, bellhop, data, work = (Path(path).resolve() for path in sys.argv[1:5])
    environment = os.environ | {"SONARFLEET_BELLHOP": str(bellhop)}
    cases = sorted(data.glob("*/case.env")) + sorted(data.glob("features/*.env"))
    assert cases, f"no cases under {data}"
    print("| case | run | median | p90 | p99 | max, dB | driven by us: median | arlpy |")
    print("|---|---|---|---|---|---|---|---|")
    failures = []
    for env in cases:
        name = env.parent.name if env.stem == "case" else f"features/{env.stem}"
        letters = run_type(env)
        theirs, ours, driven = (work / name / who for who in ("theirs", "ours", "driven"))
        stage(env, theirs)
        subprocess.run([bellhop, "case"], cwd=theirs, check=True, capture_output=True)
        made = results(theirs)
        field = ["--compare", theirs / "case.shd"] if ".shd" in made else []
        medians = []
        for output, model in ((ours, "native"), (driven, "bellhop")):
            command = [sonarfleet, "bellhop", theirs / "case.env", "--output", output, "--model", model, "--json", *field]
            done = subprocess.run(command, env=environment, check=True, capture_output=True, text=True)
            assert results(output) == made, f"{name}: {results(output)} for {made}"
            medians.append(json.loads(done.stdout)["differences"])
        read = read_by_arlpy(name, ours, theirs, letters)
        row = ["", "", "", "", ""]
        if field:
            apart, through_us = medians
            row = [f"{apart[key]:.3f}" for key in ("median_db", "p90_db", "p99_db", "max_db")]
            row.append(f"{through_us['median_db']:.3f}")
            for what, value in (("native", apart), ("driven", through_us)):
                if value["median_db"] > MOST_APART_DB[letters[0]]:
                    failures.append(f"{name}: {what} is {value['median_db']:.3f} dB off")
        print(f"| {name} | {letters} | {' | '.join(row)} | {'same' if read else ''} |", flush=True)
    for failure in failures:
        print(f"FAILED {failure}", file=sys.stderr)
    sys.exit(bool(failures))


if __name__ == "__main__":
    main()
