// Wet tissue under a scope's own light (recipe: solid noise at the rest position, wrapped diffuse per channel, two-lobe
// wet film). One of LOOK_LIVER, LOOK_GALLBLADDER, LOOK_WALL, LOOK_FAT, LOOK_SPLEEN, LOOK_KIDNEY, LOOK_PANCREAS, LOOK_DUCT, LOOK_ARTERY,
// LOOK_VEIN, LOOK_BONE is defined, else plain flesh (stomach, bowel).
in vec3 v_position;
in vec3 v_rest;
in vec3 v_normal;
in float v_open;
out vec4 colour;
uniform sampler3D u_noise;
uniform sampler2DShadow u_shadow;

// Vessels run where smooth noise passes its middle value. Its gradient (rgb) keeps their width even and ends them where
// the noise is flat; a second noise thins them out.
float vessels(vec3 at, float width, float where) {
  vec4 q = textureLod(u_noise, at, 2.0);
  float slope = length(q.xyz * 2.0 - 1.0);
  float off = abs(q.w - 0.5) / (slope + 0.02);
  return (1.0 - smoothstep(0.3 * width, width, off)) * smoothstep(0.10, 0.25, slope) * smoothstep(0.42, 0.60, where);
}

vec3 albedo(vec4 coarse, vec4 middle, vec4 fine, vec3 rest_mm) {
  vec4 broad = textureLod(u_noise, rest_mm * 0.0083 + 0.57, 1.0);
#if defined(LOOK_LIVER)
  vec3 c = mix(vec3(0.205, 0.029, 0.017), vec3(0.300, 0.049, 0.028), smoothstep(0.25, 0.75, broad.w));
  c = mix(c, vec3(0.350, 0.076, 0.046), 0.55 * smoothstep(0.40, 0.78, coarse.w));
  c *= 0.80 + 0.24 * middle.w + 0.20 * fine.w;
  return c;
#elif defined(LOOK_GALLBLADDER)
  vec3 c = mix(vec3(0.255, 0.255, 0.125), vec3(0.48, 0.385, 0.215), smoothstep(0.30, 0.70, broad.w));
  c = mix(c, vec3(0.50, 0.29, 0.19), 0.40 * smoothstep(0.45, 0.80, coarse.w));
  c *= 0.90 + 0.2 * middle.w;
  float v = max(vessels(rest_mm * 0.011 + 0.03 * coarse.xyz, 0.050, coarse.w), 0.6 * vessels(rest_mm * 0.026 + 0.41, 0.060, broad.w));
  return mix(c, vec3(0.30, 0.035, 0.025), 0.62 * v);
#elif defined(LOOK_WALL)
  vec3 c = mix(vec3(0.43, 0.105, 0.075), vec3(0.60, 0.235, 0.165), smoothstep(0.30, 0.75, broad.w));
  c = mix(c, vec3(0.68, 0.40, 0.28), 0.30 * smoothstep(0.45, 0.8, coarse.w));
  float v = vessels(rest_mm * 0.0052 + 0.02 * coarse.xyz + 0.23, 0.050, coarse.w);
  return mix(c, vec3(0.25, 0.025, 0.03), 0.55 * v);
#elif defined(LOOK_FAT)
  vec3 c = mix(vec3(0.60, 0.295, 0.055), vec3(0.78, 0.50, 0.14), smoothstep(0.28, 0.70, broad.w));
  c = mix(c, vec3(0.80, 0.60, 0.25), 0.5 * smoothstep(0.42, 0.78, coarse.w));
  c *= 0.88 + 0.24 * middle.w;
  float v = vessels(rest_mm * 0.0075 + 0.02 * coarse.xyz + 0.61, 0.055, coarse.w);
  return mix(c, vec3(0.46, 0.07, 0.03), 0.60 * v);
#elif defined(LOOK_SPLEEN)
  vec3 c = mix(vec3(0.190, 0.030, 0.048), vec3(0.285, 0.055, 0.075), smoothstep(0.25, 0.75, broad.w));
  return mix(c, vec3(0.34, 0.12, 0.15), 0.35 * smoothstep(0.45, 0.80, coarse.w)) * (0.84 + 0.28 * middle.w);
#elif defined(LOOK_KIDNEY)
  vec3 c = mix(vec3(0.30, 0.075, 0.045), vec3(0.42, 0.120, 0.075), smoothstep(0.25, 0.75, broad.w));
  return mix(c, vec3(0.62, 0.36, 0.14), 0.30 * smoothstep(0.55, 0.80, coarse.w)) * (0.86 + 0.26 * middle.w);
#elif defined(LOOK_PANCREAS)
  vec3 c = mix(vec3(0.62, 0.35, 0.20), vec3(0.74, 0.49, 0.30), smoothstep(0.30, 0.70, middle.w));
  return mix(c, vec3(0.50, 0.22, 0.14), 0.45 * smoothstep(0.45, 0.80, coarse.w));
#elif defined(LOOK_DUCT)
  vec3 c = mix(vec3(0.44, 0.42, 0.24), vec3(0.60, 0.54, 0.32), smoothstep(0.30, 0.70, coarse.w));
  return c * (0.88 + 0.24 * middle.w);
#elif defined(LOOK_ARTERY)
  vec3 c = mix(vec3(0.60, 0.14, 0.10), vec3(0.72, 0.26, 0.19), smoothstep(0.30, 0.70, coarse.w));
  return c * (0.88 + 0.24 * middle.w);
#elif defined(LOOK_VEIN)
  vec3 c = mix(vec3(0.20, 0.12, 0.22), vec3(0.30, 0.19, 0.29), smoothstep(0.30, 0.70, coarse.w));
  return c * (0.88 + 0.24 * middle.w);
#elif defined(LOOK_BONE)
  vec3 c = mix(vec3(0.70, 0.62, 0.48), vec3(0.80, 0.74, 0.62), smoothstep(0.30, 0.70, coarse.w));
  return mix(c, vec3(0.58, 0.30, 0.22), 0.25 * smoothstep(0.5, 0.8, broad.w));
#else
  vec3 c = mix(vec3(0.44, 0.135, 0.105), vec3(0.58, 0.25, 0.19), smoothstep(0.25, 0.75, broad.w));
  float v = max(vessels(rest_mm * 0.0095 + 0.03 * coarse.xyz + 0.31, 0.050, coarse.w), 0.5 * vessels(rest_mm * 0.022 + 0.11, 0.060, broad.w));
  return mix(c * (0.85 + 0.3 * middle.w), vec3(0.30, 0.03, 0.03), 0.55 * v);
#endif
}

