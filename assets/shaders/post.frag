// The camera and video processor: barrel distortion, mild sharpening, glow, tone curve, vignette, round field with a
// notch at 12 o'clock, and (WITH_GRAIN) sensor grain from an integer hash, equal on every machine. The soft preset does
// it in two steps, because the camera's eight looks at the scene cost most of a small picture: SMALL all but rim and
// grain at the scene's own size, then UPSCALE to the picture's.
in vec2 v_uv;
out vec4 colour;
uniform sampler2D u_scene;
uniform sampler2D u_glow;
uniform vec2 u_size;     // px
uniform vec3 u_circle;   // centre x, y (from the lower left), radius, px
uniform vec2 u_texel;    // 1 / size of u_scene
uniform float u_barrel;
uniform float u_frame;

vec3 tone(vec3 x) { return clamp(x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14), 0.0, 1.0); }

float luma(vec3 c) { return dot(tone(c), vec3(0.299, 0.587, 0.114)); }

void main() {
  vec2 px = v_uv * u_size;
  vec2 d = (px - u_circle.xy) / u_circle.z;
  float r = length(d);
  float inside = 1.0 - smoothstep(1.0 - 3.0 / u_circle.z, 1.0, r);
  float top = min(1.0, (u_size.y - u_circle.y) / u_circle.z);  // of the field as far as the frame shows it
  vec2 notch = vec2(abs(d.x) / 0.022, (d.y - top + 0.040) / 0.040);
#ifdef SMALL
  const float rim = 1.02;  // the larger picture's rim looks half a pixel further
#else
  const float rim = 1.0;
#endif
  if (r >= rim) {
    colour = vec4(0.0, 0.0, 0.0, 1.0);
    return;
  }
#ifdef UPSCALE
  vec3 c = texture(u_scene, v_uv).rgb;
#else
  float stretch = (1.0 + u_barrel * r * r) / (1.0 + u_barrel);
  vec2 uv = (u_circle.xy + d * stretch * u_circle.z) / u_size;
  vec3 c = texture(u_scene, uv).rgb;
  vec3 e = texture(u_scene, uv + vec2(u_texel.x, 0.0)).rgb;
  vec3 w = texture(u_scene, uv - vec2(u_texel.x, 0.0)).rgb;
  vec3 n = texture(u_scene, uv + vec2(0.0, u_texel.y)).rgb;
  vec3 s = texture(u_scene, uv - vec2(0.0, u_texel.y)).rgb;
  vec3 mean = 0.25 * (e + w + n + s);
  // Strong steps are edges of instruments: blend along them. Weak ones are texture: sharpen.
  vec2 slope = vec2(luma(e) - luma(w), luma(n) - luma(s));
  float edge = smoothstep(0.14, 0.30, length(slope));
  vec2 along = vec2(-slope.y, slope.x) / max(length(slope), 1e-4) * u_texel;
  vec3 soft = 0.34 * c + 0.33 * (texture(u_scene, uv + along).rgb + texture(u_scene, uv - along).rgb);
  c = max(mix(c + 0.40 * (c - mean), soft, edge), vec3(0.0));
  c += 0.35 * texture(u_glow, uv).rgb;
  c *= 1.0 - 0.42 * smoothstep(0.35, 1.0, r);
  c = pow(tone(1.05 * c), vec3(1.0 / 2.2));
#endif
#ifdef SMALL
  colour = vec4(c, 1.0);
  return;
#endif
#ifdef WITH_GRAIN
  uint h = (uint(px.x) * 0x9E3779B1u) ^ (uint(px.y) * 0x85EBCA77u) ^ (uint(u_frame) * 0xC2B2AE3Du);
  h ^= h >> 16; h *= 0x85EBCA6Bu; h ^= h >> 13; h *= 0xC2B2AE35u; h ^= h >> 16;
  c += (float(h & 1023u) / 1023.0 - 0.5) * 0.022;
#endif
  float tooth = step(notch.x, notch.y) * step(0.0, notch.y);
  colour = vec4(c * inside * (1.0 - tooth), 1.0);
}
