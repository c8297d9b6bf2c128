"""The core of UrbanMap: surveying mathematics on plain arrays, without QGIS."""
