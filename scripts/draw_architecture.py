#!/usr/bin/env python3
"""Draw docs/images/architecture.svg from the code: the flow of data through the algorithms, and the core under them.

    python3 scripts/draw_architecture.py

Inputs and outputs are those that the algorithms declare. One algorithm feeds another where a shipped model joins them,
where the help of an input names the algorithm that makes it (“Segment roofs”), or where an input is labelled as another
algorithm's output. The core's part is read from the imports. Needs a Python that sees QGIS.
"""

from __future__ import annotations

import re
import sys
from collections import defaultdict
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from html import escape
from pathlib import Path
from xml.etree import ElementTree

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT))

from scripts.source_tree import CORE, FACE, modules, own_imports, reachable  # noqa: E402

PICTURE = ROOT / "docs" / "images" / "architecture.svg"
LANES = ("aerial", "mobile", "lines", "buildings", "gnss", "roadmap", "delivery")
"""Groups that have a lane, from above. Workflows only join the stages; the sample city makes files of every kind."""

DATA_TYPES = {"multilayer", "source", "vector", "raster", "file", "layer", "sink", "fileDestination",
              "rasterDestination", "folderDestination"}
COLOURS = {"aerial": "#2f7f9e", "mobile": "#b5533c", "lines": "#8a6bb0", "buildings": "#8d7a3f", "gnss": "#3f8f63",
           "roadmap": "#4a5560", "delivery": "#7a5c2e"}
INK, FAINT, PAPER, LANE = "#222222", "#666666", "#ffffff", "#f4f4f2"

LEFT, GAP, BOX, PAD, LINE = 162, 36, 200, 7, 13  # widths and heights in pixels
TITLE_SIZE, TEXT_SIZE = 12, 10
CHARACTER = 0.53  # mean width of a letter, in font sizes


@dataclass(frozen=True)
class Stage:
    """An algorithm: id, name, group, and the labels of what it takes and gives by parameter name."""

    identifier: str
    name: str
    group: str
    takes: dict[str, str]
    gives: dict[str, str]
    named: dict[str, tuple[str, ...]]  # names of algorithms that the help of an input mentions


@dataclass(frozen=True)
class Box:
    """A drawn stage: left, top and height in pixels, and its lines of text."""

    stage: Stage
    left: float
    top: float
    height: float
    lines: tuple[tuple[str, str], ...]  # text and kind: "name", "takes" or "gives"


def stages_of(algorithms: Iterable) -> list[Stage]:
    """Stages from QGIS's algorithms, in the order of their ids; models and workflows are left out."""
    found = []
    for algorithm in sorted(algorithms, key=lambda one: one.name()):
        if algorithm.groupId() not in LANES:
            continue
        data = [item for item in algorithm.parameterDefinitions() if item.type() in DATA_TYPES]
        takes = {item.name(): item.description() for item in data if not item.isDestination()}
        gives = {item.name(): item.description() for item in data if item.isDestination()}
        named = {item.name(): tuple(re.findall("“([^”]+)”", item.help())) for item in data if not item.isDestination()}
        found.append(Stage(algorithm.name(), algorithm.displayName(), algorithm.groupId(), takes, gives, named))
    return found


def links_of(stages: Sequence[Stage], joined: Iterable[tuple[str, str]]) -> set[tuple[str, str]]:
    """Pairs of ids: the first makes what the second takes; `joined` are the pairs that the shipped models join."""
    by_name = {stage.name: stage.identifier for stage in stages}
    makers = defaultdict(set)
    for stage in stages:
        for label in stage.gives.values():
            makers[label.lower()].add(stage.identifier)
    links = set(joined)
    for stage in stages:
        for name, label in stage.takes.items():
            told = {by_name[other] for other in stage.named[name] if other in by_name}
            alike = {maker for maker in makers[label.lower()] if label.lower() != "report"}
            links.update((maker, stage.identifier) for maker in told or alike)
    return {(maker, user) for maker, user in links if maker != user}


def model_links(folder: Path = ROOT / "resources" / "models") -> set[tuple[str, str]]:
    """Pairs of algorithm ids that the shipped models join: maker and user."""
    links = set()
    for path in sorted(folder.glob("*.model3")):
        for child in ElementTree.parse(path).iter("Option"):
            component = child.find("Option[@name='component_description']")
            identifier = child.find("Option[@name='alg_id']")
            if component is None or identifier is None:
                continue
            user = identifier.get("value").partition(":")[2]
            for source in child.iter("Option"):
                if source.get("name") == "child_id" and source.get("value"):
                    links.add((source.get("value"), user))
    return links


