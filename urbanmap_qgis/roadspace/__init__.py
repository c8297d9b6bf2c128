"""Road space: the surfaces of roads and junctions as models of cities hold them."""
