#version 450
// Colour and alpha are stored apart, and some fragments are discarded.
layout(binding = 0) uniform sampler2D leaf;
layout(location = 0) in vec2 uv;
layout(location = 0) out vec4 color;

void main() {
    vec4 texel = texture(leaf, uv);
    if (texel.a < 0.1) discard;
    color.rgb = texel.rgb;
    color.a = texel.a;
}
