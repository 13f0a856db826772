"""The installed package: its version, and where it stands."""

import os

VERSION = "0.1.0"
FOLDER = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
