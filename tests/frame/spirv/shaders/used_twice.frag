#version 450
// An average, and the first sample for something else.
layout(binding = 0) uniform sampler2DMS scene;
layout(location = 0) out vec4 color;

void main() {
    ivec2 at = ivec2(gl_FragCoord.xy);
    vec4 first = texelFetch(scene, at, 0);
    vec4 sum = first;
    for (int i = 1; i < 4; i++)
        sum += texelFetch(scene, at, i);
    color = abs(sum / 4.0 - first);
}
