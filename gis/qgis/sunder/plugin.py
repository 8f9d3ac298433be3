"""The plug-in as QGIS sees it: a provider of algorithms, nothing else."""
from qgis.core import QgsApplication

from .provider import SunderProvider


class SunderPlugin:
    def __init__(self, iface):
        self.iface = iface
        self.provider = None

    def initProcessing(self):
        """All that is called where there is no window (qgis_process)."""
        self.provider = SunderProvider()
        QgsApplication.processingRegistry().addProvider(self.provider)

    def initGui(self):
        self.initProcessing()

    def unload(self):
        QgsApplication.processingRegistry().removeProvider(self.provider)
