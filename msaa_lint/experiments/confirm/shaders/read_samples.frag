#version 450

// What is read from an image, at every pixel: the average of its samples.
layout(set = 0, binding = 0) uniform sampler2DMS image;

layout(push_constant) uniform Reading {
    vec2 scale; // from pixels here to texels there
    int samples; // how many are read
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

void main() {
    ivec2 texel = min(ivec2(gl_FragCoord.xy * scale), textureSize(image) - 1);
    vec4 value = vec4(0.0);
    for (int number = 0; number < samples; number++) {
        value += texelFetch(image, texel, number);
    }
    value /= float(samples);
    float0 = value;
    float1 = value;
    float2 = value;
    float3 = value;
    float4 = value;
    float5 = value;
    float6 = value;
    float7 = value;
    sint0 = ivec4(value * 100.0);
    sint1 = ivec4(value * 100.0);
    sint2 = ivec4(value * 100.0);
    sint3 = ivec4(value * 100.0);
    sint4 = ivec4(value * 100.0);
    sint5 = ivec4(value * 100.0);
    sint6 = ivec4(value * 100.0);
    sint7 = ivec4(value * 100.0);
    uint0 = uvec4(value * 100.0);
    uint1 = uvec4(value * 100.0);
    uint2 = uvec4(value * 100.0);
    uint3 = uvec4(value * 100.0);
    uint4 = uvec4(value * 100.0);
    uint5 = uvec4(value * 100.0);
    uint6 = uvec4(value * 100.0);
    uint7 = uvec4(value * 100.0);
}
