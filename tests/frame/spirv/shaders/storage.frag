#version 450
// A multisampled storage image.
layout(binding = 0, rgba16f) uniform readonly image2DMS scene;
layout(location = 0) out vec4 color;

void main() {
    vec4 sum = vec4(0.0);
    for (int i = 0; i < 2; i++)
        sum += imageLoad(scene, ivec2(gl_FragCoord.xy), i);
    color = sum * 0.5;
}
