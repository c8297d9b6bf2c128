"""UrbanMap: mobile mapping surveys on the aerial reference, and 3D building models, in QGIS."""


def classFactory(iface):
    """Make the plugin; QGIS calls this by its name."""
    from .algorithms.plugin import UrbanMapPlugin

    return UrbanMapPlugin(iface)
