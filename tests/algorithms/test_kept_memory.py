"""Memory kept for the length of a run, and given back after it."""

import re
import sys
import threading
from pathlib import Path

import numpy as np
import pytest

STATUS = Path("/proc/self/status")


def resident():
    """MB of this process."""
    return int(re.search(r"VmRSS:\s*(\d+)", STATUS.read_text(encoding="ascii"))[1]) / 1024


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="only glibc is told to keep memory")
def test_free_memory_goes_back_at_the_end_of_the_last_run(plugin):
    kept = plugin("algorithms.framework.running.kept_memory")
    before = resident()
    with kept.kept_memory():
        with kept.kept_memory():
            arrays = [np.ones(1_000_000) for _ in range(40)]  # 320 MB
        assert resident() > before + 300
        del arrays
    assert kept._runs == 0 and resident() < before + 100


def test_runs_in_several_threads_count_together(plugin):
    kept = plugin("algorithms.framework.running.kept_memory")
    seen = []

    def run():
        with kept.kept_memory():
            seen.append(kept._runs)

    with kept.kept_memory():
        threads = [threading.Thread(target=run) for _ in range(3)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
    assert kept._runs == 0 and min(seen) >= 2
