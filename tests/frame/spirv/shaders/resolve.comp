#version 450
// A compute shader averages.
layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0) uniform sampler2DMS scene;
layout(binding = 1, rgba8) uniform writeonly image2D target;

void main() {
    ivec2 at = ivec2(gl_GlobalInvocationID.xy);
    vec4 sum = vec4(0.0);
    for (int i = 0; i < 4; i++)
        sum += texelFetch(scene, at, i);
    imageStore(target, at, sum / 4.0);
}
