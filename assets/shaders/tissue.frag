// Wet tissue under a scope's own light (recipe: solid noise at the rest position, wrapped diffuse per channel, two-lobe wet film).
// One of LOOK_LIVER, LOOK_GALLBLADDER, LOOK_WALL, LOOK_FAT, LOOK_SPLEEN, LOOK_KIDNEY, LOOK_PANCREAS, LOOK_DUCT, LOOK_ARTERY,
// LOOK_VEIN, LOOK_BONE is defined, else plain flesh (stomach, bowel). DIMPLED: dented by the tip. MARKED: bears blood, char,
// whitening, wet, with FIELDS those of its vertices too. CUT: wall of a cut and what lies beside its lip.
// DEFORMED: has left its rest, to which its texture sticks. PRESET_LOW: plain
// Phong of the same colours; PRESET_SOFT: without the finest octave.
in vec3 v_position;
in vec3 v_rest;
in vec3 v_normal;
in float v_open;
#ifdef DEFORMED
in vec3 v_rest_normal;
in vec3 v_place;
#else
#define v_rest_normal v_normal
#define v_place v_rest
#endif
#ifdef FIELDS
in vec4 v_fields;  // blood, char, whitening, wet
#endif
#ifdef CUT
in float v_cut;  // app/picture/models/cut_seams.h: from 2 on a wall, mm below the lip; below 1 outside, mm from it
#endif
out vec4 colour;
uniform sampler3D u_noise;
uniform sampler2DShadow u_shadow;
#ifdef MARKED
layout(std140) uniform Marks {
  vec4 mark_place[32];  // xyz at rest, w radius
  vec4 mark_kind[32];   // strength as blood, char, whitening, wet
  vec4 mark_count;
};
#endif

// Distance from the line where smooth noise passes its middle, in about millimetres times the frequency; .y: how clear it is. Only the
// slope along the surface counts: where the noise changes into the depth alone, the line would spread to a patch.
vec2 vein(vec3 at, float level) {
  vec4 q = textureLod(u_noise, at, level);
  vec3 g = q.xyz * 2.0 - 1.0, n = normalize(v_rest_normal);
  float slope = length(g - n * dot(g, n));
  return vec2(abs(q.w - 0.5) / max(slope, 0.08), smoothstep(0.06, 0.16, slope));
}

// Vessels in two scales: trunks that thin out where a broad noise fades, and twigs near them. x: trunks, y: twigs.
vec2 vessels(vec3 rest_mm, float f, vec4 bend, float where) {
  vec2 trunk = vein(rest_mm * f + 0.045 * bend.xyz, 2.0);
  float width = 0.029 * smoothstep(0.34, 0.62, where);
  float t = (1.0 - smoothstep(0.35 * width, width + 0.004, trunk.x)) * trunk.y * step(0.004, width);
#if defined(PRESET_FULL)
  vec2 twig = vein(rest_mm * (2.9 * f) + 0.11 * bend.yzx + 0.37, 1.0);
  float near = 1.0 - smoothstep(0.10, 0.55, trunk.x);
  float w2 = 0.048 * near * smoothstep(0.30, 0.55, where);
  float u = (1.0 - smoothstep(0.2 * w2, w2 + 0.004, twig.x)) * twig.y * step(0.006, w2);
  return vec2(t, 0.75 * u);
#else
  return vec2(t, 0.0);
#endif
}

vec3 with_vessels(vec3 c, vec2 v, vec3 trunk, vec3 twig, float most) {
  c = mix(c, twig, most * v.y);
  return mix(c, trunk, most * v.x);
}

