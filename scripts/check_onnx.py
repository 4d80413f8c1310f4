"""ONNX files, run by an ONNX runtime.

    python check_onnx.py DIRECTORY

For every NAME.onnx in DIRECTORY: ONNX's own checker accepts it, shapes included,
and what onnxruntime computes from the inputs in NAME.npz is what the outputs there
say. `cargo run -p sonarfleet-learning --example export_onnx DIRECTORY` writes such
pairs. Needs numpy, onnx and onnxruntime.
"""

import sys
from pathlib import Path

import numpy as np
import onnx
import onnxruntime

# The order of summation differs; single precision keeps seven digits.
TOLERANCE = 1e-5


def check(what, holds):
    if not holds:
        sys.exit(f"FAILED: {what}")
    print(f"ok: {what}")


files = sorted(Path(sys.argv[1]).glob("*.onnx"))
check(f"{len(files)} ONNX files in {sys.argv[1]}", files)
for path in files:
    model = onnx.load(path)
    onnx.checker.check_model(model, full_check=True)
    operators = model.opset_import[0].version
    check(f"{path.name}: valid, IR {model.ir_version}, operator set {operators}", True)
    session = onnxruntime.InferenceSession(path, providers=["CPUExecutionProvider"])
    data = np.load(path.with_suffix(".npz"))
    names = [output.name for output in session.get_outputs()]
    given = {each.name: data[each.name] for each in session.get_inputs()}
    check(f"{path.name}: inputs and outputs are those of the .npz", {*given, *names} == {*data.files})
    # Whole batch and one row: the batch dimension is free.
    for rows in (slice(None), slice(0, 1)):
        computed = session.run(names, {name: value[rows] for name, value in given.items()})
        for name, value in zip(names, computed):
            expected = data[name][rows]
            largest = np.abs(value - expected).max() if value.shape == expected.shape else np.inf
            check(
                f"{path.name}: {name} {list(value.shape)}: largest difference {largest:.1e}",
                np.allclose(value, expected, rtol=TOLERANCE, atol=TOLERANCE)
                and value.shape == expected.shape,
            )
