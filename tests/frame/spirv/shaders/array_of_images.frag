#version 450
// Two of an array of images.
layout(set = 0, binding = 4) uniform sampler2DMS scenes[3];
layout(location = 0) out vec4 color;

vec4 resolve(int index, int count) {
    vec4 sum = vec4(0.0);
    for (int i = 0; i < count; i++)
        sum += texelFetch(scenes[index], ivec2(gl_FragCoord.xy), i);
    return sum / float(count);
}

void main() {
    color = resolve(0, 2) + resolve(2, 4);
}
