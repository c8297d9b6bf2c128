"""UrbanMap: mobile mapping surveys on the aerial reference, and 3D building models, in QGIS."""

import sys

# What a version of the plugin that QGIS has unloaded left behind must not be mixed with this one.
for _name in [name for name in sys.modules if name.startswith(f"{__name__}.")]:
    del sys.modules[_name]


def classFactory(iface):
    """Make the plugin; QGIS calls this by its name."""
    from .algorithms.plugin import UrbanMapPlugin

    return UrbanMapPlugin(iface)
