"""The version and the folder of the installed package."""

import os

VERSION = "0.1.0"
FOLDER = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
