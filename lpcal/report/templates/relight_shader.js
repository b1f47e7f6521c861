// The shaders, in GLSL: near lights with their lobes, a gloss lobe, shadows along the picture, and the maps in false colours. What is shown is
// chosen by #define, one program each: a processor that draws runs through all branches of an `if`, whether taken or not.
const MOST_LIGHTS = 24;
const PALETTES = {
  depth: ["#f4e7b0", "#8fc487", "#3b918f", "#2b5685", "#1d2250"],
  sigma: ["#17324d", "#2e7d86", "#9bc26c", "#f0bf4a", "#cf4f2e"],
};
PALETTES.depthSigma = PALETTES.apart = PALETTES.sigma;
const MODES = ["lit", "shading", "albedo", "normals", "depth", "sigma", "depthSigma", "apart"];
const SIGMA_STOP = 10;
const rgb = (hex) => [1, 3, 5].map((k) => parseInt(hex.slice(k, k + 2), 16) / 255);

const VERTEX = `precision highp float;
in vec3 position; in vec2 cell;
uniform mat4 modelViewMatrix, projectionMatrix; uniform vec2 size; uniform float bent, bendStrength; uniform highp sampler2D bend; uniform vec4 bendPlace;
out vec2 uv; out vec3 p; out float depth;
void main() {
  uv = (cell + 0.5) / size; p = position; depth = position.z;
#ifdef BENT
  vec4 b = texture(bend, uv * bendPlace.xy + bendPlace.zw);
  p *= 1.0 + bent * bendStrength * b.x / max(b.w, 1e-3);
#endif
  gl_Position = projectionMatrix * modelViewMatrix * vec4(p, 1.0);
}`;

