#version 450
// An output of its own for alpha.
layout(location = 0) in vec4 tint;
layout(location = 0) out vec3 color;
layout(location = 0, component = 3) out float alpha;

void main() {
    color = tint.rgb;
    alpha = tint.a;
}
