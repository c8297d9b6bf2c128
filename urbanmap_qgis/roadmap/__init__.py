"""Lane maps from the paint of roads and the drives on them (J 6.2)."""
