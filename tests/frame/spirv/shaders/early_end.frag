#version 450
// A loop over the samples that may end before.
layout(binding = 0) uniform sampler2DMS scene;
layout(location = 0) in float limit;
layout(location = 0) out vec4 color;

void main() {
    vec4 sum = vec4(0.0);
    for (int i = 0; i < 8; i++) {
        if (limit * i > 1.0) break;
        sum += texelFetch(scene, ivec2(gl_FragCoord.xy), i);
    }
    color = sum / 8.0;
}
