#version 450

// Every sample of a multisampled image, one after the other, rows from the top.
layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 0) uniform sampler2DMS image;
layout(set = 0, binding = 1, std430) writeonly buffer Samples {
    vec4 samples[];
};

void main() {
    ivec2 size = textureSize(image);
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    int count = textureSamples(image);
    if (all(lessThan(texel, size))) {
        for (int number = 0; number < count; number++) {
            samples[(texel.y * size.x + texel.x) * count + number] = texelFetch(image, texel, number);
        }
    }
}
