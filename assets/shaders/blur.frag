// Separable binomial blur.
in vec2 v_uv;
out vec4 colour;
uniform sampler2D u_scene;
uniform vec2 u_step;
void main() {
  vec3 sum = 0.2270 * texture(u_scene, v_uv).rgb;
  sum += 0.3162 * (texture(u_scene, v_uv + 1.3846 * u_step).rgb + texture(u_scene, v_uv - 1.3846 * u_step).rgb);
  sum += 0.0703 * (texture(u_scene, v_uv + 3.2308 * u_step).rgb + texture(u_scene, v_uv - 3.2308 * u_step).rgb);
  colour = vec4(sum, 1.0);
}
