#version 300 es
// A pixel of a dress: its codes become a colour in a look. What differs from dress to dress comes
// before this file's second line: SUM_PLANES, a sum of GROUP and PLANE for all planes; GROUPS and
// PLANES, their numbers; DIFFERENCE where a second look is held against the first.
precision highp float;
precision highp int;
precision highp usampler2DArray;

uniform usampler2DArray u_codes; // four planes a layer
uniform sampler2D u_view;        // codes of the display, VIEW_CODES of them
uniform vec2 u_level[GROUPS];    // offset and step of the level's codes
uniform float u_level_scale;
uniform vec3 u_of_level[LOOKS * GROUPS];  // X, Y, Z of a level of 1
uniform vec3 u_of_offset[LOOKS * GROUPS]; // of shape codes of 0, at a weight of 1
uniform vec3 u_of_code[LOOKS * PLANES];   // of one step of a shape code, at a weight of 1
uniform vec3 u_white;
uniform mat3 u_rgb_from_xyz;
uniform vec2 u_view_scale; // half and step, see displayCode
uniform float u_largest;   // difference at the end of the colours of u_legend
uniform vec3 u_legend[LEGEND];
uniform int u_height;
out vec4 colour;

vec3 lab_of(vec3 xyz) {
    vec3 t = xyz / u_white;
    vec3 f = mix((24389.0 / 27.0 * t + 16.0) / 116.0, pow(max(t, 1e-9), vec3(1.0 / 3.0)),
                 greaterThan(t, vec3(216.0 / 24389.0)));
    return vec3(116.0 * f.y - 16.0, 500.0 * (f.x - f.y), 200.0 * (f.y - f.z));
}

// [Sharma] Eqs. 2 to 22
float ciede2000(vec3 one, vec3 two) {
    const float kDegree = 0.017453292519943295, kTurn = 6.283185307179586;
    const float k25to7 = 6103515625.0;
    float mean7 = pow((length(one.yz) + length(two.yz)) / 2.0, 7.0);
    float g = 1.5 - 0.5 * sqrt(mean7 / (mean7 + k25to7));
    vec2 ab1 = one.yz * vec2(g, 1.0), ab2 = two.yz * vec2(g, 1.0);
    float c1 = length(ab1), c2 = length(ab2);
    float h1 = c1 > 0.0 ? atan(ab1.y, ab1.x) : 0.0, h2 = c2 > 0.0 ? atan(ab2.y, ab2.x) : 0.0;
    float turn = 0.0, hue = h1 + h2;
    if (c1 * c2 > 0.0) {
        turn = h2 - h1 - kTurn * floor((h2 - h1) / kTurn + 0.5);
        hue = h1 + turn / 2.0;
    }
    float l = (one.x + two.x) / 2.0 - 50.0, c = (c1 + c2) / 2.0;
    float t = 1.0 - 0.17 * cos(hue - 30.0 * kDegree) + 0.24 * cos(2.0 * hue) +
              0.32 * cos(3.0 * hue + 6.0 * kDegree) - 0.2 * cos(4.0 * hue - 63.0 * kDegree);
    float from_blue = (hue - kTurn * floor(hue / kTurn)) / kDegree - 275.0;
    float c7 = pow(c, 7.0);
    float rotation = -sin(60.0 * kDegree * exp(-from_blue * from_blue / 625.0)) * 2.0 *
                     sqrt(c7 / (c7 + k25to7));
    float dl = (two.x - one.x) / (1.0 + 0.015 * l * l / sqrt(20.0 + l * l));
    float dc = (c2 - c1) / (1.0 + 0.045 * c);
    float dh = 2.0 * sqrt(c1 * c2) * sin(turn / 2.0) / (1.0 + 0.015 * c * t);
    return sqrt(max(dl * dl + dc * dc + dh * dh + rotation * dc * dh, 0.0));
}

vec3 displayed(vec3 xyz) {
    vec3 light = max(u_rgb_from_xyz * xyz, 0.0);
    ivec3 place = min(ivec3(light / ((light + u_view_scale.x) * u_view_scale.y) + 0.5), VIEW_CODES - 1);
    return vec3(texelFetch(u_view, ivec2(place.r, 0), 0).r, texelFetch(u_view, ivec2(place.g, 0), 0).r,
                texelFetch(u_view, ivec2(place.b, 0), 0).r);
}

vec3 legend(float difference) {
    float place = clamp(difference / u_largest, 0.0, 1.0) * float(LEGEND - 1);
    int cell = min(int(place), LEGEND - 2);
    return mix(u_legend[cell], u_legend[cell + 1], place - float(cell));
}

// Begins a light group with the code of its level, then adds its shape codes. The weight is the
// level by its cube root, or where that is above 1, by 1.
#define GROUP(g, code) \
    level = u_level_scale * (exp(u_level[g].x + u_level[g].y * float(code)) - 1.0); \
    weight = max(level, exp2(2.0 / 3.0 * log2(max(level, 1e-12)))); \
    first += level * u_of_level[g] + weight * u_of_offset[g]; \
    SECOND(level * u_of_level[GROUPS + g] + weight * u_of_offset[GROUPS + g])
#define PLANE(p, code) \
    value = weight * float(code); \
    first += value * u_of_code[p]; \
    SECOND(value * u_of_code[PLANES + p])
#define FETCH(layer) four = texelFetch(u_codes, ivec3(at, layer), 0);
#ifdef DIFFERENCE
#define SECOND(xyz) second += xyz;
#else
#define SECOND(xyz)
#endif

void main() {
    ivec2 at = ivec2(gl_FragCoord.x, float(u_height) - gl_FragCoord.y);
    vec3 first = vec3(0.0), second = vec3(0.0);
    float level, weight, value;
    uvec4 four;
    SUM_PLANES
#ifdef DIFFERENCE
    colour = vec4(legend(ciede2000(lab_of(first), lab_of(second))), 1.0);
#else
    colour = vec4(displayed(first), 1.0);
#endif
}
