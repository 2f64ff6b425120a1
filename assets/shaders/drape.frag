// The inside of a box trainer: a matt woven drape, so that whatever lies on it stands out.
in vec3 v_position;
in vec3 v_rest;
in vec3 v_normal;
in float v_open;
out vec4 colour;
uniform sampler3D u_noise;
uniform sampler2DShadow u_shadow;

#ifdef PRESET_LOW
void main() {
  vec3 to_lamp = lamp.xyz - v_position;
  float diffuse = max(dot(normalize(v_normal), normalize(to_lamp)), 0.0);
  float shade = lamp_shadow(u_shadow, v_position) * contact_shade(v_position);
  colour = vec4(lamp_power(to_lamp) * vec3(0.038, 0.110, 0.122) * v_open * (0.85 * diffuse * shade + 0.16), 1.0);
}
#else
void main() {
  vec3 rest_mm = v_rest * 1000.0;
  vec4 broad = textureLod(u_noise, rest_mm * 0.012 + 0.2, 0.0);
  vec4 fine = textureLod(u_noise, rest_mm * 0.13, 0.0);
  float footprint = length(fwidth(rest_mm.xy));
  float fade = 1.0 - smoothstep(0.20, 0.60, footprint);
  vec2 thread = sin(rest_mm.xy * 4.2);
  vec3 base = mix(vec3(0.030, 0.092, 0.105), vec3(0.045, 0.128, 0.140), smoothstep(0.3, 0.7, broad.w));
  base *= 0.90 + 0.20 * fine.w + 0.08 * fade * thread.x * thread.y;
  vec3 n = normalize(v_normal + 0.10 * (fine.xyz * 2.0 - 1.0) + 0.16 * (broad.xyz * 2.0 - 1.0));
  vec3 to_lamp = lamp.xyz - v_position;
  float n_l = dot(n, normalize(to_lamp));
  float diffuse = max((n_l + 0.2) / 1.44, 0.0);
  float shade = lamp_shadow(u_shadow, v_position) * contact_shade(v_position);
  colour = vec4(lamp_power(to_lamp) * base * v_open * (diffuse * shade + 0.14), 1.0);
}
#endif
