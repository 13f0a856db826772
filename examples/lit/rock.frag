#version 450

// A rock with a normal map, lit by a sun and eight lamps.
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec2 coordinates;

layout(set = 0, binding = 0) uniform sampler2D albedo;
layout(set = 0, binding = 1) uniform sampler2D bumps;

struct Lamp {
    vec4 position;
    vec4 color;
};

layout(set = 1, binding = 0) uniform Lights {
    vec4 sun;
    Lamp lamps[8];
};

layout(location = 0) out vec4 color;

vec3 lit(vec3 direction, vec3 light, vec3 surface, vec3 base) {
    float diffuse = max(dot(surface, direction), 0.0);
    vec3 halfway = normalize(direction + vec3(0.0, 0.0, 1.0));
    float gloss = pow(max(dot(surface, halfway), 0.0), 32.0);
    return light * (base * diffuse + 0.04 * gloss);
}

void main() {
    vec3 base = texture(albedo, coordinates * 4.0).rgb;
    vec3 bump = texture(bumps, coordinates * 16.0).xyz * 2.0 - 1.0;
    vec3 surface = normalize(normal + 0.5 * bump);
    vec3 light = lit(normalize(sun.xyz + vec3(0.3, 0.5, 0.8)), vec3(sun.w), surface, base);
    for (int number = 0; number < 8; number++) {
        vec3 away = lamps[number].position.xyz - position;
        float distance2 = dot(away, away) + 0.01;
        light += lit(away * inversesqrt(distance2), lamps[number].color.rgb / distance2, surface, base);
    }
    color = vec4(light, 1.0);
}
