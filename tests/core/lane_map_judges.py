"""Programs of others that judge lane maps, from the environment that `make judges` makes."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path
from xml.etree import ElementTree

import pytest

JUDGES = Path(__file__).resolve().parents[2] / "build" / "judges" / "bin"

LOADING = """
import json, sys
if "autoware" in sys.argv[4:]:
    import autoware_lanelet2_extension_python.regulatory_elements
import lanelet2
projector = lanelet2.projection.UtmProjector(lanelet2.io.Origin(float(sys.argv[2]), float(sys.argv[3])))
loaded = lanelet2.io.load(sys.argv[1], projector)
_, errors = lanelet2.io.loadRobust(sys.argv[1], projector)
rules = lanelet2.traffic_rules.create(lanelet2.traffic_rules.Locations.Germany,
                                      lanelet2.traffic_rules.Participants.Vehicle)
graph = lanelet2.routing.RoutingGraph(loaded, rules)
print(json.dumps([len(loaded.laneletLayer), len(loaded.regulatoryElementLayer), list(errors),
                  list(graph.checkValidity(False))]))
"""


def judge(name):
    """Place of a judge's program; the test is left out where it is not installed."""
    place = JUDGES / name
    if not place.exists():
        pytest.skip(f"{name} is not installed; run: make judges")
    return str(place)


def loaded_by(python, path, origin, *extension):
    """Numbers of lanelets and regulatory elements, errors of loading, and of the routing graph."""
    import json

    done = subprocess.run([python, "-c", LOADING, str(path), *map(str, origin), *extension], capture_output=True,
                          text=True, check=False)
    assert done.returncode == 0, done.stderr[-2000:]
    return json.loads(done.stdout.splitlines()[-1])


def here():
    """This Python, whose package lanelet2 is that of simple-lanelet2."""
    pytest.importorskip("lanelet2")
    return sys.executable


def opendrive_issues(path, folder):
    """Errors (level 1) that ASAM's checker finds."""
    config, result = folder / "checks.xml", folder / "result.xqar"
    config.write_text(f'<Config><Param name="InputFile" value="{path}"/><CheckerBundle application="xodrBundle">'
                      f'<Param name="resultFile" value="{result}"/></CheckerBundle></Config>', encoding="utf-8")
    subprocess.run([judge("qc_opendrive"), "-c", str(config)], capture_output=True, check=True)
    issues = ElementTree.parse(result).getroot().iter("Issue")
    return [issue.get("description") for issue in issues if issue.get("level") == "1"]
