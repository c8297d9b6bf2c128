"""The texture of one facade: for each texel the best view that nothing hides, brightness compensated, seams blended."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import cv2
import numpy as np

from ...settings.lines import TextureSettings
from ..views.obstacles import ViewObstacles
from ..views.views import Source, View
from .facades import Facade, Lattice, TexelGrid, lattice, on_facade

# Where places lie in images, and whether they are hidden, is found on a lattice of this step, m.
NODES = 0.25
BLEND = 0.3  # Views pass into each other over this width, m.
OVERLAP = 200  # Texels that two views must share for their brightness to be compared.
UNSEEN = 190  # Grey of texels that no image shows.

NOT_FACED, HIDDEN = "no image looks at it", "hidden in all images"


@dataclass(frozen=True, eq=False)
class FacadeTexture:
    """A facade's texture and how well it was seen.

    Attributes
    ----------
    pixels : (rows, columns, 3) uint8, None where there is none.
    seen : (rows, columns) mask of the texels that an image shows.
    share : of the facade's area that is seen, 0 to 1.
    detail : median pixels a metre of the images where they were used; NaN without any.
    images : numbers of the images used.
    reason : why there is no texture; empty if there is one.
    """

    pixels: np.ndarray | None
    seen: np.ndarray
    share: float
    detail: float
    images: tuple[int, ...]
    reason: str = ""


def texture_facade(facade: Facade, grid: TexelGrid, sources: Sequence[Source],
                   obstacles: Callable[[np.ndarray], ViewObstacles], settings: TextureSettings) -> FacadeTexture:
    """Texture one facade (Z 4.2: image pixels projected and resampled onto the plane of the facade).

    Parameters
    ----------
    grid : its texels.
    obstacles : gives what may hide the facade from cameras (n, 3); asked only when an image looks at it.
    """
    face = on_facade(facade, grid)
    nodes = lattice(facade, grid, max(NODES, grid.step))
    views = [view for source in sources for view in source.views(nodes.places, facade.normal, settings.max_range)]
    views = [view for view in views if (view.detail >= settings.min_detail).any()]
    if not views:
        return _untextured(grid, NOT_FACED)
    shown = [_shown(view, facade, nodes, obstacles, settings) for view in views]
    detail = np.array([nodes.between(view.detail)[face] for view in views])
    visible = np.array([nodes.nearest(mask)[face] for mask in shown]) & (detail >= settings.min_detail)
    seen = visible.any(axis=0)
    share = float(seen.mean()) if seen.size else 0.0
    if share < max(settings.min_seen, 1e-9):
        return _untextured(grid, HIDDEN)
    best = np.argmax(np.where(visible, detail, -np.inf), axis=0)
    colours = _colours(views, nodes, face, visible, {source.number: source for source in sources})
    gains = compensation_gains(colours, visible)
    pixels = _blended(grid, face, colours * gains[:, None, :], visible, np.where(seen, best, -1))
    used = np.unique(best[seen])
    mask = np.zeros(face.shape, bool)
    mask[face] = seen
    return FacadeTexture(pixels, mask, share, float(np.median(detail[best[seen], np.flatnonzero(seen)])),
                         tuple(sorted({views[number].image for number in used})))


def _untextured(grid: TexelGrid, reason: str) -> FacadeTexture:
    return FacadeTexture(None, np.zeros((grid.rows, grid.columns), bool), 0.0, np.nan, (), reason)


def _shown(view: View, facade: Facade, nodes: Lattice, obstacles: Callable[[np.ndarray], ViewObstacles],
           settings: TextureSettings) -> np.ndarray:
    """Mask (nodes,) of the places that a view shows well enough and that nothing hides from it."""
    shown = view.detail >= settings.min_detail
    looked = np.flatnonzero(shown)
    if len(looked):
        cameras = view.camera[looked]
        shown[looked] = ~obstacles(cameras).hidden(nodes.places[looked], cameras, facade.normal)
    return shown


def _colours(views: Sequence[View], nodes: Lattice, face: np.ndarray, visible: np.ndarray,
             sources: dict[int, Source]) -> np.ndarray:
    """Colours (views, n, 3) float32 of the visible texels, 0 elsewhere."""
    colours = np.zeros((*visible.shape, 3), np.float32)
    for number, view in enumerate(views):
        seen = np.flatnonzero(visible[number])
        if len(seen):
            column, row = (nodes.between(values)[face][seen] for values in (view.column, view.row))
            colours[number, seen] = sources[view.image].colours(column, row)
    return colours


def compensation_gains(colours: np.ndarray, visible: np.ndarray) -> np.ndarray:
    """Factors (views, 3) that compensate differences of brightness and colour between views where they show the same
    texels.

    The logarithms of the factors are the least squares solution of the median ratios of all pairs of views that share
    enough texels, weighted by how many; their mean, weighted by the texels of each view, is nought.

    Parameters
    ----------
    colours : (views, n, 3).
    visible : (views, n).
    """
    count = len(colours)
    rows, ratios = [], []
    for a in range(count):
        for b in range(a + 1, count):
            both = visible[a] & visible[b]
            if both.sum() >= OVERLAP:
                weight = np.sqrt(both.sum())
                row = np.zeros(count)
                row[[a, b]] = weight, -weight
                rows.append(row)
                ratio = np.log(np.maximum(colours[b][both], 1.0) / np.maximum(colours[a][both], 1.0))
                ratios.append(weight * np.median(ratio, axis=0))
    if not rows:
        return np.ones((count, 3), np.float32)
    share = visible.sum(axis=1) / max(visible.sum(), 1)
    design = np.vstack([*rows, 1e-3 * np.eye(count), 1e3 * share])
    wanted = np.vstack([*ratios, np.zeros((count + 1, 3))])
    return np.exp(np.linalg.lstsq(design, wanted, rcond=None)[0]).astype(np.float32)


def _blended(grid: TexelGrid, face: np.ndarray, colours: np.ndarray, visible: np.ndarray,
             best: np.ndarray) -> np.ndarray:
    """Pixels (rows, columns, 3) uint8: each texel from its best view, passing softly into the neighbour's view."""
    total = np.zeros((*face.shape, 3), np.float32)
    weights = np.zeros(face.shape, np.float32)
    side = 2 * max(round(BLEND / grid.step / 2), 1) + 1
    for number in np.unique(best[best >= 0]):
        chosen = np.zeros(face.shape, np.float32)
        chosen[face] = best == number
        shown = np.zeros(face.shape, np.float32)
        shown[face] = visible[number]
        weight = cv2.blur(chosen, (side, side), borderType=cv2.BORDER_REPLICATE) * shown
        layer = np.zeros((*face.shape, 3), np.float32)
        layer[face] = colours[number]
        total += weight[:, :, None] * layer
        weights += weight
    seen = weights > 0
    pixels = np.full((*face.shape, 3), UNSEEN, np.uint8)
    pixels[seen] = np.clip(np.rint(total[seen] / weights[seen][:, None]), 0, 255).astype(np.uint8)
    return pixels
