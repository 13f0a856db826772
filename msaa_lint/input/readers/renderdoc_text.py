"""What RenderDoc writes that XML does not allow: names as programs give them, in any encoding, with control characters."""

from __future__ import annotations

import codecs
import re

# The control characters that XML 1.0 has no reference to; two digits each.
_CONTROL = re.compile(rb"&#(?:0[0-8]|1[124-9]|2\d|3[01]);")
_BEGUN = re.compile(rb"&(?:#(?:\d\d?)?)?\Z")


class Text:
    """Mends the blocks of a file: a question mark for a control character, U+FFFD for what is no UTF-8. Places stay what they are."""

    def __init__(self) -> None:
        self.decoder = codecs.getincrementaldecoder("utf-8")("replace")
        self.ascii = True
        self.rest = b""

    def mended(self, block: bytes, last: bool) -> bytes:
        """The next block, and what was kept of the one before it, as a reference or a character may be cut in two."""
        if not (self.ascii and block.isascii()):
            self.ascii = False
            block = self.decoder.decode(block, last).encode()
        if self.rest:
            block = self.rest + block
            self.rest = b""
        if b"&" not in block:
            return block
        begun = None if last else _BEGUN.search(block, max(0, len(block) - 4))
        if begun is not None:
            self.rest = block[begun.start() :]
            block = block[: begun.start()]
        return _CONTROL.sub(b"&#63;", block)