def depths(stages: Sequence[Stage], links: set[tuple[str, str]]) -> dict[str, int]:
    """Column of each stage: one more than that of the last stage that it takes something from."""
    makers = defaultdict(set)
    for maker, user in links:
        makers[user].add(maker)
    found: dict[str, int] = {}

    def depth(identifier: str, above: tuple[str, ...] = ()) -> int:
        if identifier in above:
            raise ValueError(f"The flow of data runs in a circle: {' -> '.join((*above, identifier))}")
        if identifier not in found:
            found[identifier] = max((depth(maker, (*above, identifier)) + 1 for maker in sorted(makers[identifier])),
                                    default=0)
        return found[identifier]

    return {stage.identifier: depth(stage.identifier) for stage in stages}


# Drawing


def draw(algorithms: Iterable) -> str:
    """The picture as SVG."""
    stages = stages_of(algorithms)
    identifiers = {stage.identifier for stage in stages}
    links = links_of(stages, {pair for pair in model_links() if identifiers.issuperset(pair)})
    columns = depths(stages, links)
    width = LEFT + (max(columns.values()) + 1) * (BOX + GAP) + 10
    top, boxes, lanes = 66.0, {}, []
    for group in LANES:
        placed, bottom = lane_boxes([stage for stage in stages if stage.group == group], columns, top)
        boxes.update({box.stage.identifier: box for box in placed})
        lanes.append(lane(group, top, bottom, width))
        top = bottom + 8
    core, height = core_part(top + 14, width)
    parts = [
        text(14, 26, "From files to results", 18, bold=True),
        text(14, 46, "Boxes are algorithms: ▸ what they take from files, ▹ what they give. Lines: what one gives "
             "another takes. “Workflows” run the stages in chains, “Sample city” makes all files.", 11, FAINT),
        *lanes,
        *(curve(boxes[maker], boxes[user]) for maker, user in sorted(links)),
        *(drawn(box) for box in boxes.values()),
        *core,
    ]
    return "\n".join([
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width:g} {height:g}" width="{width:g}" '
        f'height="{height:g}" font-family="DejaVu Sans, Verdana, Arial, sans-serif">',
        f'<rect width="{width:g}" height="{height:g}" fill="{PAPER}"/>', *parts, "</svg>", ""])


def lane_boxes(stages: Sequence[Stage], columns: Mapping[str, int], top: float) -> tuple[list[Box], float]:
    """Boxes of one lane, each in its column under the one before, and where the lane ends."""
    down: dict[int, float] = defaultdict(lambda: top + 8)
    placed = []
    for stage in stages:
        lines = [*wrapped(stage.name, "name", 0.74 * BOX),
                 *wrapped("▸ " + ", ".join(dict.fromkeys(stage.takes.values())), "takes"),
                 *wrapped("▹ " + ", ".join(dict.fromkeys(stage.gives.values())), "gives")]
        height = 2 * PAD + LINE * len(lines)
        column = columns[stage.identifier]
        placed.append(Box(stage, LEFT + column * (BOX + GAP), down[column], height, tuple(lines)))
        down[column] += height + 10
    return placed, max(down.values())


def lane(group: str, top: float, bottom: float, width: float) -> str:
    """Ground of a lane, with the group's folder and the rooms of the core that it calls."""
    rooms = sorted(rooms_called(group))
    lines = [text(14, top + 24, f"algorithms/{group}", TITLE_SIZE, COLOURS[group], bold=True),
             text(14, top + 42, "calls", TEXT_SIZE, FAINT)]
    lines += [text(14, top + 42 + LINE * (number + 1), room, TEXT_SIZE, FAINT) for number, room in enumerate(rooms)]
    return "\n".join([f'<rect x="6" y="{top:g}" width="{width - 12:g}" height="{bottom - top:g}" rx="6" '
                      f'fill="{LANE}"/>', *lines])


def rooms_called(group: str) -> set[str]:
    """Folders of the core from which the modules of a group import."""
    targets = {target for name, path in modules(FACE).items() if name.startswith(f"{FACE}.{group}.")
               for target in own_imports(path) if target.startswith(f"{CORE}.")}
    return {target.split(".")[1] for target in targets if target.count(".") > 1}


def drawn(box: Box) -> str:
    """A stage's box with its text."""
    colour = COLOURS[box.stage.group]
    parts = [f'<rect x="{box.left:g}" y="{box.top:g}" width="{BOX}" height="{box.height:g}" rx="4" fill="{PAPER}" '
             f'stroke="{colour}" stroke-width="1.3"/>']
    for number, (line, kind) in enumerate(box.lines):
        look = (TITLE_SIZE, colour, True) if kind == "name" else (TEXT_SIZE, INK if kind == "gives" else FAINT, False)
        parts.append(text(box.left + PAD, box.top + PAD + LINE * number + 10, line, *look))
    return "\n".join(parts)


