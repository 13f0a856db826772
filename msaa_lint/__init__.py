"""msaa-lint finds the multisampling mistakes in a Vulkan frame.

`lint` is the whole Python interface; everything else is internal and may change.
"""

from __future__ import annotations

__version__ = "0.1.0"
