#version 450
// Runs for every sample: it reads its own of an image.
layout(binding = 0) uniform sampler2DMS scene;
layout(location = 0) out vec4 color;

void main() {
    color = texelFetch(scene, ivec2(gl_FragCoord.xy), gl_SampleID);
}
