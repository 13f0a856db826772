#version 450
// The member of the block that is read is not the one that is decorated.
layout(location = 2) in Varying { vec4 tint; sample vec4 glint; } block;
layout(location = 0) out vec4 color;

void main() {
    color = block.tint;
}
