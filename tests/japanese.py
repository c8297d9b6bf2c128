"""English words in Japanese text, for the tests of translations."""

from __future__ import annotations

import re

NAMES = set("""
    UrbanMap QGIS Python PyPI Dask GDAL PROJ Autoware OpenStreetMap Cesium PLATEAU README Javanmardi Shibasaki
    Unix Zhao Zhang Applanix Metashape Pix Omega Phi Kappa Project Galileo BeiDou TransverseMercator distributed numpy
""".split())  # noqa: SIM905
"""Proper names of programs, projects, authors and systems."""

FORMATS = set("""
    CityGML CityJSON CityJSONSeq GeoParquet GeoPackage GeoTIFF Parquet Lanelet lanelet lanelets OpenDRIVE glTF
    Wavefront Tiles LoD lod BldA BldL RdEdg RdCompt MultiPolygonZ PolygonZ LineStringZ PointZ zip gzip bzip Hatanaka
    Dataset gml txt pdf
""".split())  # noqa: SIM905
"""Formats, kinds of files and their parts; those in capital letters only need no entry."""

UNITS = set("""
    cm mm km dm dB Hz sigma px
""".split())  # noqa: SIM905

FORMULA = set("""
    R_omega R_phi R_kappa I_ref I_m I_M exp sin cos f(R)
""".split())  # noqa: SIM905


def english(text: str, ids: frozenset[str] | set[str]) -> list[str]:
    """English words of a text that are no ids; files' names, paths, options and capital letters are none."""
    text = re.sub(r"\{[^}]*\}|https?://\S+|tcp://\S+", " ", text)
    text = re.sub(r"EPSG:\d+ ?[（(]JGD\d+ / Japan Plane Rectangular CS [IVX]+[）)]", " ", text)
    text = re.sub(r"JGD\d+ / Japan Plane Rectangular CS [IVX]+", " ", text)
    text = re.sub(r"[\w./*-]*\.[A-Za-z][A-Za-z0-9]{1,6}\b", " ", text)
    text = re.sub(r"\b[A-Za-z0-9]+\.[A-Za-z]+-\d{3}\b|\b[A-Z]-[a-z]+-\w+\b", " ", text)  # codes of rules
    text = re.sub(r"\b[a-z]+:\w+", " ", text)  # ids of algorithms, names of a schema
    words = re.findall(r"[A-Za-z][A-Za-z_]+", text)
    known = NAMES | FORMATS | UNITS | FORMULA | ids
    return [word for word in words if word not in known and not word.isupper()]
