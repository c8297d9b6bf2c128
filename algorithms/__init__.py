"""The QGIS face of UrbanMap: the plugin, its Processing provider and one thin module for each algorithm."""
