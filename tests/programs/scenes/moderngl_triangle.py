"""A triangle in a framebuffer of four samples with ModernGL: python moderngl_triangle.py
blit|shader, which is how it is resolved.
"""

import struct
import sys

import glfw
import moderngl

SIZE, MODE = (640, 360), sys.argv[1]
VERTEX = "#version 330\nin vec2 at; void main() { gl_Position = vec4(at, 0.5, 1.0); }"
ORANGE = "#version 330\nout vec4 color; void main() { color = vec4(1.0, 0.5, 0.0, 1.0); }"
AVERAGE = """#version 330
uniform sampler2DMS samples;
out vec4 color;
void main() {
    color = vec4(0.0);
    for (int i = 0; i < 4; i++) color += texelFetch(samples, ivec2(gl_FragCoord.xy), i) / 4.0;
}
"""

glfw.init()
glfw.window_hint(glfw.VISIBLE, False)
glfw.window_hint(glfw.CONTEXT_VERSION_MAJOR, 3)
glfw.window_hint(glfw.CONTEXT_VERSION_MINOR, 3)
glfw.window_hint(glfw.OPENGL_PROFILE, glfw.OPENGL_CORE_PROFILE)
window = glfw.create_window(*SIZE, "triangle", None, None)
glfw.make_context_current(window)
context = moderngl.create_context()


def corners(fragment, *at):
    program = context.program(vertex_shader=VERTEX, fragment_shader=fragment)
    return context.vertex_array(program, [(context.buffer(struct.pack("6f", *at)), "2f", "at")])


triangle = corners(ORANGE, -0.8, -0.8, 0.8, -0.8, 0.0, 0.8)
everywhere = corners(AVERAGE, -1, -1, 3, -1, -1, 3)
color = (
    context.texture(SIZE, 4, samples=4, dtype="f2")
    if MODE == "shader"
    else context.renderbuffer(SIZE, 4, samples=4)
)
scene = context.framebuffer([color], context.depth_renderbuffer(SIZE, samples=4))
resolved = context.framebuffer([context.texture(SIZE, 4)])
for _ in range(6):
    scene.use()
    context.enable(moderngl.DEPTH_TEST)
    scene.clear(0, 0, 0, 1)
    triangle.render()
    if MODE == "shader":
        resolved.use()
        context.disable(moderngl.DEPTH_TEST)
        color.use(0)
        everywhere.render()
    else:
        context.copy_framebuffer(resolved, scene)
    context.copy_framebuffer(context.screen, resolved)
    glfw.swap_buffers(window)
