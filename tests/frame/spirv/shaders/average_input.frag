#version 450
// A subpass input.
layout(input_attachment_index = 1, set = 0, binding = 3) uniform subpassInputMS scene;
layout(location = 0) out vec4 color;

void main() {
    vec4 sum = vec4(0.0);
    for (int i = 0; i < 4; i++)
        sum += subpassLoad(scene, i);
    color = sum / 4.0;
}
