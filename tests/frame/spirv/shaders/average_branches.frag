#version 450
// An average in one of two branches, and a loop that nobody knows the length of.
layout(binding = 0) uniform sampler2DMS scene;
layout(binding = 1) uniform Lights { int lights; vec4 light[64]; };
layout(location = 0) in vec2 uv;
layout(location = 0) out vec4 color;

void main() {
    vec4 result = vec4(1.0, 0.0, 1.0, 1.0);
    if (uv.x > 0.5) {
        vec4 sum = vec4(0.0);
        for (int i = 0; i < 4; i++)
            sum += texelFetch(scene, ivec2(gl_FragCoord.xy), i);
        result = sum * 0.25;
    }
    for (int i = 0; i < lights; i++)
        result += light[i];
    color = result;
}
