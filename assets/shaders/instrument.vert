// Rigid instrument parts: posed by u_model (part in T).
layout(location = 0) in vec3 a_position;
layout(location = 1) in vec3 a_normal;
layout(location = 2) in vec2 a_light;
uniform mat4 u_model;
out vec3 v_position;
out vec3 v_part;
out vec3 v_normal;
out float v_steel;

void main() {
  vec4 p = u_model * vec4(a_position, 1.0);
  v_position = p.xyz;
  v_part = a_position;
  v_normal = mat3(u_model) * a_normal;
  v_steel = a_light.y;
  gl_Position = view_projection * p;
}
