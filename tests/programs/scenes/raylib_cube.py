"""A cube and a texture drawn before it with raylib, in a window of four samples."""

import pyray

pyray.set_config_flags(pyray.ConfigFlags.FLAG_MSAA_4X_HINT)
pyray.init_window(640, 360, "cube")
camera = pyray.Camera3D([4, 4, 4], [0, 0, 0], [0, 1, 0], 45, 0)
circle = pyray.load_render_texture(256, 256)
for _ in range(6):
    pyray.begin_texture_mode(circle)
    pyray.clear_background(pyray.RED)
    pyray.draw_circle(128, 128, 90, pyray.BLUE)
    pyray.end_texture_mode()
    pyray.begin_drawing()
    pyray.clear_background(pyray.RAYWHITE)
    pyray.begin_mode_3d(camera)
    pyray.draw_cube([0, 0, 0], 2, 2, 2, pyray.ORANGE)
    pyray.end_mode_3d()
    pyray.draw_texture(circle.texture, 0, 0, pyray.WHITE)
    pyray.end_drawing()
pyray.close_window()
