#version 450
// Averages the samples of a multisampled image, as a shader does where nothing fixed-function is used.
layout(constant_id = 0) const int NUM_SAMPLES = 8;
layout(set = 0, binding = 0) uniform sampler2DMS scene;
layout(location = 0) out vec4 color;

void main() {
    vec4 sum = vec4(0.0);
    for (int i = 0; i < NUM_SAMPLES; i++)
        sum += texelFetch(scene, ivec2(gl_FragCoord.xy), i);
    color = sum / float(NUM_SAMPLES);
}
