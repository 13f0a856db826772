#version 450
// Alpha is written at location 1, and as the second source of location 0.
layout(location = 0, index = 0) out vec3 color;
layout(location = 0, index = 1) out vec4 second;

void main() {
    color = vec3(0.5);
    second = vec4(0.5);
}
