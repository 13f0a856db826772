#version 450
// Runs for every sample: it asks where that lies.
layout(location = 0) in vec4 tint;
layout(location = 0) out vec4 color;

void main() {
    color = tint * fract(gl_SamplePosition.x * 7.0 + gl_SamplePosition.y * 5.0);
}
