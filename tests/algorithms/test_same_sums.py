"""Libraries that multiply matrices are found without reading through all that is loaded at each step."""

import ctypes
import shutil

import pytest


@pytest.fixture
def sums(plugin, monkeypatch):
    module = plugin("algorithms.framework.running.same_sums")
    monkeypatch.setattr(module, "_known", [None, []])
    if module._loads() is None:
        pytest.skip("this system does not count what a process loads")
    return module


@pytest.fixture
def looked_for(sums, monkeypatch):
    """One entry for each time that the libraries were looked for."""
    times, look = [], sums._loaded_libraries
    monkeypatch.setattr(sums, "_loaded_libraries", lambda: times.append(1) or look())
    return times


def of_this_process(part):
    with open("/proc/self/maps", encoding="utf-8") as maps:
        return next(line.split()[-1] for line in maps if part in line)


def test_libraries_are_looked_for_once(sums, looked_for):
    assert [library._name for library in sums._libraries()] == [library._name for library in sums._loaded_libraries()]
    before = len(looked_for)
    for _ in range(5):
        with sums.same_sums():
            pass
    assert len(looked_for) == before


def test_a_library_loaded_later_is_found(sums, looked_for, tmp_path):
    known = {library._name for library in sums._libraries()}
    copy = tmp_path / "libblas_of_the_test.so"
    shutil.copy(of_this_process("/libm.so"), copy)
    ctypes.CDLL(str(copy))
    assert {library._name for library in sums._libraries()} - known == {str(copy)}
    assert len(looked_for) == 2
