// The scene made small, 4x4 texels a pixel. BRIGHT_PARTS: only what is brighter than the sensor holds, for the glow round glints.
in vec2 v_uv;
out vec4 colour;
uniform sampler2D u_scene;
uniform vec2 u_texel;
void main() {
  vec3 sum = vec3(0.0);
  for (int y = -1; y <= 1; y += 2)
    for (int x = -1; x <= 1; x += 2) {
      vec3 c = texture(u_scene, v_uv + vec2(x, y) * 2.0 * u_texel).rgb;
#ifdef BRIGHT_PARTS
      c = max(c - vec3(0.9), vec3(0.0));
#endif
      sum += min(c, vec3(4.0));
    }
  colour = vec4(0.25 * sum, 1.0);
}
