#version 450
// Reads the first sample alone.
layout(set = 0, binding = 0) uniform sampler2DMS scene;
layout(location = 0) out vec4 color;

void main() {
    color = texelFetch(scene, ivec2(gl_FragCoord.xy), 0);
}
