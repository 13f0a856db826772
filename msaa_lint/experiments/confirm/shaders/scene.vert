#version 450

// A corner of the scene's triangles (scene.py), in clip coordinates.
layout(location = 0) in vec3 position;

// How bright the brightest colour is; which draw of a pass this is, by which the scene is turned.
layout(push_constant) uniform Scene {
    float peak;
    int draw;
};

layout(location = 0) flat out vec4 color;

void main() {
    int triangle = gl_VertexIndex / 3;
    vec2 corner = position.xy;
    if (triangle > 0 && (draw & 1) == 1) {
        corner = vec2(-corner.y, corner.x);
    }
    gl_Position = vec4(corner, position.z, 1.0);
    ivec3 steps = ivec3(triangle * 5 + 3 + draw, triangle * 3 + 1, triangle * 7 + 2 * draw) % ivec3(8, 9, 11);
    color = vec4(peak * vec3(steps) / vec3(7.0, 8.0, 10.0), float(1 + triangle % 4) / 4.0);
}
