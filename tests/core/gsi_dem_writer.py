"""Elevation models as the GSI packs them, written from its specification and from nothing of the reader."""

from __future__ import annotations

HEAD = """<?xml version="1.0" encoding="UTF-8"?>
<Dataset xsi:schemaLocation="http://fgd.gsi.go.jp/spec/2008/FGD_GMLSchema FGD_GMLSchema.xsd"
 xmlns:gml="http://www.opengis.net/gml/3.2" xmlns:xsi="http://www.w3.org/2001/XMLSchema-instance"
 xmlns:xlink="http://www.w3.org/1999/xlink" xmlns="http://fgd.gsi.go.jp/spec/2008/FGD_GMLSchema" gml:id="Dataset1">
<gml:description>基盤地図情報メタデータ ID=fmdid:15-3101</gml:description>
<gml:name>基盤地図情報ダウンロードデータ(GML版)</gml:name>
"""


def third_mesh_corner(code: str) -> tuple[float, float]:
    """South and west, degrees, of a mesh of 4, 6 or 8 digits (JIS X 0410)."""
    south, west = int(code[:2]) / 1.5, int(code[2:4]) + 100.0
    if len(code) >= 6:
        south, west = south + int(code[4]) / 12, west + int(code[5]) / 8
    if len(code) == 8:
        south, west = south + int(code[6]) / 120, west + int(code[7]) / 80
    return south, west


def mesh_size(code: str) -> tuple[float, float]:
    """Degrees of latitude and longitude of a mesh of 6 or 8 digits."""
    return (1 / 12, 1 / 8) if len(code) == 6 else (1 / 120, 1 / 80)


def dem_xml(code: str, lines, rows: int, columns: int, start=(0, 0), srs="fguuid:jgd2011.bl", order="+x-y",
            date="2016-10-01", name="5mメッシュ(標高)") -> str:
    """A file of one mesh; `lines` are texts such as "地表面,12.30"."""
    south, west = third_mesh_corner(code)
    high, wide = mesh_size(code)
    body = "\n".join(lines)
    return HEAD + f"""<DEM gml:id="DEM001">
<fid>fgoid:10-00100-15-60101-{code}</fid>
<lfSpanFr gml:id="DEM001-1"><gml:timePosition>{date}</gml:timePosition></lfSpanFr>
<devDate gml:id="DEM001-2"><gml:timePosition>{date}</gml:timePosition></devDate>
<orgGILvl>0</orgGILvl><orgMDId>H22E5007</orgMDId><type>{name}</type><mesh>{code}</mesh>
<coverage gml:id="DEM001-3">
<gml:boundedBy><gml:Envelope srsName="{srs}">
<gml:lowerCorner>{south:.9f} {west:.9f}</gml:lowerCorner>
<gml:upperCorner>{south + high:.9f} {west + wide:.9f}</gml:upperCorner>
</gml:Envelope></gml:boundedBy>
<gml:gridDomain><gml:Grid dimension="2" gml:id="DEM001-4"><gml:limits><gml:GridEnvelope>
<gml:low>0 0</gml:low><gml:high>{columns - 1} {rows - 1}</gml:high></gml:GridEnvelope></gml:limits>
<gml:axisLabels>x y</gml:axisLabels></gml:Grid></gml:gridDomain>
<gml:rangeSet><gml:DataBlock>
<gml:rangeParameters><gml:QuantityList uom="DEM構成点"></gml:QuantityList></gml:rangeParameters>
<gml:tupleList>
{body}
</gml:tupleList></gml:DataBlock></gml:rangeSet>
<gml:coverageFunction><gml:GridFunction><gml:sequenceRule order="{order}">Linear</gml:sequenceRule>
<gml:startPoint>{start[0]} {start[1]}</gml:startPoint></gml:GridFunction></gml:coverageFunction>
</coverage>
</DEM>
</Dataset>
"""


def plane_lines(code: str, rows: int, columns: int, height) -> list[str]:
    """Lines of a mesh whose ground is height(latitude, longitude) at the cells' middles, from the north-west."""
    south, west = third_mesh_corner(code)
    high, wide = mesh_size(code)
    lines = []
    for row in range(rows):
        latitude = south + high - (row + 0.5) * high / rows
        for column in range(columns):
            lines.append(f"地表面,{height(latitude, west + (column + 0.5) * wide / columns):.2f}")
    return lines
