#version 450
// May run for every sample: one input is interpolated there.
layout(location = 0) in vec4 tint;
layout(location = 1) sample in vec3 normal;
layout(location = 0) out vec4 color;

void main() {
    color = tint * normal.z;
}
