"""From aerial frames to the reference: occlusion, orthophoto, road markings (J 3.2)."""