vec3 albedo(vec4 broad, vec4 coarse, vec4 middle, vec4 fine, vec3 rest_mm) {
#if defined(LOOK_LIVER)
  vec3 c = mix(vec3(0.225, 0.030, 0.016), vec3(0.335, 0.060, 0.034), smoothstep(0.28, 0.72, broad.w));
  c = mix(c, vec3(0.42, 0.105, 0.062), 0.50 * smoothstep(0.44, 0.76, coarse.w));
  c = mix(c, vec3(0.165, 0.016, 0.012), 0.40 * smoothstep(0.56, 0.30, middle.w));
  return c * (0.78 + 0.44 * fine.w);
#elif defined(LOOK_GALLBLADDER)
  vec3 c = mix(vec3(0.235, 0.235, 0.125), vec3(0.46, 0.375, 0.235), smoothstep(0.30, 0.70, broad.w));
  c = mix(c, vec3(0.48, 0.26, 0.17), 0.55 * smoothstep(0.42, 0.78, coarse.w));
  c *= 0.90 + 0.2 * middle.w;
  return with_vessels(c, vessels(rest_mm, 0.0125, coarse, broad.w + 0.10), vec3(0.27, 0.040, 0.030), vec3(0.34, 0.085, 0.055), 0.66);
#elif defined(LOOK_WALL)
  vec3 c = mix(vec3(0.58, 0.150, 0.105), vec3(0.74, 0.31, 0.215), smoothstep(0.30, 0.75, broad.w));
  c = mix(c, vec3(0.76, 0.47, 0.32), 0.35 * smoothstep(0.45, 0.8, coarse.w));
  return with_vessels(c, vessels(rest_mm, 0.0062, coarse, broad.w), vec3(0.29, 0.030, 0.045), vec3(0.42, 0.07, 0.06), 0.62);
#elif defined(LOOK_FAT)
  vec3 c = mix(vec3(0.72, 0.338, 0.058), vec3(0.88, 0.552, 0.140), smoothstep(0.28, 0.70, broad.w));
  c = mix(c, vec3(0.93, 0.71, 0.35), 0.55 * smoothstep(0.42, 0.78, coarse.w));
  // Septa between the lobules.
  float septum = 1.0 - smoothstep(0.015, 0.075, abs(middle.w - 0.47));
  c = mix(c, vec3(0.56, 0.235, 0.050), 0.42 * septum);
  c *= 0.84 + 0.32 * middle.w;
  return with_vessels(c, vessels(rest_mm, 0.0095, coarse, coarse.w), vec3(0.44, 0.060, 0.030), vec3(0.58, 0.16, 0.05), 0.55);
#elif defined(LOOK_SPLEEN)
  vec3 c = mix(vec3(0.190, 0.030, 0.055), vec3(0.300, 0.062, 0.092), smoothstep(0.25, 0.75, broad.w));
  return mix(c, vec3(0.38, 0.145, 0.185), 0.40 * smoothstep(0.45, 0.80, coarse.w)) * (0.80 + 0.36 * middle.w);
#elif defined(LOOK_KIDNEY)
  vec3 c = mix(vec3(0.32, 0.080, 0.048), vec3(0.44, 0.130, 0.080), smoothstep(0.25, 0.75, broad.w));
  return mix(c, vec3(0.68, 0.42, 0.17), 0.35 * smoothstep(0.52, 0.80, coarse.w)) * (0.84 + 0.30 * middle.w);
#elif defined(LOOK_PANCREAS)
  vec3 c = mix(vec3(0.66, 0.37, 0.20), vec3(0.80, 0.53, 0.32), smoothstep(0.30, 0.70, middle.w));
  c = mix(c, vec3(0.52, 0.22, 0.13), 0.55 * (1.0 - smoothstep(0.02, 0.10, abs(middle.w - 0.5))));
  return mix(c, vec3(0.54, 0.24, 0.15), 0.45 * smoothstep(0.45, 0.80, coarse.w));
#elif defined(LOOK_DUCT)
  vec3 c = mix(vec3(0.36, 0.33, 0.17), vec3(0.52, 0.43, 0.25), smoothstep(0.30, 0.70, coarse.w));
  return with_vessels(c * (0.88 + 0.24 * middle.w), vessels(rest_mm, 0.024, coarse, broad.w), vec3(0.46, 0.08, 0.05), vec3(0.5, 0.15, 0.09), 0.6);
#elif defined(LOOK_ARTERY)
  vec3 c = mix(vec3(0.64, 0.17, 0.12), vec3(0.78, 0.33, 0.24), smoothstep(0.30, 0.70, coarse.w));
  return c * (0.88 + 0.24 * middle.w);
#elif defined(LOOK_VEIN)
  vec3 c = mix(vec3(0.20, 0.12, 0.22), vec3(0.30, 0.19, 0.29), smoothstep(0.30, 0.70, coarse.w));
  return c * (0.88 + 0.24 * middle.w);
#elif defined(LOOK_BONE)
  vec3 c = mix(vec3(0.70, 0.62, 0.48), vec3(0.80, 0.74, 0.62), smoothstep(0.30, 0.70, coarse.w));
  return mix(c, vec3(0.58, 0.30, 0.22), 0.25 * smoothstep(0.5, 0.8, broad.w));
#else
  vec3 c = mix(vec3(0.52, 0.165, 0.125), vec3(0.68, 0.315, 0.235), smoothstep(0.25, 0.75, broad.w));
  c = mix(c, vec3(0.76, 0.46, 0.35), 0.35 * smoothstep(0.48, 0.78, coarse.w)) * (0.86 + 0.28 * middle.w);
  return with_vessels(c, vessels(rest_mm, 0.0105, coarse, broad.w + 0.05), vec3(0.36, 0.035, 0.040), vec3(0.46, 0.085, 0.065), 0.70);
#endif
}

