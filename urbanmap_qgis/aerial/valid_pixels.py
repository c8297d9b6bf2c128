"""Where an image file holds an image; white that its no-data value stands for as well is part of it."""

from __future__ import annotations

import cv2
import numpy as np
import rasterio
from rasterio.enums import MaskFlags
from rasterio.windows import Window

WHITE_SPECK = 400
"""Pixels; no-data of the brightest value that is no longer and no wider is white within the image."""


def valid_pixels(source: rasterio.io.DatasetReader, window: Window) -> tuple[np.ndarray, int]:
    """Where a window holds an image by the file's own word (no-data value, alpha, mask), bool, and how many pixels of
    it are saturated white which the no-data value stands for as well (`WHITE_SPECK`); what is found does not depend
    on the window."""
    kind = np.dtype(source.dtypes[0])
    if not (kind.kind == "u" and source.nodata == np.iinfo(kind).max and MaskFlags.nodata in source.mask_flag_enums[0]):
        return source.dataset_mask(window=window) > 0, 0
    top, left = (max(int(first) - WHITE_SPECK, 0) for first in (window.row_off, window.col_off))
    rows = min(int(window.row_off + window.height) + WHITE_SPECK, source.height) - top
    columns = min(int(window.col_off + window.width) + WHITE_SPECK, source.width) - left
    valid = source.dataset_mask(window=Window(left, top, columns, rows)) > 0
    _, label, stats, _ = cv2.connectedComponentsWithStats((~valid).astype(np.uint8), connectivity=8)
    x, y, width, height = stats[:, :4].T
    inside = (x + left > 0) & (y + top > 0) & (x + left + width < source.width) & (y + top + height < source.height)
    white = inside & (np.maximum(width, height) <= WHITE_SPECK)
    white[0] = False  # the image itself
    own = (slice(int(window.row_off) - top, int(window.row_off + window.height) - top),
           slice(int(window.col_off) - left, int(window.col_off + window.width) - left))
    specks = white[label[own]]
    return valid[own] | specks, int(np.count_nonzero(specks))
