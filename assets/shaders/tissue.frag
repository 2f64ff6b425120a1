// Wet tissue under a scope's own light (recipe: solid noise at the rest position, wrapped diffuse per channel, two-lobe
// wet film). One of LOOK_LIVER, LOOK_GALLBLADDER, LOOK_WALL, LOOK_FAT is defined, else plain flesh.
in vec3 v_position;
in vec3 v_rest;
in vec3 v_normal;
in float v_open;
out vec4 colour;
uniform sampler3D u_noise;
uniform sampler2DShadow u_shadow;

float vessel(float q) { return smoothstep(0.93, 0.99, 1.0 - abs(2.0 * q - 1.0)); }

vec3 albedo(vec4 coarse, vec4 middle, vec4 fine, vec3 rest_mm) {
#if defined(LOOK_LIVER)
  vec3 c = mix(vec3(0.235, 0.036, 0.022), vec3(0.40, 0.082, 0.046), smoothstep(0.25, 0.75, coarse.w));
  c = mix(c, vec3(0.47, 0.135, 0.085), 0.45 * smoothstep(0.52, 0.75, middle.w));
  c *= 0.86 + 0.30 * fine.w;
  return c;
#elif defined(LOOK_GALLBLADDER)
  vec3 c = mix(vec3(0.40, 0.43, 0.24), vec3(0.66, 0.57, 0.36), smoothstep(0.3, 0.7, coarse.w));
  c = mix(c, vec3(0.62, 0.36, 0.25), 0.35 * smoothstep(0.5, 0.8, middle.w));
  float q = texture(u_noise, rest_mm * 0.017 + 0.05 * coarse.xyz).w;
  float v = max(vessel(q), 0.6 * vessel(texture(u_noise, rest_mm * 0.034 + 0.41).w));
  return mix(c, vec3(0.36, 0.045, 0.03), 0.75 * v);
#elif defined(LOOK_WALL)
  vec3 c = mix(vec3(0.40, 0.115, 0.085), vec3(0.58, 0.25, 0.19), smoothstep(0.3, 0.75, coarse.w));
  c = mix(c, vec3(0.66, 0.40, 0.30), 0.4 * smoothstep(0.5, 0.8, middle.w));
  float q = texture(u_noise, rest_mm * 0.0085 + 0.04 * coarse.xyz + 0.23).w;
  return mix(c, vec3(0.26, 0.025, 0.03), 0.6 * vessel(q));
#elif defined(LOOK_FAT)
  vec3 c = mix(vec3(0.56, 0.29, 0.055), vec3(0.76, 0.52, 0.16), smoothstep(0.25, 0.7, coarse.w));
  c = mix(c, vec3(0.80, 0.62, 0.27), 0.5 * smoothstep(0.5, 0.8, middle.w));
  float q = texture(u_noise, rest_mm * 0.014 + 0.05 * coarse.xyz + 0.61).w;
  return mix(c, vec3(0.50, 0.06, 0.03), 0.7 * vessel(q));
#else
  vec3 c = mix(vec3(0.42, 0.13, 0.10), vec3(0.60, 0.26, 0.20), smoothstep(0.25, 0.75, coarse.w));
  float q = texture(u_noise, rest_mm * 0.014 + 0.05 * coarse.xyz + 0.31).w;
  return mix(c * (0.85 + 0.3 * middle.w), vec3(0.34, 0.03, 0.03), 0.6 * vessel(q));
#endif
}

#if defined(LOOK_FAT)
const vec2 kRough = vec2(0.30, 0.22);
const vec3 kWet = vec3(1.0, 1.2, 0.4);
#elif defined(LOOK_WALL)
const vec2 kRough = vec2(0.34, 0.22);
const vec3 kWet = vec3(1.1, 1.3, 0.5);
#elif defined(LOOK_GALLBLADDER)
const vec2 kRough = vec2(0.20, 0.14);
const vec3 kWet = vec3(1.8, 2.4, 0.5);
#else
const vec2 kRough = vec2(0.30, 0.26);
const vec3 kWet = vec3(1.8, 2.0, 0.5);
#endif

