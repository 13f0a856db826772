#version 450
// One sample of depth, as an outline needs it.
layout(binding = 0) uniform sampler2DMS depth;
layout(location = 0) out vec4 color;

void main() {
    float own = texelFetch(depth, ivec2(gl_FragCoord.xy), 0).r;
    float next = texelFetch(depth, ivec2(gl_FragCoord.xy) + 1, 0).r;
    color = vec4(abs(own - next));
}
