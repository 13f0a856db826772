#version 450
// Alpha comes from a texture.
layout(set = 0, binding = 0) uniform sampler2D leaf;
layout(location = 0) in vec2 uv;
layout(location = 0) out vec4 color;

void main() {
    color = texture(leaf, uv);
}