float shadow() {
  vec4 s = lamp_projection * vec4(v_position, 1.0);
  vec3 uvz = s.xyz / s.w * 0.5 + 0.5;
  uvz.z -= 0.0012;
  float sum = 0.0;
  sum += texture(u_shadow, uvz + vec3(-0.0011, -0.0004, 0.0));
  sum += texture(u_shadow, uvz + vec3(0.0004, -0.0011, 0.0));
  sum += texture(u_shadow, uvz + vec3(0.0011, 0.0004, 0.0));
  sum += texture(u_shadow, uvz + vec3(-0.0004, 0.0011, 0.0));
  return 0.30 + 0.70 * 0.25 * sum;  // floor: light scattered inside the tissue
}

// Darkening near the instrument: the nearer the shaft to the tissue, the darker the tissue under it.
float contact_shade() {
  float along = clamp(dot(v_position - tip.xyz, shaft.xyz), 0.0, shaft.w);
  float gap_mm = 1000.0 * max(length(v_position - tip.xyz - along * shaft.xyz) - tip.w, 0.0);
  return 1.0 - 0.55 * exp(-gap_mm * gap_mm / 18.0);
}

void main() {
  vec3 rest_mm = v_rest * 1000.0;
  float footprint_mm = length(fwidth(rest_mm));
  float sharp = 1.0 - smoothstep(0.25, 1.1, footprint_mm);  // the finest octave fades before it streaks
  vec4 coarse = texture(u_noise, rest_mm * 0.021);
  vec4 middle = texture(u_noise, rest_mm * 0.083 + 0.37);
  vec4 fine = mix(vec4(0.5), texture(u_noise, rest_mm * 0.31 + 0.11), sharp);
  vec3 base = albedo(coarse, middle, fine, rest_mm);

  vec3 n = normalize(v_normal);
  vec3 to_lamp = lamp.xyz - v_position;
  vec3 l = normalize(to_lamp);
  vec3 v = normalize(eye.xyz - v_position);
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
  base = mix(base, vec3(0.72, 0.47, 0.38) * (0.45 + 1.2 * grey), 0.85 * pale);  // blood pressed out
  base *= 1.0 - vec3(0.10, 0.30, 0.30) * flush;                                  // and into the rim
  film = 1.0 - 0.5 * pale;
#endif
  vec3 n_diffuse = normalize(n + 0.35 * bump);
  vec3 n_film = normalize(n + 1.6 * bump);

  vec3 wrap = vec3(0.42, 0.14, 0.09);
  vec3 diffuse = max((vec3(dot(n_diffuse, l)) + wrap) / ((1.0 + wrap) * (1.0 + wrap)), vec3(0.0));
  float open = v_open;
  vec3 crevice = mix(vec3(1.0), vec3(1.10, 0.50, 0.42) * (0.35 + 0.65 * open), 0.85 * (1.0 - open));
  float shade = shadow();
  float power = lamp_power(to_lamp);

  vec3 h = normalize(l + v);
  float n_h = max(dot(n_film, h), 0.0);
  float n_l = clamp(dot(n, l) * 3.0, 0.0, 1.0);
  float mottle = 0.55 + 0.9 * smoothstep(0.35, 0.65, middle.w * 0.5 + coarse.w * 0.5);
  float fresnel = schlick(0.022, max(dot(v, h), 0.0));
  float wet = kWet.x * ggx(n_h, 0.085) + kWet.y * ggx(n_h, 0.24) + kWet.z * ggx(n_h, 0.5);
  vec3 glint = vec3(1.0, 0.97, 0.94) * (0.25 * fresnel * wet * mottle * film * n_l * shade * mix(0.4, 1.0, open));

  vec3 scattered = base * vec3(0.050, 0.030, 0.028) * open;
  vec3 lit = base * diffuse * crevice * (shade * contact_shade()) + glint;
  colour = vec4(power * (lit + scattered), 1.0);
}
