#version 450
// Each sample by its share, straight into the output, and tone mapping of what comes of it.
layout(binding = 0) uniform sampler2DMS scene;
layout(push_constant) uniform Push { float exposure; };
layout(location = 0) out vec4 color;

void main() {
    color = vec4(0.0);
    for (int i = 0; i < 4; ++i)
        color += texelFetch(scene, ivec2(gl_FragCoord.xy), i) * 0.25;
    color.rgb = color.rgb * exposure / (color.rgb * exposure + 1.0);
    color.a = 1.0;
}
