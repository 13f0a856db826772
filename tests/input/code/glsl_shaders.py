"""Shaders in many styles. As GLSL, they must give the same results as glslang's SPIR-V."""

from __future__ import annotations

HEAD = """#version 450
layout(set = 0, binding = 0) uniform sampler2DMS scene;
layout(set = 0, binding = 1) uniform Settings { int count; float exposure; vec4 tint; mat4 matrix; } settings;
layout(location = 0) in vec2 uv;
layout(location = 0) out vec4 color;
"""
AT = "ivec2(gl_FragCoord.xy)"
OWN = f"texelFetch(scene, {AT}, i)"
"""The fetch in a loop."""

LOOP = f"vec4 sum = vec4(0); for (int i = 0; i < 4; i++) sum += texelFetch(scene, {AT}, i);"

BODIES = {
    "divided by an int": f"{LOOP} color = sum / 4;",
    "divided in place": f"{LOOP} sum /= 4.0; color = sum;",
    "scaled in place": f"{LOOP} sum *= 0.25; color = sum;",
    "scaled from the left": f"{LOOP} color = 0.25 * sum;",
    "counted down": f"vec4 sum = vec4(0.0); for (int i = 3; i >= 0; --i) sum += {OWN}; color = sum "
    "* 0.25;",
    "uint": f"vec4 sum = vec4(0.0); for (uint i = 0u; i < 4u; i++) sum += texelFetch(scene, {AT}, "
    "int(i)); color = sum * 0.25;",
    "while": f"vec4 sum = vec4(0.0); int i = 0; while (i < 4) {{ sum += {OWN}; i += 1; }} color = "
    "sum / 4.0;",
    "do": f"vec4 sum = vec4(0.0); int i = 0; do {{ sum += texelFetch(scene, {AT}, i++); }} while "
    "(i < 4); color = sum / 4.0;",
    "break": f"vec4 sum = vec4(0.0); for (int i = 0; ; i++) {{ if (i == 4) break; sum += {OWN}; }} "
    "color = sum / 4.0;",
    "continue": f"vec4 sum = vec4(0.0); for (int i = 0; i < 8; i++) {{ if (i >= 4) continue; sum "
    f"+= {OWN}; }} color = sum / 4.0;",
    "two at a time": f"""vec4 a = vec4(0.0), b = vec4(0.0);
        for (int i = 0; i < 4; i += 2) {{ a += {OWN}; b += texelFetch(scene, {AT}, i + 1); }} color = (a + b) / 4.0;""",
    "array": f"""vec4 own[4]; for (int i = 0; i < 4; i++) own[i] = {OWN};
        color = (own[0] + own[1] + own[2] + own[3]) * 0.25;""",
    "weights": f"""const float w[4] = float[4](0.25, 0.25, 0.25, 0.25); vec4 sum = vec4(0.0);
        for (int i = 0; i < 4; i++) sum += w[i] * {OWN}; color = sum;""",
    "weights of their own": f"""const float w[] = float[](0.1, 0.2, 0.3, 0.4); vec4 sum = vec4(0.0);
        for (int i = 0; i < 4; i++) sum += w[i] * {OWN}; color = sum;""",
    "components": f"""vec3 sum = vec3(0.0); for (int i = 0; i < 4; i++) {{ vec4 own = {OWN};
        sum.r += own.r; sum.g += own.g; sum.b += own.b; }} color = vec4(sum / 4.0, 1.0);""",
    "swizzled": f"{LOOP} color.bgra = (sum * 0.25).bgra;",
    "mixed up": f"""vec4 sum = vec4(0.0); for (int i = 0; i < 4; i++) sum += {OWN}.bgra; color = sum * 0.25;""",
    "fma": f"vec4 sum = vec4(0.0); for (int i = 0; i < 4; i++) sum = fma({OWN}, vec4(0.25), sum); "
    "color = sum;",
    "mapped": f"""vec3 sum = vec3(0.0); for (int i = 0; i < 4; i++) {{ vec3 c = {OWN}.rgb;
        sum += c / (1.0 + max(c.r, max(c.g, c.b))); }} color = vec4(sum / 4.0, 1.0);""",
    "exposed": f"vec4 sum = vec4(0.0); for (int i = 0; i < 4; i++) sum += {OWN} * "
    "settings.exposure; color = sum / 4.0;",
    "powers": f"vec3 sum = vec3(0.0); for (int i = 0; i < 4; i++) sum += pow({OWN}.rgb, "
    "vec3(2.2)); color = vec4(sum / 4.0, 1.0);",
    "squared": f"vec4 sum = vec4(0.0); for (int i = 0; i < 4; i++) {{ vec4 c = {OWN}; sum += c * "
    f"c; }} color = sqrt(sum / 4.0);",
    "then mapped": f"{LOOP} vec3 c = sum.rgb / 4.0; c *= settings.exposure; color = vec4(c / (c + "
    "1.0), 1.0);",
    "then transformed": f"{LOOP} color = settings.matrix * (sum / 4.0);",
    "edge": f"""vec4 first = texelFetch(scene, {AT}, 0); bool edge = false;
        for (int i = 1; i < 4; i++) edge = edge || any(notEqual({OWN}, first)); color = edge ? vec4(1.0) : first;""",
    "least": f"float d = 1.0; for (int i = 0; i < 4; i++) d = min(d, {OWN}.r); color = vec4(d);",
    "greatest": f"float d = texelFetch(scene, {AT}, 0).r; for (int i = 1; i < 4; i++) d = max(d, "
    f"{OWN}.r); color = vec4(d);",
    "compared": f"float d = 1.0; for (int i = 0; i < 4; i++) {{ float o = {OWN}.r; if (o < d) d = "
    f"o; }} color = vec4(d);",
    "one": f"color = texelFetch(scene, {AT}, 2);",
    "its own": f"color = texelFetch(scene, {AT}, gl_SampleID);",
    "half": f"color = (texelFetch(scene, {AT}, 0) + texelFetch(scene, {AT}, 1)) * 0.5;",
    "some": f"color = (texelFetch(scene, {AT}, 0) + texelFetch(scene, {AT}, 3)) * 0.5;",
    "asked for": f"""int n = textureSamples(scene); vec4 sum = vec4(0.0);
        for (int i = 0; i < n; i++) sum += {OWN}; color = sum / float(n);""",
    "of a buffer": f"vec4 sum = vec4(0.0); for (int i = 0; i < settings.count; i++) sum += {OWN}; "
    "color = sum / settings.count;",
    "switched": f"""vec4 sum = vec4(0.0); int n = 4; switch (n) {{ case 2: n = 1; break; case 4: n = 2; default: n += 2; }}
        for (int i = 0; i < n; i++) sum += {OWN}; color = sum / 4.0;""",
    "switched by a buffer": f"""vec4 sum = vec4(0.0); switch (settings.count) {{
        case 2: for (int i = 0; i < 2; i++) sum += {OWN}; color = sum / 2.0; break;
        default: color = texelFetch(scene, {AT}, 0); }}""",
    "in one way": f"if (uv.x > 0.5) {{ {LOOP} color = sum / 4.0; }} else color = vec4(uv, 0.0, "
    "1.0);",
    "after a discard": f"if (uv.x > 0.5) discard; {LOOP} color = sum / 4.0;",
    "after a return": f"if (uv.x > 0.5) {{ color = vec4(0.0); return; }} {LOOP} color = sum / 4.0;",
    "chosen": f"{LOOP} color = uv.x > 0.5 ? sum / 4.0 : vec4(0.0);",
    "chosen fetch": f"color = uv.x > 0.5 ? texelFetch(scene, {AT}, 0) : texelFetch(scene, {AT}, "
    "1);",
    "and": f"bool b = uv.x > 0.5 && texelFetch(scene, {AT}, 0).r > 0.5; color = vec4(b);",
    "offsets": f"""vec4 sum = vec4(0.0);
        for (int i = 0; i < 4; i++) sum += texelFetch(scene, {AT} + ivec2(i & 1, i >> 1), 0); color = sum / 4.0;""",
    "nested": f"""vec4 sum = vec4(0.0); for (int y = 0; y < 2; y++) for (int x = 0; x < 2; x++)
        sum += texelFetch(scene, {AT}, y * 2 + x); color = sum / 4.0;""",
    "two texels": f"""vec4 sum = vec4(0.0); for (int x = 0; x < 2; x++) for (int i = 0; i < 4; i++)
        sum += texelFetch(scene, {AT} + ivec2(x, 0), i); color = sum / 8.0;""",
    "mixed with another": f"{LOOP} color = mix(sum / 4.0, settings.tint, settings.exposure);",
    "difference": f"vec4 d = texelFetch(scene, {AT}, 0) - texelFetch(scene, {AT}, 1); color = "
    "abs(d);",
    "negated": f"vec4 sum = vec4(0.0); for (int i = 0; i < 4; i++) sum -= {OWN}; color = -sum / "
    "4.0;",
    "alpha of one": f"{LOOP} color = vec4(sum.rgb / 4.0, 1.0);",
    "an index of a vector": f"{LOOP} sum /= 4.0; color = vec4(sum[0], sum[1], sum[2], sum[3]);",
    "last sample": f"color = texelFetch(scene, {AT}, 7);",
    "position": "color = vec4(gl_SamplePosition, 0.0, 1.0);",
    "mask": "gl_SampleMask[0] = gl_SampleMaskIn[0] & 1; color = vec4(1.0);",
    "bits": "vec4 sum = vec4(0.0); for (int i = 1; i <= 8; i <<= 1) sum += texelFetch(scene, "
    f"{AT}, i >> 1); color = sum / 4.0;",
    "kept in a matrix": f"mat4 m; for (int i = 0; i < 4; i++) m[i] = {OWN}; color = (m[0] + m[1] + "
    "m[2] + m[3]) / 4.0;",
    "below zero": f"""const int FIRST = -4; const float SHARE = -0.25; vec4 sum = vec4(-0.0);
        for (int i = FIRST; i < 0; i++) sum += texelFetch(scene, {AT}, i + 4); color = sum * -SHARE;""",
    "comma": "vec4 sum = vec4(0.0); for (int i = 0, j = 3; i < 4; i++, j--) sum += "
    f"texelFetch(scene, {AT}, j); color = sum / 4.0;",
    "precision": f"highp vec4 sum = vec4(0.0); for (mediump int i = 0; i < 4; ++i) sum += {OWN}; "
    "color = sum / 4.0;",
}

