"""The aerial reference: surface, occlusion, orthophotos, road markings."""
