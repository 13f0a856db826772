#version 450
// All samples in one branch, the first of them in the other.
layout(binding = 0) uniform sampler2DMS scene;
layout(location = 0) in float edge;
layout(location = 0) out vec4 color;

void main() {
    ivec2 at = ivec2(gl_FragCoord.xy);
    if (edge > 0.5) {
        vec4 sum = vec4(0.0);
        for (int i = 0; i < 4; i++)
            sum += texelFetch(scene, at, i);
        color = sum / 4.0;
    } else {
        color = texelFetch(scene, at, 0);
    }
}