def curve(maker: Box, user: Box) -> str:
    """The line from one stage to another that takes what it gives."""
    x, y = maker.left + BOX, maker.top + maker.height / 2
    to_x, to_y = user.left, user.top + user.height / 2
    bend = max(GAP, (to_x - x) / 2)
    return (f'<path d="M{x:g} {y:g} C{x + bend:g} {y:g} {to_x - bend:g} {to_y:g} {to_x:g} {to_y:g}" fill="none" '
            f'stroke="{COLOURS[maker.stage.group]}" stroke-width="1.6" opacity="0.65"/>')


def core_part(top: float, width: float) -> tuple[list[str], float]:
    """The core's rooms on their floors with what each holds and imports, and where the picture ends."""
    rooms = room_imports()
    parts = [text(14, top + 14, f"The core, {CORE}: a room imports only from floors below its own", 14, bold=True)]
    down = top + 26.0
    for names in floors(rooms):
        box_width = (width - 12 - 10 * (len(names) - 1)) / len(names)
        texts = [wrapped(room_text(name, rooms), "takes", box_width - 2 * PAD) for name in names]
        height = 2 * PAD + LINE + 4 + LINE * max(len(lines) for lines in texts)
        for number, (name, lines) in enumerate(zip(names, texts)):
            left = 6 + number * (box_width + 10)
            parts.append(f'<rect x="{left:g}" y="{down:g}" width="{box_width:g}" height="{height:g}" rx="4" '
                         f'fill="{LANE}" stroke="{COLOURS.get(name, FAINT)}"/>')
            parts.append(text(left + PAD, down + PAD + 10, name, TITLE_SIZE, COLOURS.get(name, INK), bold=True))
            parts += [text(left + PAD, down + PAD + LINE + 13 + LINE * row, line, TEXT_SIZE, FAINT)
                      for row, (line, _) in enumerate(lines)]
        down += height + 10
    return parts, down


def room_imports() -> dict[str, set[str]]:
    """Rooms of the core (folders, and modules at its head) with the rooms that each imports from."""
    rooms: dict[str, set[str]] = defaultdict(set)
    for name, path in modules().items():
        if "." in name:
            own = name.split(".")[1]
            others = {other.split(".")[1] for other in own_imports(path) if "." in other}
            rooms[own] |= others - {own}
    return dict(rooms)


def floors(rooms: Mapping[str, set[str]]) -> list[list[str]]:
    """Rooms by height above the ground, the highest first: a room stands just above the highest that it imports."""
    height = {}
    for name in sorted(rooms, key=lambda one: (len(reachable([one], rooms)), one)):
        height[name] = max((height[other] + 1 for other in rooms[name]), default=0)
    return [sorted(name for name in rooms if height[name] == level) for level in range(max(height.values()), -1, -1)]


def room_text(name: str, rooms: Mapping[str, set[str]]) -> str:
    """What a room holds and imports."""
    own = [module for module in modules() if module.startswith(f"{CORE}.{name}.")]
    inner = sorted({module.split(".")[2] for module in own if (ROOT / CORE / name / module.split(".")[2]).is_dir()})
    holds = f"{', '.join(inner)}. " if inner else ""
    uses = f"imports {', '.join(sorted(rooms[name]))}" if rooms[name] else "imports nothing of its own"
    return f"{holds}{uses}"


def wrapped(line: str, kind: str, width: float = BOX - 2 * PAD) -> list[tuple[str, str]]:
    """Text broken into lines that fit into `width` pixels."""
    most = int(width / (CHARACTER * TEXT_SIZE))
    lines = [""]
    for word in line.split(" "):
        if len(lines[-1]) + len(word) + 1 > most and lines[-1]:
            lines.append("")
        lines[-1] = f"{lines[-1]} {word}".strip()
    return [(one, kind) for one in lines]


def text(x: float, y: float, words: str, size: int, colour: str = INK, bold: bool = False) -> str:
    """A line of text."""
    weight = ' font-weight="bold"' if bold else ""
    return f'<text x="{x:g}" y="{y:g}" font-size="{size}" fill="{colour}"{weight}>{escape(words)}</text>'


def main() -> None:
    """Write the picture."""
    from qgis.core import QgsApplication

    from scripts.make_models import load_provider

    application, plugin = load_provider()
    provider = QgsApplication.processingRegistry().providerById("urbanmap")
    PICTURE.write_text(draw(provider.algorithms()), encoding="utf-8")
    print(PICTURE.relative_to(ROOT))
    plugin.unload()
    application.exitQgis()


if __name__ == "__main__":
    main()
