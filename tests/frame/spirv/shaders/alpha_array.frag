#version 450
layout(location = 0) in vec4 tint;
layout(location = 0) out vec4 targets[2];

void main() {
    targets[0] = tint;
    targets[1] = vec4(0.0);
}
