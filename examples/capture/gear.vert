#version 450
// A gear without vertex buffers: a fan of four triangles to a tooth, whose rim goes in and out.
layout(push_constant) uniform Gear {
    vec4 color;
    vec2 middle;
    float radius;
    float angle;
    float depth;
    int teeth;
} gear;
layout(location = 0) out vec4 color;

void main() {
    int corner = gl_VertexIndex % 3, step = gl_VertexIndex / 3 + corner - 1;
    // Triangle t has the rim at t and at t + 1.
    float turn = gear.angle + 1.57079633 * float(step) / float(gear.teeth);
    float reach = corner == 0 ? 0.0 : (step & 2) == 0 ? 1.0 : 0.78;
    vec2 rim = reach * vec2(cos(turn), sin(turn));
    // Tilted, so that depth differs over a pixel; the picture is 16:9.
    gl_Position = vec4(gear.middle + gear.radius * rim * vec2(0.5625, 1.0), gear.depth + 0.05 * rim.x, 1.0);
    color = vec4(gear.color.rgb * (0.8 - 0.2 * rim.y), gear.color.a);
}
