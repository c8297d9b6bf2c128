"""What all algorithms stand on: base class, parameters, layers, CRS, workers, packages."""