// Bend of the film's normal: swell, middle and finest octave; and of the diffuse one.
#if defined(LOOK_FAT)
const vec4 kBend = vec4(0.60, 0.42, 0.30, 0.80);
const vec3 kWet = vec3(1.2, 1.5, 0.50);
#elif defined(LOOK_WALL)
const vec4 kBend = vec4(0.50, 0.55, 0.34, 0.40);
const vec3 kWet = vec3(1.2, 1.7, 0.70);
#elif defined(LOOK_GALLBLADDER) || defined(LOOK_DUCT)
const vec4 kBend = vec4(0.22, 0.20, 0.16, 0.30);
const vec3 kWet = vec3(2.0, 3.0, 0.60);
#elif defined(LOOK_LIVER)
const vec4 kBend = vec4(0.40, 0.44, 0.40, 0.35);
const vec3 kWet = vec3(1.9, 2.2, 0.55);
#else
const vec4 kBend = vec4(0.36, 0.42, 0.42, 0.40);
const vec3 kWet = vec3(1.9, 2.4, 0.60);
#endif

// What the surface is made of just here; marks and the tip change it.
struct Surface {
  vec3 base;
  float bump;   // of all bends
  float film;   // how much wet film
  float sharp;  // how smooth its gloss is
};

#ifdef MARKED
vec4 marks_at(vec3 rest, vec4 coarse, vec4 middle) {
  vec4 sum = vec4(0.0);
#ifdef FIELDS
  sum = v_fields;
#endif
  for (int i = 0; i < int(mark_count.x); ++i) {
    vec3 d = rest - mark_place[i].xyz;
    sum += mark_kind[i] * exp(-1.2 * dot(d, d) / (mark_place[i].w * mark_place[i].w));
  }
  return sum + smoothstep(vec4(0.03), vec4(0.20), sum) * vec4(0.42, 0.30, 0.24, 0.24) * vec4(middle.w + 0.8 * coarse.w - 0.90, coarse.w + middle.w - 1.0, middle.w - 0.5, coarse.w - 0.5);
}