FUNCTIONS = {
    "a function": """vec4 resolve(sampler2DMS tex, ivec2 at, int n) {
        vec4 sum = vec4(0.0); for (int i = 0; i < n; i++) sum += texelFetch(tex, at, i); return sum / float(n); }
        void main() { color = resolve(scene, @, 4); }""",
    "written back": """void add(inout vec4 sum, int i) { sum += texelFetch(scene, @, i); }
        void main() { vec4 sum = vec4(0.0); for (int i = 0; i < 4; i++) add(sum, i); color = sum / 4.0; }""",
    "an out": """void fetch(int i, out vec4 own) { own = texelFetch(scene, @, i); }
        void main() { vec4 sum = vec4(0.0), own; for (int i = 0; i < 4; i++) { fetch(i, own); sum += own; } color = sum / 4.0; }""",
    "overloads": """vec3 mapped(vec3 c) { return c / (c + 1.0); } float mapped(float c) { return c; }
        void main() { vec3 sum = vec3(0.0); for (int i = 0; i < 4; i++) sum += mapped(texelFetch(scene, @, i).rgb);
        color = vec4(sum / 4.0, mapped(1.0)); }""",
    "declared before": """vec4 own(int i); void main() { color = (own(0) + own(1)) * 0.5; }
        vec4 own(int i) { return texelFetch(scene, @, i); }""",
    "a structure": """struct Total { vec4 sum; int n; };
        void main() { Total t = Total(vec4(0.0), 0);
        for (t.n = 0; t.n < 4; t.n++) t.sum += texelFetch(scene, @, t.n); color = t.sum / float(t.n); }""",
    "a macro": """#define SAMPLES 4
        #define FETCH(i) texelFetch(scene, @, (i))
        void main() { vec4 sum = vec4(0.0); for (int i = 0; i < SAMPLES; ++i) sum += FETCH(i); color = sum * (1.0 / float(SAMPLES)); }""",
    "a condition": """#define MSAA 8
        #if MSAA > 4 && !defined(OFF)
        const int N = 8;
        #else
        const int N = 4;
        #endif
        void main() { vec4 sum = vec4(0.0); for (int i = 0; i < N; ++i) sum += texelFetch(scene, @, i); color = sum / N; }""",
    "a constant of others": """const int N = 2 * 2; const float SHARE = 1.0 / float(N);
        void main() { vec4 sum = vec4(0.0); for (int i = 0; i < N; ++i) sum += texelFetch(scene, @, i); color = sum * SHARE; }""",
    "a global": """vec4 total = vec4(0.0);
        void main() { for (int i = 0; i < 4; ++i) total += texelFetch(scene, @, i); color = total / 4.0; }""",
    "specialized": """layout(constant_id = 3) const int N = 4;
        void main() { vec4 sum = vec4(0.0); for (int i = 0; i < N; ++i) sum += texelFetch(scene, @, i); color = sum / float(N); }""",
    "unused": """vec4 never() { return texelFetch(scene, ivec2(0), gl_SampleID); } void main() { color = vec4(0.0); }""",
    "push constants": """layout(push_constant) uniform Push { int n; };
        void main() { vec4 sum = vec4(0.0); for (int i = 0; i < n; ++i) sum += texelFetch(scene, @, i); color = sum / float(n); }""",
    "several outputs": """layout(location = 1) out vec3 other;
        void main() { color.rgb = vec3(1.0); other = texelFetch(scene, @, 0).rgb; }""",
    "another texture": """layout(binding = 2) uniform sampler2D plain; layout(binding = 3) uniform samplerCube sky;
        void main() { color = texture(plain, uv) + textureLod(sky, vec3(uv, 1.0), 0.0);
        color += texelFetch(plain, ivec2(0), 0) * float(textureSize(scene).x); }""",
    "integers": """layout(binding = 2) uniform isampler2DMS ids; layout(binding = 3) uniform usampler2DMS masks;
        void main() { ivec4 sum = ivec4(0); for (int i = 0; i < 4; i++) sum += texelFetch(ids, ivec2(0), i);
        color = vec4(sum) / 4.0 + vec4(texelFetch(masks, ivec2(0), 1)); }""",
    "layers": """layout(binding = 2) uniform sampler2DMSArray layers;
        void main() { vec4 sum = vec4(0.0);
        for (int i = 0; i < 2; i++) sum += texelFetch(layers, ivec3(gl_FragCoord.xy, 1), i); color = sum * 0.5; }""",
    "parts that are put together": """layout(binding = 2) uniform texture2DMS image; layout(binding = 3) uniform sampler way;
        void main() { vec4 sum = vec4(0.0);
        for (int i = 0; i < 4; i++) sum += texelFetch(sampler2DMS(image, way), @, i); color = sum * 0.25; }""",
    "sample inputs": """layout(location = 1) sample in vec3 normal; layout(location = 2) flat in int id;
        void main() { color = vec4(normal, float(id)); }""",
    "comments": """// texelFetch(scene, ivec2(0), 5);
        /* for (;;) */ void main() { color = texelFetch(scene, /* here */ ivec2(0), 1); } // end""",
    "modf": """void main() { vec4 whole; vec4 part = modf(texelFetch(scene, ivec2(0), 0), whole); color = whole + part; }""",
    "early and": """bool test(int i) { return texelFetch(scene, ivec2(0), i).r > 0.5; }
        void main() { color = vec4(test(0) && test(1) || test(2)); }""",
}

SHADERS = {
    **{name: f"{HEAD}void main() {{\n{body}\n}}\n" for name, body in BODIES.items()},
    **{name: f"{HEAD}{text}\n".replace("@", AT) for name, text in FUNCTIONS.items()},
}
