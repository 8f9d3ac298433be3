"""The provider of the algorithms, and the setting of Processing that says where the program is."""
import os

from processing.core.ProcessingConfig import ProcessingConfig, Setting
from qgis.core import QgsProcessingProvider
from qgis.PyQt.QtGui import QIcon

from .algorithm import PROGRAM_SETTING
from .buffer import Buffer
from .check import Check
from .pair import Pair
from .route import Route
from .separate import Separate
from .specification import Specification
from .sum import Sum

ICONS = os.path.join(os.path.dirname(__file__), "icons")


class SunderProvider(QgsProcessingProvider):
    def id(self):
        return "sunder"

    def name(self):
        return "Sunder"

    def longName(self):
        return "Sunder: features apart, provably by the least amount"

    def icon(self):
        return QIcon(self.svgIconPath())

    def svgIconPath(self):
        return os.path.join(ICONS, "sunder.svg")

    def load(self):
        ProcessingConfig.settingIcons[self.name()] = self.icon()
        ProcessingConfig.addSetting(Setting(self.name(), PROGRAM_SETTING,
                                            "The program sunder (empty: as found on the PATH)", "",
                                            valuetype=Setting.FILE))
        ProcessingConfig.readSettings()
        self.refreshAlgorithms()
        return True

    def unload(self):
        ProcessingConfig.removeSetting(PROGRAM_SETTING)

    def loadAlgorithms(self):
        for algorithm in (Separate, Check, Specification, Buffer, Sum, Pair, Route):
            self.addAlgorithm(algorithm())
