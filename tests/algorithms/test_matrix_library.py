"""numpy multiplies with its own BLAS also where QGIS's reference BLAS stands before it."""

from __future__ import annotations

import ctypes.util
import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]

PRODUCTS = """
import hashlib, importlib.util, json, sys
import numpy as np

spec = importlib.util.spec_from_file_location("town", sys.argv[1] + "/__init__.py",
                                              submodule_search_locations=[sys.argv[1]])
sys.modules["town"] = importlib.util.module_from_spec(spec)
library = importlib.import_module("town.algorithms.framework.running.matrix_library")

def products():
    a, b = np.random.default_rng(1).normal(size=(2, 200, 200))
    single = a.astype(np.float32) @ b.astype(np.float32)
    made = (a @ b, a.T @ a, a @ b[0], a[0] @ b[0], single, (a + 1j * b) @ (b - 1j * a))
    return [hashlib.sha256(np.ascontiguousarray(item).tobytes()).hexdigest() for item in made]

told = {"before": products(), "from": library.products_library()}
told["trouble"] = library.bind_products()
told["after"], told["to"] = products(), library.products_library()
print(json.dumps(told))
"""


def products(preload):
    done = subprocess.run([sys.executable, "-c", PRODUCTS, str(ROOT)], capture_output=True, text=True, check=True,
                          env={**os.environ, "PYTHONPATH": os.pathsep.join(sys.path), "OPENBLAS_NUM_THREADS": "1",
                               "LD_PRELOAD": preload})
    return json.loads(done.stdout.strip().splitlines()[-1])


@pytest.mark.skipif(not Path("/proc/self/maps").exists(), reason="Linux alone looks for functions by name")
def test_products_run_in_numpys_own_library(qgis_app):
    strange = ctypes.util.find_library("gslcblas")
    if strange is None:
        pytest.skip("the reference BLAS of GSL is not installed")
    plain, mixed = products(""), products(strange)
    assert plain["before"] == plain["after"] and not plain["trouble"]
    if "gslcblas" not in mixed["from"]:
        pytest.skip("numpy carries its own BLAS here, under names of its own")
    if "openblas" in plain["from"]:  # another reference BLAS sums in the same order
        assert mixed["before"] != plain["before"]  # what would be wrong without
    assert mixed["after"] == plain["before"] and not mixed["trouble"]
    assert "gslcblas" not in mixed["to"] and mixed["to"] == plain["to"]
