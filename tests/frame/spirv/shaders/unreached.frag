#version 450
// A function that nothing calls reads the sample's number.
layout(location = 0) out vec4 color;

float sparkle() { return float(gl_SampleID); }

void main() {
    color = vec4(1.0);
}
