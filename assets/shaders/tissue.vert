// Tissue and decals on it: one displacement for both, so that their depths agree to the bit.
layout(location = 0) in vec3 a_position;
layout(location = 1) in vec3 a_normal;
layout(location = 2) in vec2 a_light;
out vec3 v_position;
out vec3 v_rest;
out vec3 v_normal;
out float v_open;
invariant gl_Position;

void main() {
  vec3 p = a_position;
  vec3 n = a_normal;
#ifdef DIMPLED
  vec3 from = p - dimple.xyz;
  float spread2 = dimple_normal.w * dimple_normal.w;
  float w = exp(-dot(from, from) / (2.0 * spread2));
  // Normal of the dented surface: transpose of the inverse of I - depth * n_d * grad(w)^T.
  n = normalize(n - dimple.w * w / spread2 * dot(n, dimple_normal.xyz) * from);
  p -= dimple.w * w * dimple_normal.xyz;
#endif
  v_position = p;
  v_rest = a_position;
  v_normal = n;
  v_open = a_light.x;
  gl_Position = view_projection * vec4(p, 1.0);
}
