"""Repairs the characters of RenderDoc's XML."""

from __future__ import annotations

import codecs
import re

# References to control characters, which XML 1.0 forbids; two digits each.
_CONTROL = re.compile(rb"&#(?:0[0-8]|1[124-9]|2\d|3[01]);")
_PARTIAL_REFERENCE = re.compile(rb"&(?:#(?:\d\d?)?)?\Z")


class XmlRepair:
    """Repairs RenderDoc's XML, which has names verbatim, in any encoding, block by block.

    Control characters become question marks, invalid UTF-8 becomes U+FFFD. Positions do not
    change."""

    def __init__(self) -> None:
        self.decoder = codecs.getincrementaldecoder("utf-8")("replace")
        self.ascii = True
        self.rest = b""

    def repair(self, block: bytes, last: bool) -> bytes:
        """Repairs the next block. A reference or character that continues in the following block is
        held back.
        """
        if not (self.ascii and block.isascii()):
            self.ascii = False
            block = self.decoder.decode(block, last).encode()
        if self.rest:
            block = self.rest + block
            self.rest = b""
        if b"&" not in block:
            return block
        partial = None if last else _PARTIAL_REFERENCE.search(block, max(0, len(block) - 4))
        if partial is not None:
            self.rest = block[partial.start() :]
            block = block[: partial.start()]
        return _CONTROL.sub(b"&#63;", block)
