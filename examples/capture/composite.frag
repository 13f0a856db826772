#version 450
// The scene above, its mirror image below, fainter with depth; glow over both; then tone mapping.
layout(set = 0, binding = 0) uniform sampler2D scene;
layout(set = 0, binding = 1) uniform sampler2D mirror;
layout(set = 0, binding = 2) uniform sampler2D mirrorDepth;
layout(set = 0, binding = 3) uniform sampler2D glow;
layout(location = 0) in vec2 at;
layout(location = 0) out vec4 result;

void main() {
    vec2 below = vec2(at.x, 3.0 * at.y - 2.0);
    vec3 light = texture(scene, at).rgb;
    if (below.y > 0.0)
        light = mix(light, texture(mirror, below).rgb, 0.6 * (1.0 - texture(mirrorDepth, below).r));
    light += texture(glow, at).rgb;
    result = vec4(1.0 - exp(-1.5 * light), 1.0);
}