const FRAGMENT = `precision highp float; precision highp int; precision highp usampler2D;
in vec2 uv; in vec3 p; in float depth; out vec4 painted;
uniform sampler2D geometry, paint, doubt, lobes, bend, quickNormal, quickPaint; uniform usampler2D codes;
uniform int count, steps; uniform vec4 eye; uniform vec3 scale; uniform vec2 size; uniform vec4 bendPlace;
uniform vec4 source[${MOST_LIGHTS}]; uniform vec4 axis[${MOST_LIGHTS}]; uniform vec3 power[${MOST_LIGHTS}];
uniform float exposure, gloss, lobeStop, pixel, reach, contour, bent, bendTurn, depthSigmaSpan; uniform vec2 place[5]; uniform vec2 rays[10]; uniform vec3 palette[5];

vec2 placeOf(vec3 q) {
#ifdef PERSPECTIVE
  vec2 r = q.xy / q.z;
#else
  vec2 r = q.xy;
#endif
  return place[0] + place[1] * r.x + place[2] * r.y + (place[3] * r.x + place[4] * r.y) * dot(r, r);
}
vec2 rayOf(vec2 a) {
  float x = a.x, y = a.y;
  return rays[0] + x * rays[1] + y * rays[2] + x * x * rays[3] + x * y * rays[4] + y * y * rays[5] + x * x * x * rays[6] + x * x * y * rays[7] + x * y * y * rays[8] + y * y * y * rays[9];
}
vec3 unfolded(vec2 m) {
  float z = abs(m.x) + abs(m.y) - 1.0;
  if (z > 0.0) m = (1.0 - abs(m.yx)) * vec2(m.x < 0.0 ? -1.0 : 1.0, m.y < 0.0 ? -1.0 : 1.0);
  return normalize(vec3(m, z));
}
vec3 pointOf(ivec2 k, float code) {
  vec2 r = rayOf((vec2(k) + 0.5) / size); float z = scale.x + scale.y * ((code - 1.0) / 32767.0 - 1.0);
#ifdef PERSPECTIVE
  return vec3(r * z, z);
#else
  return vec3(r, z);
#endif
}
// The normal of the depth over five pixels; none where the depth ends.
vec3 normalOfDepth(vec3 n) {
  ivec2 k = ivec2(uv * size), last = ivec2(size) - 1; vec3 d[2];
  for (int a = 0; a < 2; a++) {
    ivec2 by = a == 0 ? ivec2(2, 0) : ivec2(0, 2), i = max(k - by, ivec2(0)), j = min(k + by, last);
    float f = float(texelFetch(codes, i, 0).r), t = float(texelFetch(codes, j, 0).r);
    if (f == 0.0) { i = k; f = float(texelFetch(codes, k, 0).r); }
    if (t == 0.0) { j = k; t = float(texelFetch(codes, k, 0).r); }
    if (i == j || f == 0.0 || t == 0.0) return n;
    d[a] = pointOf(j, t) - pointOf(i, f);
  }
  vec3 found = normalize(cross(d[1], d[0]));
#ifdef PERSPECTIVE
  return dot(found, p) > 0.0 ? -found : found;
#else
  return found.z > 0.0 ? -found : found;
#endif
}
float lobeAt(float angle, float row) {
  float at = angle / lobeStop * float(textureSize(lobes, 0).x - 1);
  if (at >= float(textureSize(lobes, 0).x - 1)) return 0.0;
  int k = int(at);
  return mix(texelFetch(lobes, ivec2(k, int(row)), 0).r, texelFetch(lobes, ivec2(k + 1, int(row)), 0).r, fract(at));
}
float lit(vec3 n, vec3 d, float far) {
  float open = 1.0, noise = fract(52.9829 * fract(dot(gl_FragCoord.xy, vec2(0.06711, 0.00584))));
  float stop = min(far, reach);
  vec3 start = p + n * 2.5 * pixel;
  for (int k = 0; k < steps; k++) {
    float t = (float(k) + noise) / float(steps); t = t * t * stop + 2.0 * pixel;
    vec3 q = start + d * t; vec2 where = placeOf(q);
    if (any(lessThan(where, vec2(0.0))) || any(greaterThan(where, vec2(1.0)))) break;
    vec2 there = textureLod(geometry, where, 0.0).zw;
    if (there.y < 0.9) continue;
    float inside = q.z - scale.x - scale.y * there.x / there.y;
    if (inside < 0.55 * reach) open = min(open, 1.0 - smoothstep(1.5 * pixel, 3.0 * pixel + 0.07 * t, inside));
  }
  return open;
}
vec3 ramp(float t) { float at = clamp(t, 0.0, 1.0) * 3.999; int k = int(at); return mix(palette[k], palette[k + 1], fract(at)); }
float ggx(vec3 n, vec3 d, vec3 v, float alpha) {
  vec3 h = normalize(d + v); float nh = max(dot(n, h), 0.0), nl = max(dot(n, d), 1e-3), nv = max(dot(n, v), 1e-3), a2 = alpha * alpha;
  float b = nh * nh * (a2 - 1.0) + 1.0, D = a2 / (b * b);
  float G = 2.0 / (nl * sqrt(a2 + (1.0 - a2) * nv * nv) + nv * sqrt(a2 + (1.0 - a2) * nl * nl));
  return D * G * (0.04 + 0.96 * pow(1.0 - max(dot(d, h), 0.0), 5.0)) / 4.0;
}
#ifdef QUICK
// What moves where a processor draws: the nearest normal and colour in 8 bit, the lights without gloss and shadows, no power and no exponential.
void main() {
  vec4 g = texture(quickNormal, uv);
  if (g.w < 0.5) discard;
  vec3 n = g.xyz * 2.0 - 1.0;
#if MODE == 1
  vec3 base = vec3(0.62);
#else
  vec3 base = texture(quickPaint, uv).rgb; base *= 0.85 * base;
#endif
  vec3 sum = vec3(0.0);
  for (int k = 0; k < count; k++) {
    vec3 to = source[k].xyz - source[k].w * p; float one = inversesqrt(dot(to, to)), fall = source[k].w > 0.0 ? one * one * one : one;
#ifdef LOBES
    if (axis[k].w >= 0.0) fall *= lobeAt(acos(clamp(-one * dot(to, axis[k].xyz), -1.0, 1.0)), axis[k].w);
#endif
    sum += power[k] * (fall * max(dot(n, to), 0.0));
  }
  sum = (exposure * sum + 0.012) * base;
  vec3 root = sqrt(min(sum, vec3(1.0))), rest = 1.0 - root;
  painted = vec4(root * (1.0 + rest * (0.1 + 0.13 * rest * rest * rest)), 1.0);
}
#else
void main() {
  vec4 g = texture(geometry, uv);
  if (g.w < 0.5) discard;
#if MODE != 4 && MODE != 5 && MODE != 6
  vec3 n = unfolded(g.xy / g.w);
#if defined(OF_DEPTH) && MODE != 7
  n = normalOfDepth(n);
#endif
#ifdef BENT
  vec4 b = texture(bend, uv * bendPlace.xy + bendPlace.zw);
  n = normalize(n + bent * bendTurn * vec3(b.yz / max(b.w, 1e-3), 0.0));
#endif
#endif
#if MODE == 0 || MODE == 2
  vec3 colour = texture(paint, uv).rgb / g.w; colour *= colour;
#endif
  vec3 shown;
#if MODE == 2
  shown = pow(0.85 * colour, vec3(1.0 / 2.2));
#elif MODE == 3
  shown = 0.5 + 0.5 * vec3(n.x, -n.y, -n.z);
#elif MODE == 4
  shown = ramp((p.z - scale.x) / (2.0 * scale.y) + scale.z);
  float line = abs(fract(p.z / contour - 0.5) - 0.5) / max(fwidth(p.z / contour), 1e-6);
  shown *= 0.72 + 0.28 * smoothstep(0.4, 1.2, line);
#elif MODE == 5
  shown = ramp((exp2(texture(doubt, uv).r * 255.0 / SIGMA_SCALE) - 1.0) / ${SIGMA_STOP}.0);
#elif MODE == 6
  shown = ramp((texture(doubt, uv).g * 255.0 - 1.0) / depthSigmaSpan);
#elif MODE == 7
  shown = ramp(degrees(acos(clamp(dot(n, normalOfDepth(n)), -1.0, 1.0))) / ${SIGMA_STOP}.0);
#else
#if MODE == 1
  vec3 base = vec3(0.62);
#else
  vec3 base = 0.85 * colour;
#endif
#ifdef GLOSS
  vec3 v = normalize(eye.w > 0.0 ? eye.xyz - p : eye.xyz);
#endif
  vec3 sum = vec3(0.0);
  for (int k = 0; k < count; k++) {
    vec3 to = source[k].w > 0.0 ? source[k].xyz - p : source[k].xyz;
    float far2 = dot(to, to); vec3 d = to * inversesqrt(far2);
    float fall = source[k].w > 0.0 ? 1.0 / far2 : 1.0;
#ifdef LOBES
    if (axis[k].w >= 0.0) fall *= lobeAt(acos(clamp(-dot(d, axis[k].xyz), -1.0, 1.0)), axis[k].w);
#endif
    float nl = max(dot(n, d), 0.0);
#ifdef SHADOWS
    if (nl > 0.0) nl *= lit(n, d, source[k].w > 0.0 ? sqrt(far2) : 1e9);
#endif
#ifdef GLOSS
    sum += power[k] * fall * nl * (base + gloss * gloss * 5.0 * ggx(n, d, v, mix(0.5, 0.13, gloss)));
#else
    sum += power[k] * fall * nl * base;
#endif
  }
  sum = exposure * sum + 0.012 * base;
  sum = mix(sum, 0.75 + 0.25 * (1.0 - exp((0.75 - sum) / 0.25)), step(0.75, sum));
  shown = pow(sum, vec3(1.0 / 2.2));
#endif
  painted = vec4(gl_FrontFacing ? shown : vec3(0.09, 0.1, 0.11), 1.0);
}
#endif`;
