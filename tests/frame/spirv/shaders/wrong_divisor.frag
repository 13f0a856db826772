#version 450
// Four samples divided by eight.
layout(binding = 0) uniform sampler2DMS scene;
layout(location = 0) out vec4 color;

void main() {
    vec4 sum = vec4(0.0);
    for (int i = 0; i < 4; i++)
        sum += texelFetch(scene, ivec2(gl_FragCoord.xy), i);
    color = sum / 8.0;
}
