// A target painted on the tissue. State by colour (Okabe and Ito 2008) AND shape: MARK_WAITING thin broken ring,
// MARK_LIT double ring with a pulsing outer one, MARK_DONE filled disc with a tick. A dark rim keeps it readable on
// pale and on dark tissue alike.
in vec3 v_position;
in vec3 v_rest;
in vec3 v_normal;
in float v_open;
out vec4 colour;
uniform vec4 u_mark;    // xyz centre in T, w radius
uniform vec3 u_across;  // unit, in the disc's plane: the picture's right
uniform vec3 u_up;      // unit, in the disc's plane: the picture's up
uniform vec3 u_normal;

float band(float r, float from, float to, float soft) {
  return smoothstep(from - soft, from + soft, r) * (1.0 - smoothstep(to - soft, to + soft, r));
}

float stroke(vec2 p, vec2 a, vec2 b) {
  vec2 ab = b - a;
  return length(p - a - ab * clamp(dot(p - a, ab) / dot(ab, ab), 0.0, 1.0));
}

void main() {
  vec3 from = v_rest - u_mark.xyz;
  float height = dot(from, u_normal) / u_mark.w;
  vec2 p = vec2(dot(from, u_across), dot(from, u_up)) / u_mark.w;
  float r = length(p);
  float soft = clamp(0.75 * length(vec2(fwidth(p.x), fwidth(p.y))), 0.004, 0.5);
  float ink, halo;
  vec3 tint;
#if defined(MARK_LIT)
  tint = vec3(1.0, 0.84, 0.03);
  float grow = 1.34 + 0.16 * sin(axis.w * 6.2831853);
  ink = max(band(r, 0.80, 1.0, soft), band(r, grow, grow + 0.13, soft));
  ink = max(ink, band(r, -1.0, 0.14, soft));
  halo = max(band(r, 0.72, 1.08, soft), band(r, grow - 0.07, grow + 0.20, soft));
  halo = max(halo, band(r, -1.0, 0.22, soft));
#elif defined(MARK_DONE)
  tint = vec3(0.0, 0.42, 0.22);
  ink = band(r, -1.0, 0.96, soft);
  halo = band(r, -1.0, 1.06, soft);
  float tick = min(stroke(p, vec2(-0.48, 0.02), vec2(-0.12, -0.38)), stroke(p, vec2(-0.12, -0.38), vec2(0.52, 0.42)));
  tint = mix(tint, vec3(0.95), 1.0 - smoothstep(0.11 - soft, 0.11 + soft, tick));
#else
  tint = vec3(0.13, 0.50, 1.0);
  float turn = fract(atan(p.y, p.x) * 6.0 / 6.2831853);
  float dash = smoothstep(0.06, 0.12, turn) * (1.0 - smoothstep(0.88, 0.94, turn));
  float inner = min(0.80, 1.0 - 2.2 * soft);  // two pixels wide at least, also far away and seen obliquely
  ink = band(r, inner, 1.0, 0.6 * soft) * dash;
  halo = band(r, inner - 0.09, 1.09, soft) * 0.75;
#endif
  float side = 1.0 - smoothstep(1.2, 1.8, abs(height));  // not on the organ's far side
  vec3 to_lamp = lamp.xyz - v_position;
  float n_l = max(dot(normalize(v_normal), normalize(to_lamp)), 0.0);
  float power = (0.58 + 0.30 * min(lamp_power(to_lamp), 1.0)) * (0.6 + 0.4 * n_l);  // lit from within: hue holds near and far
  float cover = max(0.92 * ink, 0.55 * halo) * side;
  colour = vec4(power * mix(vec3(0.006), tint, ink), cover);
}
