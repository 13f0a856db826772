#version 450
// Alpha is 1, whichever way is taken.
layout(location = 0) in vec3 tint;
layout(location = 0) out vec4 color;

void main() {
    if (tint.x > 0.5) { color = vec4(tint, 1.0); return; }
    color = vec4(tint * 2.0, 1.0);
}
