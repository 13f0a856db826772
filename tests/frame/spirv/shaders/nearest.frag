#version 450
// The nearest and the farthest of the samples of two depth images.
layout(binding = 0) uniform sampler2DMS reversed;
layout(binding = 1) uniform sampler2DMS standard;
layout(location = 0) out vec2 depths;

void main() {
    float most = 0.0, least = 1.0;
    for (int i = 0; i < 4; i++) {
        most = max(most, texelFetch(reversed, ivec2(gl_FragCoord.xy), i).x);
        least = min(least, texelFetch(standard, ivec2(gl_FragCoord.xy), i).x);
    }
    depths = vec2(most, least);
}
