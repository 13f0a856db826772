"""A triangle in four samples with wgpu, offscreen: python wgpu_triangle.py
discard|store|two|depth.
"""

import sys

import wgpu

WIDTH, HEIGHT, FRAMES = 640, 360, 4
MODE = sys.argv[1]
TRIANGLE = """
@vertex fn vertex(@builtin(vertex_index) i: u32) -> @builtin(position) vec4f {
    return vec4f(f32(i32(i) - 1), f32(i32(i & 1u) * 2 - 1), 0.5, 1.0);
}
@fragment fn fragment() -> @location(0) vec4f { return vec4f(1.0, 0.5, 0.0, 1.0); }
"""
FARTHEST = """
@group(0) @binding(0) var depth: texture_depth_multisampled_2d;
@vertex fn vertex(@builtin(vertex_index) i: u32) -> @builtin(position) vec4f {
    return vec4f(f32((i << 1u) & 2u) * 2.0 - 1.0, f32(i & 2u) * 2.0 - 1.0, 0.0, 1.0);
}
@fragment fn fragment(@builtin(position) at: vec4f) -> @location(0) vec4f {
    var farthest = 0.0;
    for (var i = 0; i < 4; i++) { farthest = max(farthest, textureLoad(depth, vec2i(at.xy), i)); }
    return vec4f(farthest);
}
"""

device = wgpu.gpu.request_adapter_sync().request_device_sync()
target, read = wgpu.TextureUsage.RENDER_ATTACHMENT, wgpu.TextureUsage.TEXTURE_BINDING


def texture(label, format, samples, usage):
    return device.create_texture(
        size=(WIDTH, HEIGHT, 1), format=format, sample_count=samples, usage=usage, label=label
    )


def pipeline(code, format, **state):
    module = device.create_shader_module(code=code)
    return device.create_render_pipeline(
        layout="auto",
        vertex={"module": module, "entry_point": "vertex"},
        fragment={"module": module, "entry_point": "fragment", "targets": [{"format": format}]},
        primitive={"topology": "triangle-list"},
        **state,
    )


color = texture("scene color", "rgba8unorm", 4, target)
depth = texture("scene depth", "depth24plus", 4, target | read if MODE == "depth" else target)
resolved = texture("resolved color", "rgba8unorm", 1, target | read | wgpu.TextureUsage.COPY_SRC)
triangle = pipeline(
    TRIANGLE,
    "rgba8unorm",
    depth_stencil={"format": "depth24plus", "depth_write_enabled": True, "depth_compare": "less"},
    multisample={"count": 4},
)
if MODE == "depth":
    farthest = texture("farthest depth", "r32float", 1, target | read)
    reduce = pipeline(FARTHEST, "r32float")
    group = device.create_bind_group(
        layout=reduce.get_bind_group_layout(0),
        entries=[{"binding": 0, "resource": depth.create_view()}],
    )


def scene(encoder, label, load, store, depth_store, resolve=True):
    """A pass that draws the triangle."""
    attached = encoder.begin_render_pass(
        label=label,
        color_attachments=[
            {
                "view": color.create_view(),
                "resolve_target": resolved.create_view() if resolve else None,
                "load_op": load,
                "store_op": store,
                "clear_value": (0, 0, 0, 1),
            }
        ],
        depth_stencil_attachment={
            "view": depth.create_view(), "depth_load_op": load, "depth_store_op": depth_store,
            "depth_clear_value": 1.0,
        },
    )  # fmt: skip
    attached.set_pipeline(triangle)
    attached.draw(3)
    attached.end()


for _ in range(FRAMES):
    encoder = device.create_command_encoder()
    if MODE == "discard":
        scene(encoder, "scene", "clear", "discard", "discard")
    elif MODE == "store":
        scene(encoder, "scene", "clear", "store", "store")
    elif MODE == "two":
        scene(encoder, "opaque", "clear", "store", "store", resolve=False)
        scene(encoder, "transparent", "load", "discard", "discard")
    elif MODE == "depth":
        scene(encoder, "scene", "clear", "discard", "store")
        attached = encoder.begin_render_pass(
            label="depth",
            color_attachments=[
                {"view": farthest.create_view(), "load_op": "clear", "store_op": "store"}
            ],
        )
        attached.set_pipeline(reduce)
        attached.set_bind_group(0, group)
        attached.draw(3)
        attached.end()
    device.queue.submit([encoder.finish()])
device.queue.read_texture({"texture": resolved}, {"bytes_per_row": WIDTH * 4}, (WIDTH, HEIGHT, 1))