void mark(inout Surface s, inout vec3 n, vec4 coarse, vec4 middle, vec4 fine) {
  vec4 there = marks_at(v_rest, coarse, middle);
  float white = smoothstep(0.14, 0.60, there.z);
  float grey = dot(s.base, vec3(0.4, 0.35, 0.25));
  s.base = mix(s.base, vec3(0.74, 0.62, 0.50) * (0.62 + 0.9 * grey) * (0.90 + 0.2 * middle.w), 0.88 * white);
  s.film *= 1.0 - 0.40 * white;

  float burnt = smoothstep(0.20, 0.40, there.y), core = smoothstep(0.38, 0.62, there.y + 0.25 * (fine.w - 0.5));
  vec3 crust = mix(vec3(0.30, 0.165, 0.075), vec3(0.095, 0.050, 0.028), burnt);
  float singed = smoothstep(0.10, 0.24, there.y);
  s.base = mix(s.base, mix(vec3(0.60, 0.47, 0.34), crust, smoothstep(0.15, 0.32, there.y)), 0.92 * singed);
  s.base = mix(s.base, vec3(0.0115, 0.0095, 0.0085) * (0.6 + 0.8 * fine.w), core);
  s.bump *= 1.0 + 0.9 * burnt;
  s.film *= 1.0 - 0.88 * burnt;

  float wet = smoothstep(0.18, 0.40, there.w);
  s.base *= 1.0 - 0.16 * wet;
  s.bump *= 1.0 - 0.72 * wet;
  s.film *= 1.0 + 0.9 * wet;
  s.sharp = max(s.sharp, 0.8 * wet);

  // A thin film stains what is under it, a body of blood hides it, and the thicker the darker.
  float stain = smoothstep(0.14, 0.30, there.x), blood = smoothstep(0.21, 0.34, there.x), deep = smoothstep(0.26, 0.80, there.x);
  vec3 through = s.base * vec3(0.70, 0.22, 0.20);
  vec3 body = mix(vec3(0.300, 0.0090, 0.0070), vec3(0.110, 0.0022, 0.0024), deep);
  s.base = mix(s.base, mix(through, body, 0.98 * blood), stain);
  s.bump *= 1.0 - 0.72 * blood;
  s.film = mix(s.film, mix(1.2, 1.5, blood), stain);
  s.sharp = mix(s.sharp, 0.85, blood);
  // A pool's rim is rounded: the film tilts down the slope of the field.
  vec3 dx = dFdx(v_position), dy = dFdy(v_position);
  vec3 slope = dFdx(there.x) * dx / max(dot(dx, dx), 1e-12) + dFdy(there.x) * dy / max(dot(dy, dy), 1e-12);
  float rim = blood * (1.0 - smoothstep(0.30, 0.52, there.x));
  n = normalize(n - rim * 0.0042 * slope);
}
#endif

#ifdef CUT
// Raw tissue by its capillaries' colour, and what runs between its lobules.
#if defined(LOOK_LIVER)
const vec3 kRaw = vec3(0.235, 0.017, 0.010), kSepta = vec3(0.34, 0.075, 0.045);
#elif defined(LOOK_SPLEEN)
const vec3 kRaw = vec3(0.165, 0.010, 0.018), kSepta = vec3(0.30, 0.060, 0.075);
#elif defined(LOOK_KIDNEY)
const vec3 kRaw = vec3(0.260, 0.034, 0.020), kSepta = vec3(0.42, 0.130, 0.080);
#elif defined(LOOK_FAT)
const vec3 kRaw = vec3(0.780, 0.400, 0.090), kSepta = vec3(0.62, 0.230, 0.080);
#elif defined(LOOK_PANCREAS)
const vec3 kRaw = vec3(0.600, 0.270, 0.150), kSepta = vec3(0.70, 0.420, 0.270);
#else
const vec3 kRaw = vec3(0.420, 0.060, 0.045), kSepta = vec3(0.56, 0.200, 0.150);
#endif
const vec3 kCapsule = vec3(0.46, 0.20, 0.15);

float cut_rim(vec4 grain) {
  bool wall = v_cut > 1.5;
  float from_lip = (wall ? v_cut - 2.0 : 1.0 - v_cut) + 0.30 * (grain.w - 0.5);
  return 1.0 - smoothstep(wall ? 0.05 : 0.10, wall ? 0.30 : 0.36, from_lip);
}

