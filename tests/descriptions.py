"""Descriptions that several tests lint."""

CLEAN = """\
images:
  color_ms: {format: R8G8B8A8_UNORM, samples: 4, usage: [COLOR_ATTACHMENT, TRANSIENT_ATTACHMENT], memory: [DEVICE_LOCAL, LAZILY_ALLOCATED]}
  color: {format: R8G8B8A8_UNORM, samples: 1, usage: [COLOR_ATTACHMENT, SAMPLED], memory: [DEVICE_LOCAL]}
renderPasses:
  forward:
    attachments:
      color_ms: {image: color_ms, loadOp: CLEAR, storeOp: DONT_CARE, initialLayout: UNDEFINED, finalLayout: COLOR_ATTACHMENT_OPTIMAL}
      color: {image: color, loadOp: DONT_CARE, storeOp: STORE, initialLayout: UNDEFINED, finalLayout: SHADER_READ_ONLY_OPTIMAL}
    subpasses:
      - {colorAttachments: [color_ms], resolveAttachments: [color]}
"""
"""A frame without findings."""

STORED = CLEAN.replace("loadOp: CLEAR, storeOp: DONT_CARE", "loadOp: CLEAR, storeOp: STORE")
"""A frame that stores its samples: MSAA201 and MSAA403, at the first storeOp."""
