// Scene objects: posed by u_model (O in T). PINCHED: soft body between two jaws, dented on both sides along u_pinch.
layout(location = 0) in vec3 a_position;
layout(location = 1) in vec3 a_normal;
layout(location = 2) in vec2 a_light;
uniform mat4 u_model;
#ifdef PINCHED
uniform vec3 u_half;
uniform vec4 u_pinch;  // xyz unit, O; w: total depth
#endif
out vec3 v_position;
out vec3 v_part;
out vec3 v_normal;
out float v_accent;

void main() {
  vec3 p = a_position;
  vec3 n = a_normal;
#ifdef PINCHED
  float along = dot(p, u_pinch.xyz);
  vec3 aside = p - along * u_pinch.xyz;
  float half_thickness = dot(abs(u_pinch.xyz), u_half);
  float spread2 = 0.0045 * 0.0045;  // a jaw is about as wide
  float w = exp(-dot(aside, aside) / (2.0 * spread2));
  float depth = 0.5 * u_pinch.w;
  p -= u_pinch.xyz * clamp(along / half_thickness, -1.0, 1.0) * depth * (0.35 + 0.65 * w);
  p += aside * 0.12 * u_pinch.w / half_thickness;  // what is pressed in there goes out here
  n = normalize(n - abs(dot(n, u_pinch.xyz)) * 0.65 * depth * w / spread2 * aside);
#endif
  vec4 world = u_model * vec4(p, 1.0);
  v_position = world.xyz;
  v_part = a_position;
  v_normal = mat3(u_model) * n;
  v_accent = a_light.y;
  gl_Position = view_projection * world;
}
