#version 450
// How many samples is in a buffer.
layout(binding = 0) uniform sampler2DMS scene;
layout(binding = 1) uniform Count { int count; };
layout(location = 0) out vec4 color;

void main() {
    vec4 sum = vec4(0.0);
    for (int i = 0; i < count; i++)
        sum += texelFetch(scene, ivec2(gl_FragCoord.xy), i);
    color = sum / count;
}
