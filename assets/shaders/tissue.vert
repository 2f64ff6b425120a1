// Tissue and decals on it: one displacement for both, so that their depths agree to the bit.
layout(location = 0) in vec3 a_position;
layout(location = 1) in vec3 a_normal;
layout(location = 2) in vec2 a_light;
out vec3 v_position;
out vec3 v_rest;
out vec3 v_normal;
out float v_open;
#ifdef DEFORMED
layout(location = 3) in vec3 a_rest;
layout(location = 4) in vec3 a_rest_normal;
out vec3 v_rest_normal;
out vec3 v_place;  // deformed, before breath and dent
#else
#define a_rest a_position
#endif
#ifdef FIELDS
layout(location = 5) in vec4 a_fields;
out vec4 v_fields;
#endif
#ifdef CUT
out float v_cut;
#endif
uniform vec3 u_breath;  // how far breathing has moved this part
invariant gl_Position;

void main() {
  vec3 p = a_position;
#ifdef DIMPLED
  p -= dent(p).deep * dimple_normal.xyz;
#endif
  p += u_breath;
  v_position = p;
  v_rest = a_rest;
  v_normal = a_normal;
  v_open = a_light.x;
#ifdef DEFORMED
  v_rest_normal = a_rest_normal;
  v_place = a_position;
#endif
#ifdef FIELDS
  v_fields = a_fields;
#endif
#ifdef CUT
  v_cut = a_light.y;
#endif
  gl_Position = view_projection * vec4(p, 1.0);
}
