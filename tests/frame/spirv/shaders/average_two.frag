#version 450
// The averages of two images, added up.
layout(binding = 0) uniform sampler2DMS scene;
layout(binding = 1) uniform sampler2DMS other;
layout(location = 0) out vec4 color;

void main() {
    vec4 one = vec4(0.0), two = vec4(0.0);
    for (int i = 0; i < 4; i++) {
        one += texelFetch(scene, ivec2(gl_FragCoord.xy), i);
        two += texelFetch(other, ivec2(gl_FragCoord.xy), i);
    }
    color = one / 4.0 + two * 0.25;
}
