#version 450
// Averages the samples of an input attachment, on the tile.
layout(constant_id = 0) const int NUM_SAMPLES = 8;
layout(input_attachment_index = 0, set = 0, binding = 0) uniform subpassInputMS scene;
layout(location = 0) out vec4 color;

void main() {
    vec4 sum = vec4(0.0);
    for (int i = 0; i < NUM_SAMPLES; i++)
        sum += subpassLoad(scene, i);
    color = sum / float(NUM_SAMPLES);
}
