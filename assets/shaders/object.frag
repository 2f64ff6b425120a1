// Task board, foam, plastic and steel under the scope's light. One LOOK_ is defined; LIT adds a pulsing yellow rim.
in vec3 v_position;
in vec3 v_part;
in vec3 v_normal;
in float v_accent;
out vec4 colour;
uniform sampler3D u_noise;
uniform sampler2DShadow u_shadow;
uniform vec3 u_colour;
uniform vec3 u_accent;
uniform vec3 u_half;
#if defined(LOOK_FOAM)
uniform float u_bands;
uniform float u_wear;
#endif
#if defined(LOOK_BOARD)
uniform vec4 u_above[12];  // xyz centre in T, w radius
uniform int u_above_count;

// Line of half width w (m) at the multiples of a pitch, one pixel wide at least and then paler instead.
float rule(float at, float pitch, float w) {
  float off = abs(fract(at / pitch + 0.5) - 0.5) * pitch;
  float pixel = fwidth(at);
  float wide = max(w, 0.6 * pixel);
  return (1.0 - smoothstep(wide - 0.5 * pixel, wide + 0.5 * pixel, off)) * min(1.0, 1.6 * w / wide);
}

float marks(vec3 p) {
  if (p.z < -0.0002) return 0.0;
  vec2 inside = u_half.xy - abs(p.xy);
  float field = step(0.0049, min(inside.x, inside.y));
  float ten = max(rule(p.x, 0.010, 0.00020), rule(p.y, 0.010, 0.00020));
  float fifty = max(rule(p.x, 0.050, 0.00040), rule(p.y, 0.050, 0.00040));
  float frame = max(rule(inside.x - 0.005, 1.0, 0.00034), rule(inside.y - 0.005, 1.0, 0.00034));
  // Fine marks every millimetre along the frame, longer every five.
  vec2 far = step(inside.yx, vec2(0.0049)) * step(vec2(0.0036), inside.yx);
  float fine = max(rule(p.x, 0.001, 0.00010) * far.x, rule(p.y, 0.001, 0.00010) * far.y);
  return max(max(0.50 * ten, 0.90 * fifty) * field, max(0.9 * frame * step(0.0, min(inside.x, inside.y) - 0.0044), 0.5 * fine));
}

// What stands above keeps light thrown back by the walls away: darkest under a thing that rests, faint under a lifted one.
float open_above() {
  float open = 1.0;
  for (int i = 0; i < u_above_count; ++i) {
    vec3 d = u_above[i].xyz - v_position;
    float r2 = u_above[i].w * u_above[i].w;
    float up = max(d.z, 0.0);
    open *= 1.0 - 0.72 * r2 / (r2 + up * up) / (1.0 + dot(d.xy, d.xy) / (0.9 * r2 + 0.15 * up * up));
  }
  return open;
}
#endif

void main() {
  vec3 n = normalize(v_normal);
  vec3 to_lamp = lamp.xyz - v_position;
  vec3 l = normalize(to_lamp);
  vec3 v = normalize(eye.xyz - v_position);
  vec3 h = normalize(l + v);
  vec3 part_mm = v_part * 1000.0;
  vec3 base = mix(u_colour, u_accent, v_accent);
  float wrap = 0.12, gloss = 0.35, shine = 0.05, open = 1.0;
#if defined(LOOK_FOAM)
  wrap = 0.40;
  gloss = 0.7;
  shine = 0.012;
  float footprint = length(fwidth(part_mm));
  vec4 coarse = textureLod(u_noise, part_mm * 0.055, 0.0);
  vec4 cell = textureLod(u_noise, part_mm * 0.27 + 0.3, 0.0);
  float fade = 1.0 - smoothstep(0.35, 1.2, footprint);
  float pore = smoothstep(0.50, 0.66, cell.w) * fade;
  base *= 0.86 + 0.28 * coarse.w;
  base *= 1.0 - 0.34 * pore;
  n = normalize(n + (0.30 * fade) * (cell.xyz * 2.0 - 1.0) + (0.10 + 0.5 * u_wear) * (coarse.xyz * 2.0 - 1.0));
  // Bands round the long axis tell the class where colours do not.
  float pitch = 2.6;
  float at = part_mm.z - 1000.0 * u_half.z + 3.2;  // from 3.2 mm under the end
  float order = floor(-at / pitch + 0.5);
  float band = step(0.0, order + 0.1) * step(order, u_bands - 0.5) *
               (1.0 - smoothstep(0.55 - 0.5 * footprint, 0.75 + 0.5 * footprint, abs(at + order * pitch)));
  base = mix(base, u_accent, 0.9 * band);
  float crease = 1.0 - smoothstep(0.02, 0.10, abs(coarse.w - 0.52));
  base *= 1.0 - u_wear * (0.30 + 0.40 * crease);
#elif defined(LOOK_BOARD)
  wrap = 0.08;
  gloss = 0.42;
  shine = 0.03;
  base = mix(base * (0.96 + 0.08 * textureLod(u_noise, part_mm * 0.11, 1.0).w), u_accent, marks(v_part));
  open = open_above();
#elif defined(LOOK_STEEL)
  gloss = 0.22;
  shine = 0.60;
#endif
  float n_l = dot(n, l);
  float diffuse = max((n_l + wrap) / ((1.0 + wrap) * (1.0 + wrap)), 0.0);
  float shade = lamp_shadow(u_shadow, v_position + 0.0006 * normalize(v_normal));
#if defined(LOOK_BOARD)
  shade *= contact_shade(v_position);
#endif
  float power = lamp_power(to_lamp);
  float fresnel = schlick(shine, max(dot(v, h), 0.0));
  vec3 glint = vec3(0.10 * fresnel * ggx(max(dot(n, h), 0.0), gloss) * clamp(3.0 * n_l, 0.0, 1.0) * shade);
#if defined(LOOK_STEEL)
  glint += 0.30 * fresnel * mix(vec3(0.05, 0.06, 0.07), vec3(0.32), smoothstep(-0.5, 0.9, dot(reflect(-v, n), -axis.xyz)));
  base *= 0.25;
#endif
  vec3 lit = power * (base * (diffuse * shade * open + 0.10 * open) + glint);
#ifdef LIT
  float rim = 1.0 - max(dot(n, v), 0.0);
  float pulse = 0.75 + 0.25 * sin(axis.w * 6.2831853);
  lit += vec3(1.0, 0.84, 0.03) * (pulse * (0.06 + 0.75 * rim * rim * rim));
#endif
  colour = vec4(lit, 1.0);
}