// Granular and moist; grain: lobules of a millimetre.
void lay_open(inout Surface s, inout vec3 n, vec4 grain, vec4 middle) {
  if (v_cut > 1.5) {
    s.base = mix(kRaw * (0.50 + 0.55 * middle.w), kSepta, 0.75 * smoothstep(0.50, 0.68, grain.w));
    s.base *= 0.55 + 0.9 * smoothstep(0.26, 0.50, grain.w);
    s.bump = 1.5;
    s.film = 1.35;
    s.sharp = 0.35;
    n = normalize(n + 0.55 * (grain.xyz * 2.0 - 1.0));
  }
  float rim = cut_rim(grain);
  s.base = mix(s.base, kCapsule, 0.8 * rim);
  s.film *= 1.0 - 0.5 * rim;
}

// Under a film of blood a wound stays a wound: dark to its ground, its lip a paler line where the film is thin.
void keep_open(inout Surface s, vec4 grain) {
  if (v_cut > 1.5) {
    s.base *= mix(1.0, 0.42, smoothstep(0.3, 3.5, v_cut - 2.0));
    s.film *= mix(1.0, 0.55, smoothstep(0.3, 3.5, v_cut - 2.0));
  }
#ifdef MARKED
  float covered = 1.0 - smoothstep(0.010, 0.045, s.base.g);
  s.base = mix(s.base, vec3(0.36, 0.050, 0.035), 0.5 * cut_rim(grain) * covered);
#endif
}
#endif

#ifdef DIMPLED
// Blood is pressed out under the instrument and into a rim round it, no wider than a deep dent of firm tissue.
vec3 press(inout Surface s, vec3 n) {
  Dent pressed = dent(v_place);
  float spread2 = dimple_normal.w * dimple_normal.w;
  float hard = clamp(dimple.w / 0.0028, 0.0, 1.0);
  float bled = pressed.reach * max(1.0, spread2 / (0.0047 * 0.0047));
  float pale = hard * exp(-0.50 * bled);
  float flush = hard * exp(-0.125 * (bled - 5.5) * (bled - 5.5));
  float grey = dot(s.base, vec3(0.4, 0.35, 0.25));
  s.base = mix(s.base, max(vec3(0.80, 0.54, 0.43) * (0.48 + 1.2 * grey), 1.15 * s.base), 0.90 * pale);
  s.base *= 1.0 - vec3(0.08, 0.34, 0.34) * flush;
  s.film *= 1.0 - 0.40 * pale;
  s.bump *= 1.0 - 0.45 * pale;  // stretched smooth
  float out_of = dot(n, dimple_normal.xyz);
  return normalize((1.0 - dot(pressed.slope, dimple_normal.xyz)) * n + out_of * pressed.slope);
}
#endif

// The part of a slope of the texture that lies along the surface, turned with it by the shortest way from rest.
vec3 across(vec3 g, vec3 n) {
#ifdef DEFORMED
  vec3 r = normalize(v_rest_normal);
  g -= r * dot(g, r);
  return g - (n + r) * (dot(g, n) / max(1.0 + dot(n, r), 0.1));
#else
  return g - n * dot(g, n);
#endif
}

