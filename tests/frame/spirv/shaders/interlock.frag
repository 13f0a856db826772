#version 450
#extension GL_ARB_fragment_shader_interlock : require
layout(sample_interlock_ordered) in;
layout(binding = 0, rgba8) uniform image2D target;

void main() {
    beginInvocationInterlockARB();
    imageStore(target, ivec2(gl_FragCoord.xy), vec4(1.0));
    endInvocationInterlockARB();
}
