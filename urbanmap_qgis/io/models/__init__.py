"""Meshes and models of other programs: CityJSON, glTF, OBJ, PLY."""
