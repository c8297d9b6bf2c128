"""What an acceptance report says of the job: its name, who did it when, with what.

The head is that of the tables of quality control (精度管理表) among the standard forms of Japan's rules for public
surveys (作業規程の準則, appendix 4).
"""

from __future__ import annotations

from dataclasses import dataclass, fields

from ..wording import mark

WORDS = {
    "job": mark("Job"),
    "area": mark("Area of the work"),
    "client": mark("Client"),
    "surveyor": mark("Surveyor"),
    "dates": mark("Dates of the work"),
    "chief": mark("Chief engineer"),
    "leader": mark("Survey party leader"),
    "quantity": mark("Quantity of work"),
    "instrument": mark("Instrument"),
    "method": mark("Method"),
    "reference": mark("Coordinate reference system"),
    "heights": mark("Height system"),
    "checked_by": mark("Checked by"),
    "remarks": mark("Remarks"),
}


@dataclass(frozen=True)
class Job:
    """Texts of the head of the report; what is empty is left for writing by hand."""

    job: str = ""
    area: str = ""
    client: str = ""
    surveyor: str = ""
    dates: str = ""
    chief: str = ""
    leader: str = ""
    quantity: str = ""
    instrument: str = ""
    method: str = ""
    reference: str = ""
    heights: str = ""
    checked_by: str = ""
    remarks: str = ""

    def rows(self) -> dict[str, str]:
        """Values by their words, a blank for what is filled in by hand."""
        return {WORDS[item.name]: getattr(self, item.name) or "\u2003" for item in fields(self)}
