// A thing that is not there: see-through body, lit outline. GHOST_WAITING is broken into dashes along its length,
// GHOST_LIT is whole and pulses, GHOST_DONE is whole, still and faint. Tip and roll fin are painted solid.
in vec3 v_position;
in vec3 v_part;
in vec3 v_normal;
in float v_accent;
out vec4 colour;
uniform vec3 u_colour;

void main() {
  vec3 n = normalize(v_normal);
  vec3 v = normalize(eye.xyz - v_position);
  vec3 to_lamp = lamp.xyz - v_position;
  float rim = 1.0 - max(dot(n, v), 0.0);
  float outline = smoothstep(0.35, 0.85, rim);
  float form = 0.55 + 0.45 * max(dot(n, normalize(to_lamp)), 0.0);  // the body still turns towards the light
  float power = 0.55 + 0.30 * min(lamp_power(to_lamp), 1.0);
#if defined(GHOST_LIT)
  float pulse = 0.88 + 0.12 * sin(axis.w * 6.2831853);
  float cover = mix(0.34, 0.95, outline);
  cover = mix(cover, 0.95, v_accent);
  vec3 tint = mix(u_colour, vec3(1.0, 0.33, 0.02), v_accent);
#elif defined(GHOST_DONE)
  float pulse = 1.0;
  float cover = mix(0.14, 0.60, outline) + 0.25 * v_accent;
  vec3 tint = u_colour;
#else
  float pulse = 1.0;
  float dash = smoothstep(0.10, 0.16, abs(fract(v_part.z / 0.008) - 0.5));
  float cover = mix(0.05, 0.42, outline) * dash + 0.22 * v_accent;
  vec3 tint = u_colour;
#endif
  colour = vec4(power * pulse * form * tint * (1.0 + 0.6 * outline), min(cover, 1.0));
}
