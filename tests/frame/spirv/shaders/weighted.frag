#version 450
// Not every sample counts alike.
layout(binding = 0) uniform sampler2DMS scene;
layout(location = 0) out vec4 color;

void main() {
    vec4 sum = vec4(0.0);
    for (int i = 0; i < 4; i++)
        sum += texelFetch(scene, ivec2(gl_FragCoord.xy), i) * (i == 0 ? 0.4 : 0.2);
    color = sum;
}
