#version 450
// Four fetches, one after the other, of the colours alone.
layout(binding = 0) uniform sampler2DMS scene;
layout(location = 0) out vec3 color;

void main() {
    ivec2 at = ivec2(gl_FragCoord.xy);
    vec3 a = texelFetch(scene, at, 0).rgb, b = texelFetch(scene, at, 1).rgb;
    vec3 c = texelFetch(scene, at, 2).rgb, d = texelFetch(scene, at, 3).rgb;
    color = (a + b + c + d) * 0.25;
}