#ifdef PRESET_LOW
vec3 lit_by_lamp(Surface s, vec3 n, vec3 l, vec3 v, vec4 coarse, vec4 middle, vec4 fine) {
  float gloss = pow(max(dot(reflect(-l, n), v), 0.0), 24.0);
  float shade = lamp_shadow(u_shadow, v_position) * contact_shade(v_position);
  return s.base * (0.12 + max(dot(n, l), 0.0) * shade) * (0.35 + 0.65 * v_open) + vec3(0.10 * s.film * gloss);
}
#else
vec3 lit_by_lamp(Surface s, vec3 n, vec3 l, vec3 v, vec4 coarse, vec4 middle, vec4 fine) {
  vec3 swell = across(coarse.xyz * 2.0 - 1.0, n), mid = across(middle.xyz * 2.0 - 1.0, n), tiny = across(fine.xyz * 2.0 - 1.0, n);
  vec3 n_diffuse = normalize(n + s.bump * kBend.w * (kBend.x * swell + kBend.y * mid + 0.5 * kBend.z * tiny));
  vec3 n_film = normalize(n + s.bump * (kBend.x * swell + 1.5 * kBend.y * mid + 1.5 * kBend.z * tiny));

  vec3 wrap = vec3(0.42, 0.14, 0.09);
  vec3 diffuse = max((vec3(dot(n_diffuse, l)) + wrap) / ((1.0 + wrap) * (1.0 + wrap)), vec3(0.0));
  vec3 crevice = mix(vec3(1.0), vec3(1.15, 0.50, 0.40) * (0.30 + 0.70 * v_open), 0.90 * (1.0 - v_open));
  float shade = lamp_shadow(u_shadow, v_position);

  vec3 h = normalize(l + v);
  float n_h = max(dot(n_film, h), 0.0);
  float n_l = clamp(dot(n, l) * 3.0, 0.0, 1.0);
  // The film breaks up: islands of it between drier patches, each with its own smoothness.
  float island = smoothstep(0.40, 0.58, 0.50 * middle.w + 0.50 * coarse.w + 0.20 * (fine.w - 0.5));
  float mottle = mix(0.10 + 1.35 * island, 1.0, s.sharp);
  float alpha = mix(0.085 + 0.10 * (1.0 - island), 0.055, s.sharp);
  float fresnel = schlick(0.022, max(dot(v, h), 0.0));
  float wet = kWet.x * ggx(n_h, alpha) + kWet.y * ggx(n_h, 0.24) + kWet.z * ggx(n_h, 0.5);
  vec3 glint = vec3(1.0, 0.97, 0.94) * (0.46 * fresnel * wet * mottle * s.film * n_l * shade * mix(0.25, 1.0, v_open));

  vec3 scattered = s.base * vec3(0.085, 0.048, 0.044) * v_open;
  return s.base * diffuse * crevice * (shade * contact_shade(v_position)) + scattered + glint;
}
#endif

void main() {
  vec3 rest_mm = v_rest * 1000.0;
  vec4 broad = textureLod(u_noise, rest_mm * 0.0083 + 0.57, 1.0);
  vec4 coarse = textureLod(u_noise, rest_mm * 0.021, 0.0);
  vec4 middle = vec4(0.5), fine = vec4(0.5);
#ifndef PRESET_LOW
  middle = textureLod(u_noise, rest_mm * 0.083 + 0.37, 0.0);
#endif
#ifdef PRESET_FULL
  float footprint_mm = length(fwidth(rest_mm));
  float sharp = 1.0 - smoothstep(0.30, 1.3, footprint_mm);  // the finest octave fades before it streaks
  fine = mix(vec4(0.5), textureLod(u_noise, rest_mm * 0.31 + 0.11, 0.0), sharp);
  middle.xyz = mix(vec3(0.5), middle.xyz, 1.0 - 0.75 * smoothstep(0.7, 2.2, footprint_mm));  // far glints do not glitter
#endif
  Surface s = Surface(albedo(broad, coarse, middle, fine, rest_mm), 1.0, 1.0, 0.0);
  vec3 n = normalize(v_normal);
#ifdef DIMPLED
  n = press(s, n);
#endif
#ifdef CUT
  vec4 grain = textureLod(u_noise, rest_mm * 0.155 + 0.21, 0.0);
  lay_open(s, n, grain, middle);
#endif
#ifdef MARKED
  mark(s, n, coarse, middle, fine);
#endif
#ifdef CUT
  keep_open(s, grain);
#endif
  vec3 to_lamp = lamp.xyz - v_position;
  vec3 lit = lit_by_lamp(s, n, normalize(to_lamp), normalize(eye.xyz - v_position), coarse, middle, fine);
  colour = vec4(hazed(lamp_power(to_lamp) * lit, v_position), 1.0);
}
