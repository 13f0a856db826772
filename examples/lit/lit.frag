#version 450
// A surface under a sun with a shadow and four lamps: what a forward renderer computes for each fragment.

struct Lamp {
    vec4 position; // in the world; w is the reach
    vec4 color;
};

layout(set = 0, binding = 0) uniform View {
    mat4 worldToShadow;
    vec4 eye;
    vec4 sun;
    Lamp lamps[4];
    int lampCount;
} view;
layout(set = 0, binding = 1) uniform sampler2DShadow shadowMap;
layout(set = 0, binding = 2) uniform samplerCube sky;
layout(set = 1, binding = 0) uniform texture2D albedoMap;
layout(set = 1, binding = 1) uniform texture2D normalMap;
layout(set = 1, binding = 2) uniform texture2D roughnessMap;
layout(set = 1, binding = 3) uniform sampler surfaceSampler;

layout(push_constant) uniform Material {
    layout(offset = 64) vec4 tint;
    float exposure;
};

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 tangent;
layout(location = 3) in vec2 uv;
layout(location = 4) flat in uint layer;

layout(location = 0) out vec4 color;

vec3 reflected(vec3 n, vec3 v, vec3 l, vec3 albedo, float roughness) {
    vec3 h = normalize(l + v);
    float a = max(roughness * roughness, 0.01);
    float nh = max(dot(n, h), 0.0);
    float d = nh * nh * (a * a - 1.0) + 1.0;
    float fresnel = 0.04 + 0.96 * pow(1.0 - max(dot(h, v), 0.0), 5.0);
    return (albedo / 3.14159 + fresnel * a * a / (3.14159 * d * d)) * max(dot(n, l), 0.0);
}

void main() {
    mat3 frame = mat3(tangent.xyz, cross(normal, tangent.xyz) * tangent.w, normal);
    vec3 n = normalize(frame * (texture(sampler2D(normalMap, surfaceSampler), uv).xyz * 2.0 - 1.0));
    vec3 albedo = texture(sampler2D(albedoMap, surfaceSampler), uv).rgb * tint.rgb;
    float roughness = texture(sampler2D(roughnessMap, surfaceSampler), uv).g;
    vec3 v = normalize(view.eye.xyz - position);

    vec4 inShadow = view.worldToShadow * vec4(position, 1.0);
    float lit = texture(shadowMap, inShadow.xyz / inShadow.w);
    vec3 sum = lit * reflected(n, v, normalize(view.sun.xyz), albedo, roughness);
    for (int number = 0; number < view.lampCount; number++) {
        vec3 to = view.lamps[number].position.xyz - position;
        float falloff = max(1.0 - length(to) / view.lamps[number].position.w, 0.0);
        sum += falloff * view.lamps[number].color.rgb * reflected(n, v, normalize(to), albedo, roughness);
    }
    sum += albedo * textureLod(sky, reflect(-v, n), roughness * 8.0).rgb * (layer == 0u ? 1.0 : 0.5);
    color = vec4(sum * exposure, 1.0);
}
