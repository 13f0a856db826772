#version 450
// As many samples as the image has.
layout(binding = 0) uniform sampler2DMS scene;
layout(location = 0) out vec4 color;

void main() {
    int count = textureSamples(scene);
    vec4 sum = vec4(0.0);
    for (int i = 0; i < count; i++)
        sum += texelFetch(scene, ivec2(gl_FragCoord.xy), i);
    color = sum / count;
}
