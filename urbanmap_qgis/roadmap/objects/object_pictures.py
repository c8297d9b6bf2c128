"""A map of street objects, as SVG."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from .object_records import BOLLARD, LAMP, MEASURED, OTHER, POLE, SIGN, SIGNAL, TREE, StreetObject

COLOURS = {POLE: "#222222", LAMP: "#e0a800", SIGNAL: "#d7263d", SIGN: "#2b5fb8", TREE: "#3f8f63", BOLLARD: "#8a5a2b",
           OTHER: "#8a6bb0"}


def object_map(objects: Sequence[StreetObject], path: np.ndarray, width: int = 760, margin: float = 20.0) -> str:
    """Objects by kind, doubtful ones hollow, and the path (n, 2) driven; `margin` in m."""
    feet = np.array([thing.foot[:2] for thing in objects]).reshape(-1, 2)
    every = np.concatenate([feet, path])
    low, high = every.min(axis=0) - margin, every.max(axis=0) + margin
    scale = width / max(high[0] - low[0], (high[1] - low[1]) / 1.2)
    size = np.ceil((high - low) * scale).astype(int)

    def screen(places: np.ndarray) -> np.ndarray:
        return np.column_stack([(places[:, 0] - low[0]) * scale, (high[1] - places[:, 1]) * scale])

    step = max(len(path) // 2000, 1)
    line = "L".join(f"{x:.1f} {y:.1f}" for x, y in screen(path[::step]))
    parts = [f'<rect width="{size[0]}" height="{size[1]}" fill="#ffffff"/>',
             f'<path d="M{line}" fill="none" stroke="#b5b5b5" stroke-width="2"/>']
    for thing, (x, y) in zip(objects, screen(feet)):
        colour = COLOURS[thing.kind]
        fill = colour if thing.status == MEASURED else "#ffffff"
        parts.append(f'<circle cx="{x:.1f}" cy="{y:.1f}" r="4" fill="{fill}" stroke="{colour}" stroke-width="1.4"/>')
    return (f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {size[0]} {size[1]}" width="{size[0]}" '
            f'height="{size[1]}">{"".join(parts)}</svg>')
