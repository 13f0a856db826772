"""A card with Panda3D, in a window of four samples."""

from panda3d.core import loadPrcFileData

loadPrcFileData(
    "",
    "framebuffer-multisample 1\nmultisamples 4\nwin-size 640 360\naudio-library-name null\n"
    "sync-video 0\nauto-flip 1",
)
from direct.showbase.ShowBase import ShowBase  # noqa: E402
from panda3d.core import AntialiasAttrib, CardMaker  # noqa: E402

base = ShowBase()
base.render.setAntialias(AntialiasAttrib.MMultisample)
maker = CardMaker("card")
maker.setFrame(-1, 1, -1, 1)
card = base.render.attachNewNode(maker.generate())
card.setPos(0, 5, 0)
for frame in range(6):
    card.setR(frame * 10)
    base.taskMgr.step()
