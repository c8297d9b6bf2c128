"""2.5D meshes of complex and curved buildings from their points (J 5.7, figure 5-13)."""
