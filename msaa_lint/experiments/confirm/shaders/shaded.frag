#version 450

// scene.frag with work of a known cost: operations that wait for each other, and fetches from a texture of a known size.
layout(location = 0) flat in vec4 flatColor;

layout(set = 0, binding = 0) uniform sampler2D image;

layout(push_constant) uniform Work {
    layout(offset = 16) int operations;
    int fetches;
    float texel; // one texel in texture coordinates
};

layout(location = 0) out vec4 float0;
layout(location = 1) out vec4 float1;
layout(location = 2) out vec4 float2;
layout(location = 3) out vec4 float3;
layout(location = 4) out vec4 float4;
layout(location = 5) out vec4 float5;
layout(location = 6) out vec4 float6;
layout(location = 7) out vec4 float7;
layout(location = 8) out ivec4 sint0;
layout(location = 9) out ivec4 sint1;
layout(location = 10) out ivec4 sint2;
layout(location = 11) out ivec4 sint3;
layout(location = 12) out ivec4 sint4;
layout(location = 13) out ivec4 sint5;
layout(location = 14) out ivec4 sint6;
layout(location = 15) out ivec4 sint7;
layout(location = 16) out uvec4 uint0;
layout(location = 17) out uvec4 uint1;
layout(location = 18) out uvec4 uint2;
layout(location = 19) out uvec4 uint3;
layout(location = 20) out uvec4 uint4;
layout(location = 21) out uvec4 uint5;
layout(location = 22) out uvec4 uint6;
layout(location = 23) out uvec4 uint7;

// The work's result is too small to change a stored color, which the compiler does not know.
vec4 worked() {
    float value = gl_FragCoord.x * texel;
    for (int number = 0; number < operations; number++) {
        value = fma(value, 0.75, 0.125);
    }
    vec2 place = gl_FragCoord.xy * texel;
    for (int number = 0; number < fetches; number++) {
        // Neighboring pixels fetch neighboring texels, and each fetch is in another part of the texture.
        value += texture(image, place + vec2(0.618034, 0.381966) * float(number)).x;
    }
    return flatColor + value * 1e-30;
}

void main() {
    vec4 color = worked();
    float0 = color;
    float1 = color.yzxw;
    float2 = color.zxyw;
    float3 = color.xzyw;
    float4 = color.yxzw;
    float5 = color.zyxw;
    float6 = color;
    float7 = color.yzxw;
    sint0 = ivec4(color * 100.0);
    sint1 = ivec4(color * 98.0);
    sint2 = ivec4(color * 96.0);
    sint3 = ivec4(color * 94.0);
    sint4 = ivec4(color * 92.0);
    sint5 = ivec4(color * 90.0);
    sint6 = ivec4(color * 88.0);
    sint7 = ivec4(color * 86.0);
    uint0 = uvec4(color * 100.0);
    uint1 = uvec4(color * 98.0);
    uint2 = uvec4(color * 96.0);
    uint3 = uvec4(color * 94.0);
    uint4 = uvec4(color * 92.0);
    uint5 = uvec4(color * 90.0);
    uint6 = uvec4(color * 88.0);
    uint7 = uvec4(color * 86.0);
}
