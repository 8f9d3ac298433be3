"""The plug-in object of QGIS. It adds a provider of algorithms, and nothing else."""
from qgis.core import QgsApplication

from .provider import SunderProvider


class SunderPlugin:
    def __init__(self, iface):
        self.iface = iface
        self.provider = None

    def initProcessing(self):
        """Adds the provider. Without a window (qgis_process) QGIS calls only this function."""
        self.provider = SunderProvider()
        QgsApplication.processingRegistry().addProvider(self.provider)

    def initGui(self):
        self.initProcessing()

    def unload(self):
        QgsApplication.processingRegistry().removeProvider(self.provider)
