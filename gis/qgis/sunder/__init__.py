"""The plug-in Sunder for QGIS: the function that QGIS calls to load it."""


def classFactory(iface):
    """Returns the plug-in. iface is the interface of QGIS, or None if there is no window."""
    from .plugin import SunderPlugin
    return SunderPlugin(iface)
