"""A turning square in Qt Quick, on Vulkan in four samples, with a layer that has four samples of
its own.
"""

import sys
from pathlib import Path

from PySide6.QtCore import QTimer, QUrl
from PySide6.QtGui import QGuiApplication, QSurfaceFormat
from PySide6.QtQuick import QQuickView, QQuickWindow, QSGRendererInterface

FRAMES = 6

wanted = QSurfaceFormat.defaultFormat()
wanted.setSamples(4)
QSurfaceFormat.setDefaultFormat(wanted)
QQuickWindow.setGraphicsApi(QSGRendererInterface.Vulkan)
application = QGuiApplication(sys.argv)
view = QQuickView()
view.setSource(QUrl.fromLocalFile(str(Path(__file__).with_suffix(".qml"))))
swapped = []


def count():
    swapped.append(None)
    if len(swapped) == FRAMES:
        application.exit(0)


view.frameSwapped.connect(count)
view.show()
QTimer.singleShot(60_000, lambda: application.exit(1))
sys.exit(application.exec())
