// Brushed steel jaws and the black insulated shaft. IN_BOX: a box trainer's drape is mirrored in place of tissue.
in vec3 v_position;
in vec3 v_part;
in vec3 v_normal;
in float v_steel;
out vec4 colour;
uniform sampler3D u_noise;

void main() {
  vec3 n = normalize(v_normal);
  vec3 to_lamp = lamp.xyz - v_position;
  vec3 l = normalize(to_lamp);
  vec3 v = normalize(eye.xyz - v_position);
  vec3 h = normalize(l + v);
  float power = min(lamp_power(to_lamp), 1.5);  // the processor holds bright metal near the lens down
  float n_l = max(dot(n, l), 0.0);
  float n_h = max(dot(n, h), 0.0);
  vec4 brush = texture(u_noise, v_part * vec3(900.0, 900.0, 60.0));
  vec3 r = reflect(-v, n);
  // What steel mirrors in there: lamp side pale, far side tissue red or drape, below dark.
#ifdef IN_BOX
  const vec3 far_side = vec3(0.022, 0.036, 0.040), near_side = vec3(0.190, 0.200, 0.205), glow = vec3(0.006, 0.008, 0.009);
#else
  const vec3 far_side = vec3(0.060, 0.026, 0.020), near_side = vec3(0.205, 0.190, 0.185), glow = vec3(0.012, 0.007, 0.006);
#endif
  float side = smoothstep(-0.5, 0.9, dot(r, -axis.xyz));
  vec3 room = mix(far_side, near_side, side);
  float f = schlick(0.60, max(dot(v, h), 0.0));
  vec3 steel = room * f * (0.75 + 0.4 * brush.w) + vec3(0.046, 0.047, 0.050) * n_l +
               vec3(0.95, 0.97, 1.0) * (0.030 * ggx(n_h, 0.30) + 0.009 * ggx(n_h, 0.12)) * n_l;
  vec3 sheath = vec3(0.0105, 0.0105, 0.012) * (0.4 + n_l) + vec3(0.012) * ggx(n_h, 0.34) * n_l +
                glow * side;
#ifdef ROLL_STRIPE
  // Painted line on the upper jaw's side, so that roll can be seen.
  float stripe = step(0.0, v_part.y) * (1.0 - v_steel) * (1.0 - smoothstep(0.00035, 0.00055, abs(v_part.x)));
  sheath = mix(sheath, vec3(0.55, 0.52, 0.46) * (0.15 + 0.85 * n_l), 0.9 * stripe);
#endif
  colour = vec4(power * mix(sheath, steel, v_steel), 1.0);
}
