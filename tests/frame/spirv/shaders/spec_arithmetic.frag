#version 450
// Specialisation constants made of others, on a way that one of them decides.
layout(constant_id = 3) const int LOG2 = 1;
layout(constant_id = 4) const bool ALL = true;
layout(constant_id = 5) const uint FIRST = 0u;
const int COUNT = 1 << LOG2;
layout(binding = 0) uniform sampler2DMS scene;
layout(location = 0) out vec4 color;

void main() {
    ivec2 at = ivec2(gl_FragCoord.xy);
    if (ALL) {
        vec4 sum = vec4(0.0);
        for (uint i = FIRST; i < uint(COUNT); i++)
            sum += texelFetch(scene, at, int(i));
        color = sum / float(COUNT);
    } else {
        color = texelFetch(scene, at, COUNT - 1);
    }
}
