#version 450
// The output has no alpha.
layout(location = 0) in vec3 tint;
layout(location = 0) out vec3 color;

void main() {
    color = tint;
}
