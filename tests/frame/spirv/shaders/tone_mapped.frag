#version 450
// Tone mapping of each sample before they are averaged: nothing fixed-function does that.
layout(binding = 0) uniform sampler2DMS scene;
layout(location = 0) out vec4 color;

void main() {
    vec3 sum = vec3(0.0);
    for (int i = 0; i < 4; i++) {
        vec3 own = texelFetch(scene, ivec2(gl_FragCoord.xy), i).rgb;
        sum += own / (1.0 + own);
    }
    color = vec4(sum / 4.0, 1.0);
}
