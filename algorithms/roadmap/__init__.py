"""Road map: lines and lanes from the paint of roads and the drives on them."""
