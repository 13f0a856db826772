"""Settings of every test."""

from tests.strength import load_profile

load_profile()
