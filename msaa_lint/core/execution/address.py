"""Addresses of clusters."""

from __future__ import annotations

import re
import socket

CONNECT_SECONDS = 10.0
"""How long to wait for a cluster's answer."""

_ADDRESS = re.compile(r"(?:(?:tcp|tls|ray)://)?(?P<host>[^/\s]+):(?P<port>[0-9]{1,5})")


def check_listening(address: str) -> None:
    """OSError where nothing listens at an address `host:port`, with or without `tcp://`, `tls://`,
    or `ray://`. Nothing is known of others. The engines' own clients try again for a long time, or
    end the process.
    """
    if match := _ADDRESS.fullmatch(address):
        socket.create_connection(
            (match["host"].strip("[]"), min(int(match["port"]), 65535)), CONNECT_SECONDS
        ).close()
