#version 450
// The average as notes and tutorials have it: a function, a specialisation constant, a division at the end.
layout(constant_id = 0) const int NUM_SAMPLES = 8;
layout(set = 1, binding = 2) uniform sampler2DMS scene;
layout(location = 0) out vec4 color;

vec4 resolve(sampler2DMS tex, ivec2 uv) {
    vec4 result = vec4(0.0);
    for (int i = 0; i < NUM_SAMPLES; i++) {
        vec4 val = texelFetch(tex, uv, i);
        result += val;
    }
    return result / float(NUM_SAMPLES);
}

void main() {
    color = resolve(scene, ivec2(gl_FragCoord.xy));
}
