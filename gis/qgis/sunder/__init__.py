"""Sunder in QGIS: the door of the plug-in."""


def classFactory(iface):
    """What QGIS calls; iface is None where there is no window."""
    from .plugin import SunderPlugin
    return SunderPlugin(iface)
