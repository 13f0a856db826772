#version 450
// Of inputs two are decorated, one of them a member of a block; the others are declared only, or not decorated.
layout(location = 0) in vec2 plain;
layout(location = 1) sample in vec3 normal;
layout(location = 2) in Varying { vec4 tint; sample vec4 glint; } block;
layout(location = 4) sample in vec4 unused;
layout(location = 0) out vec4 color;

void main() {
    color = vec4(normal, plain.x) * block.glint;
}
