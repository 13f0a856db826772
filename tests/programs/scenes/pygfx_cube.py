"""A cube with pygfx, which smooths edges in post-processing: no image is multisampled."""

import numpy
import pygfx
from rendercanvas.offscreen import RenderCanvas

canvas = RenderCanvas(size=(640, 360), pixel_ratio=1)
renderer = pygfx.renderers.WgpuRenderer(canvas)
scene = pygfx.Scene()
cube = pygfx.Mesh(pygfx.box_geometry(200, 200, 200), pygfx.MeshPhongMaterial(color="#336699"))
scene.add(cube, pygfx.AmbientLight(), pygfx.DirectionalLight())
camera = pygfx.PerspectiveCamera(70, 16 / 9)
camera.local.z = 400
canvas.request_draw(lambda: renderer.render(scene, camera))
for frame in range(4):
    cube.local.rotation = (0, numpy.sin(frame / 10), 0, numpy.cos(frame / 10))
    canvas.draw()
