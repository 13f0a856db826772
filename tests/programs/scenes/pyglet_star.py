"""A star with pyglet, in a window of four samples. The first frame draws again after the clear."""

import pyglet
from pyglet.gl import Config

window = pyglet.window.Window(
    640,
    360,
    config=Config(sample_buffers=1, samples=4, double_buffer=True, depth_size=24),
    vsync=False,
)
star = pyglet.shapes.Star(320, 180, 150, 60, 7, color=(255, 128, 0))
for frame in range(6):
    window.switch_to()
    window.dispatch_events()
    window.clear()
    star.rotation = frame * 10
    star.draw()
    window.flip()
