#version 450
// Samples are left out that some buffer names.
layout(binding = 0) uniform sampler2DMS scene;
layout(binding = 1) uniform Mask { uint mask; };
layout(location = 0) out vec4 color;

void main() {
    vec4 sum = vec4(0.0);
    for (int i = 0; i < 4; i++) {
        if ((mask & (1u << i)) == 0u) continue;
        sum += texelFetch(scene, ivec2(gl_FragCoord.xy), i);
    }
    color = sum / 4.0;
}
