"""What an acceptance report says of the job: its name, who did it when, with what."""

from __future__ import annotations

from dataclasses import dataclass, fields

from ..wording import mark

WORDS = {
    "job": mark("Job"),
    "client": mark("Client"),
    "surveyor": mark("Surveyor"),
    "dates": mark("Dates of the work"),
    "instrument": mark("Instrument"),
    "method": mark("Method"),
    "reference": mark("Coordinate reference system"),
    "heights": mark("Height system"),
    "checked_by": mark("Checked by"),
}


@dataclass(frozen=True)
class Job:
    """Texts of the head of the report; what is empty is left for writing by hand."""

    job: str = ""
    client: str = ""
    surveyor: str = ""
    dates: str = ""
    instrument: str = ""
    method: str = ""
    reference: str = ""
    heights: str = ""
    checked_by: str = ""

    def rows(self) -> dict[str, str]:
        """Values by their words, a blank for what is filled in by hand."""
        return {WORDS[item.name]: getattr(self, item.name) or "\u2003" for item in fields(self)}