#if defined(LOOK_FAT)
const vec2 kRough = vec2(0.30, 0.22);
const vec3 kWet = vec3(1.0, 1.2, 0.4);
#elif defined(LOOK_WALL)
const vec2 kRough = vec2(0.34, 0.22);
const vec3 kWet = vec3(1.1, 1.3, 0.5);
#elif defined(LOOK_GALLBLADDER)
const vec2 kRough = vec2(0.15, 0.08);
const vec3 kWet = vec3(1.8, 2.6, 0.6);
#elif defined(LOOK_LIVER)
const vec2 kRough = vec2(0.20, 0.11);
const vec3 kWet = vec3(1.25, 2.4, 0.9);
#else
const vec2 kRough = vec2(0.24, 0.15);
const vec3 kWet = vec3(1.7, 2.2, 0.6);
#endif

void main() {
  vec3 rest_mm = v_rest * 1000.0;
  vec4 coarse = textureLod(u_noise, rest_mm * 0.021, 0.0);
#if defined(LOOK_WALL) || defined(LOOK_FAT)
  vec4 middle = textureLod(u_noise, rest_mm * 0.083 + 0.37, 1.0);
  vec4 fine = vec4(0.5);
#else
  vec4 middle = textureLod(u_noise, rest_mm * 0.083 + 0.37, 0.0);
  float footprint_mm = length(fwidth(rest_mm));
  float sharp = 1.0 - smoothstep(0.25, 1.1, footprint_mm);  // the finest octave fades before it streaks
  vec4 fine = mix(vec4(0.5), textureLod(u_noise, rest_mm * 0.31 + 0.11, 1.0), sharp);
#endif
  vec3 base = albedo(coarse, middle, fine, rest_mm);

  vec3 n = normalize(v_normal);
  vec3 to_lamp = lamp.xyz - v_position;
  vec3 l = normalize(to_lamp);
  vec3 v = normalize(eye.xyz - v_position);
  vec3 swell = 0.30 * (coarse.xyz * 2.0 - 1.0);
  swell -= n * dot(swell, n);
  vec3 bump = kRough.x * (middle.xyz * 2.0 - 1.0) + kRough.y * (fine.xyz * 2.0 - 1.0);
  bump -= n * dot(bump, n);
  float film = 1.0;
#ifdef DIMPLED
  vec3 from = v_rest - dimple.xyz;
  float reach = dot(from, from) / (dimple_normal.w * dimple_normal.w);
  float press = clamp(dimple.w / 0.003, 0.0, 1.0);
  float pale = press * exp(-0.62 * reach);
  float flush = press * exp(-0.5 * (reach - 5.0) * (reach - 5.0) / 4.0);
  float grey = dot(base, vec3(0.4, 0.35, 0.25));
  base = mix(base, max(vec3(0.72, 0.47, 0.38) * (0.45 + 1.2 * grey), 1.15 * base), 0.85 * pale);  // blood pressed out
  base *= 1.0 - vec3(0.10, 0.30, 0.30) * flush;                                  // and into the rim
  film = 1.0 - 0.5 * pale;
#endif
  vec3 n_diffuse = normalize(n + 0.35 * bump + 0.35 * swell);
  vec3 n_film = normalize(n + 1.6 * bump + 0.55 * swell);

  vec3 wrap = vec3(0.42, 0.14, 0.09);
  vec3 diffuse = max((vec3(dot(n_diffuse, l)) + wrap) / ((1.0 + wrap) * (1.0 + wrap)), vec3(0.0));
  float open = v_open;
  vec3 crevice = mix(vec3(1.0), vec3(1.10, 0.50, 0.42) * (0.35 + 0.65 * open), 0.85 * (1.0 - open));
  float shade = lamp_shadow(u_shadow, v_position);
  float power = lamp_power(to_lamp);

  vec3 h = normalize(l + v);
  float n_h = max(dot(n_film, h), 0.0);
  float n_l = clamp(dot(n, l) * 3.0, 0.0, 1.0);
  float mottle = 0.55 + 0.9 * smoothstep(0.35, 0.65, middle.w * 0.5 + coarse.w * 0.5);
  float fresnel = schlick(0.022, max(dot(v, h), 0.0));
  float wet = kWet.x * ggx(n_h, 0.085) + kWet.y * ggx(n_h, 0.24) + kWet.z * ggx(n_h, 0.5);
  vec3 glint = vec3(1.0, 0.97, 0.94) * (0.25 * fresnel * wet * mottle * film * n_l * shade * mix(0.4, 1.0, open));

  vec3 scattered = base * vec3(0.085, 0.050, 0.046) * open;
  vec3 lit = base * diffuse * crevice * (shade * contact_shade(v_position)) + glint;
  colour = vec4(power * (lit + scattered), 1.0);
}
