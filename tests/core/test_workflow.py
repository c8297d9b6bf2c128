"""The workflow for public services runs what .ci/run runs: it parses, its commands are sound and the same."""

from __future__ import annotations

import re
import shutil
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]


@pytest.fixture(scope="module")
def job():
    yaml = pytest.importorskip("yaml", reason="PyYAML is not installed")
    return yaml.safe_load((ROOT / ".github/workflows/tests.yml").read_text(encoding="utf-8"))["jobs"]["test"]


def commands(job):
    return [step["run"] for step in job["steps"] if "run" in step]


def targets(text):
    """Targets of all calls of make in a text of commands, bare or as a suite of .ci/run."""
    return {word for call in re.findall(r'^ *(?:suite "[^"]*" (?:.* run )?)?make((?: +[-\w]+)+)$', text, re.MULTILINE)
            for word in call.split()
            if not word.startswith("-")}


def test_it_runs_on_both_releases(job):
    assert job["strategy"]["matrix"]["system"] == ["debian:12", "debian:13"]
    assert "matrix.system" in job["container"]
    assert "trixie" in (ROOT / "scripts/trixie_root.sh").read_text(encoding="utf-8")


def test_it_makes_what_ci_makes(job):
    made = set().union(*map(targets, commands(job)))
    wanted = targets((ROOT / ".ci/run").read_text(encoding="utf-8"))
    assert "test" in wanted and wanted <= made
    assert made - wanted <= {"lint"}


@pytest.mark.skipif(not shutil.which("bash") or not shutil.which("make"), reason="bash or make is not here")
def test_its_commands_are_sound(job):
    for text in (*commands(job), (ROOT / ".ci/run").read_text(encoding="utf-8")):
        assert subprocess.run(["bash", "-n"], input=text, text=True, capture_output=True).stderr == ""
    for text in commands(job):
        for name in targets(text):
            done = subprocess.run(["make", "--dry-run", name], cwd=ROOT, text=True, capture_output=True)
            assert done.returncode == 0, done.stderr
