"""The log of a training, read by TensorBoard.

    python check_training_files.py DIRECTORY

What TensorBoard's own reader finds in the event files of DIRECTORY is what
metrics.jsonl and timings.jsonl say, also where the training was killed and resumed.
`cargo run -p sonarfleet-learning --example training_log DIRECTORY` writes such a
log. Needs tensorboard.
"""

import json
import math
import sys
from pathlib import Path

from tensorboard.backend.event_processing.event_accumulator import EventAccumulator

# Event files hold single precision.
TOLERANCE = 1e-6


def check(what, holds):
    if not holds:
        sys.exit(f"FAILED: {what}")
    print(f"ok: {what}")


def lines(path):
    return [json.loads(line) for line in path.open()]


def same(value, said):
    return math.isnan(value) if said is None else math.isclose(value, said, rel_tol=TOLERANCE)


directory = Path(sys.argv[1])
metrics, timings = (lines(directory / name) for name in ("metrics.jsonl", "timings.jsonl"))
updates = [line["update"] for line in metrics]
check(f"{len(updates)} updates, each once and in order", updates and updates == list(range(1, len(updates) + 1)))
check("timings.jsonl has the same updates", [line["update"] for line in timings] == updates)

expected = {}
for prefix, log in (("", metrics), ("seconds/", timings)):
    for line in log:
        for name, value in line.items():
            if name not in ("update", "step"):
                expected.setdefault(prefix + name, []).append((line["step"], value))

events = EventAccumulator(str(directory), size_guidance={"scalars": 0}).Reload()
tags = events.Tags()["scalars"]
check(f"TensorBoard reads {', '.join(sorted(tags))}", set(tags) == set(expected))
for tag, said in expected.items():
    read = events.Scalars(tag)
    check(
        f"{tag}: {len(read)} points",
        len(read) == len(said)
        and all(e.step == step and same(e.value, value) for e, (step, value) in zip(read, said)),
    )
