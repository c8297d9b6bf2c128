"""Point clouds: LAS, LAZ and COPC, checked before they are decoded, read in chunks and buckets."""
