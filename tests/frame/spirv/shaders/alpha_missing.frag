#version 450
// The output has an alpha, and nothing is stored to it.
layout(location = 0) in vec3 tint;
layout(location = 0) out vec4 color;

void main() {
    color.rgb = tint;
}
