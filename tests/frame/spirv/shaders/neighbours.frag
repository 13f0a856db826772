#version 450
// Samples of two texels added up: half of each.
layout(binding = 0) uniform sampler2DMS scene;
layout(location = 0) out vec4 color;

void main() {
    ivec2 at = ivec2(gl_FragCoord.xy);
    vec4 sum = vec4(0.0);
    for (int i = 0; i < 4; i++)
        sum += texelFetch(scene, at + ivec2(i & 1, 0), i);
    color = sum / 4.0;
}
