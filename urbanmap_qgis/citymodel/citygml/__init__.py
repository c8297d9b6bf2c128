"""CityGML: what holds where in it, its readers and writers, and what PLATEAU asks for."""
