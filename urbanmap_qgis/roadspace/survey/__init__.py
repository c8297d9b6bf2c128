"""Roads as a survey shows them: carriageways between measured kerbs, junctions, lanes, sidewalks, islands, steps."""
