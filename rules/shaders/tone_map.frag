#version 450
// Tone maps each sample and averages the results: no fixed-function resolve does that.
layout(constant_id = 0) const int NUM_SAMPLES = 8;
layout(set = 0, binding = 0) uniform sampler2DMS scene;
layout(location = 0) out vec4 color;

void main() {
    vec3 sum = vec3(0.0);
    for (int i = 0; i < NUM_SAMPLES; i++) {
        vec3 light = texelFetch(scene, ivec2(gl_FragCoord.xy), i).rgb;
        sum += light / (1.0 + light);
    }
    color = vec4(sum / float(NUM_SAMPLES), 1.0);
}
