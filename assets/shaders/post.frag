// The camera and video processor: barrel distortion, smoke in the way, mild sharpening, glow, what lies on the lens, tone curve,
// vignette, round field with the scope's notch and a level tick, sensor grain from an integer hash, equal on every machine. The small
// presets do it in two steps, because the camera's eight looks at the scene cost most of a small picture: SMALL all but rim and grain
// at the scene's own size, then UPSCALE to the picture's.
in vec2 v_uv;
out vec4 colour;
uniform sampler2D u_scene;
uniform sampler2D u_glow;
uniform sampler2D u_depth;
uniform sampler2D u_veil;
uniform sampler3D u_noise;
uniform vec2 u_size;     // px
uniform vec3 u_circle;   // centre x, y (from the lower left), radius, px
uniform vec2 u_texel;    // 1 / size of the scene
uniform float u_barrel;
uniform float u_frame;
uniform vec2 u_marks;    // notch, level: rad clockwise from 12 o'clock
uniform vec4 u_right;    // half width of the picture at unit distance, T; w: extinction of smoke, 1/m
uniform vec4 u_up;       // half height
uniform vec3 u_lens;     // fog, blood, share wiped

vec3 tone(vec3 x) { return clamp(x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14), 0.0, 1.0); }

float luma(vec3 c) { return dot(tone(c), vec3(0.299, 0.587, 0.114)); }

// Place relative to a mark on the rim: x across, y outwards from the rim as far as the frame shows it; in radii of the field.
vec2 from_rim(vec2 d, float angle) {
  vec2 out_there = vec2(sin(angle), cos(angle));
  vec2 half_frame = vec2(u_circle.x, u_size.y - u_circle.y) / u_circle.z;
  vec2 reach = half_frame / max(abs(out_there), vec2(1e-4));
  return vec2(d.x * out_there.y - d.y * out_there.x, dot(d, out_there) - min(1.0, min(reach.x, reach.y)));
}

#ifdef WITH_SMOKE
vec3 smoked(vec3 c, vec2 uv) {
  float z_ndc = texture(u_depth, uv).r * 2.0 - 1.0;
  float z = 2.0 * 1.5 * 0.003 / (1.503 - z_ndc * 1.497);
  vec3 ray = axis.xyz + (uv.x * 2.0 - 1.0) * u_right.xyz + (uv.y * 2.0 - 1.0) * u_up.xyz;
  float path = z * length(ray);
  float reach = min(path, 0.30);
  vec3 drift = vec3(0.011, 0.017, 0.023) * axis.w;
  float n = 0.0;
  for (int i = 0; i < 3; ++i) {
    vec3 at = eye.xyz + ray * (reach / max(length(ray), 1e-4)) * (0.22 + 0.33 * float(i));
    n += textureLod(u_noise, at * vec3(5.0, 5.0, 7.0) + drift, 2.0).w;
  }
  n = smoothstep(0.25, 0.75, n / 3.0);
  float left = exp(-u_right.w * path * (0.35 + 1.3 * n));
  return c * left + (1.0 - left) * vec3(0.40, 0.395, 0.40) * (0.70 + 0.45 * n);
}
#endif

#if defined(WITH_FOG) || defined(WITH_LENS_BLOOD)
// Share of what lies on the lens that is still there: a wipe clears it from the left and leaves faint streaks.
float unwiped(vec2 d) {
  float front = mix(-1.25, 1.25, u_lens.z) + 0.10 * sin(3.0 * d.y + 1.0);
  float streak = 0.10 * textureLod(u_noise, vec3(d.x * 0.10, d.y * 2.6, 0.4), 1.0).w * (1.0 - u_lens.z);
  return mix(streak, 1.0, smoothstep(-0.04, 0.06, d.x - front)) * (1.0 - smoothstep(0.98, 1.0, u_lens.z));
}

const vec3 kDrops[7] = vec3[7](vec3(0.52, 0.50, 0.20), vec3(0.30, 0.66, 0.09), vec3(0.74, 0.16, 0.12), vec3(-0.55, 0.34, 0.15),
                               vec3(0.15, -0.62, 0.11), vec3(-0.30, -0.25, 0.24), vec3(0.62, -0.42, 0.17));

vec3 through_lens(vec3 c, vec2 uv, vec2 d, float r) {
  float there = unwiped(d);
  vec3 soft = texture(u_veil, uv).rgb;
#ifdef WITH_FOG
  // Breath on glass: thickest away from the warm middle, with droplets that gather the light.
  float cloud = textureLod(u_noise, vec3(d * 0.55, 0.31), 2.0).w;
  float drops = textureLod(u_noise, vec3(d * 3.1, 0.77), 1.0).w;
  float thick = there * u_lens.x * (0.55 + 0.45 * smoothstep(0.0, 1.0, r) + 0.9 * (cloud - 0.5));
  thick = clamp(thick * 1.25, 0.0, 0.97);
  float bead = smoothstep(0.66, 0.74, drops) * thick;
  c = mix(c, soft * 0.80 + vec3(0.155, 0.160, 0.165), thick);
  c = mix(c, 1.5 * soft + vec3(0.03), 0.45 * bead);
#endif
#ifdef WITH_LENS_BLOOD
  // Drops of fixed places that grow; their rims are uneven.
  float uneven = 0.030 * (textureLod(u_noise, vec3(d * 1.9, 0.2), 0.0).w - 0.5) + 0.10 * (textureLod(u_noise, vec3(d * 0.6, 0.6), 1.0).w - 0.5);
  float cover = 0.0;
  for (int i = 0; i < 7; ++i) {
    float size = kDrops[i].z * (0.25 + 0.95 * u_lens.y);
    cover = max(cover, smoothstep(0.0, 0.045, size - length((d - kDrops[i].xy) * vec2(1.0, 0.86)) + uneven));
  }
  cover *= there * smoothstep(0.0, 0.05, u_lens.y);
  float film = there * 0.30 * u_lens.y;
  c = mix(c, soft * vec3(0.52, 0.035, 0.03) + vec3(0.030, 0.001, 0.001), max(cover * 0.93, film));
#endif
  return c;
}
#endif

vec3 camera(vec2 d, float r) {
  float stretch = (1.0 + u_barrel * r * r) / (1.0 + u_barrel);
  vec2 uv = (u_circle.xy + d * stretch * u_circle.z) / u_size;
  vec3 c = texture(u_scene, uv).rgb;
#ifndef PRESET_LOW
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
  c = max(mix(c + 0.45 * (c - mean), soft, edge), vec3(0.0));
#endif
#ifdef WITH_GLOW
  c += 0.42 * texture(u_glow, uv).rgb;
#endif
#ifdef WITH_SMOKE
  c = smoked(c, uv);
#endif
#if defined(WITH_FOG) || defined(WITH_LENS_BLOOD)
  c = through_lens(c, uv, d, r);
#endif
#ifndef PRESET_LOW
  c *= 1.0 - 0.44 * smoothstep(0.40, 1.0, r);
#endif
  return pow(tone(1.05 * c), vec3(1.0 / 2.2));
}

void main() {
  vec2 px = v_uv * u_size;
  vec2 d = (px - u_circle.xy) / u_circle.z;
  float r = length(d);
  float inside = 1.0 - smoothstep(1.0 - 3.0 / u_circle.z, 1.0, r);
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
  vec3 c = camera(d, r);
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
#ifdef WITH_LEVEL
  vec2 level = from_rim(d, u_marks.y);
  float tick = step(abs(level.x), 0.0048) * step(-0.052, level.y) * step(level.y, -0.008);
  c = mix(c, vec3(0.75, 0.80, 0.84), 0.85 * tick);
#endif
  vec2 notch = from_rim(d, u_marks.x) + vec2(0.0, 0.040);
  float tooth = step(0.0, notch.y) * step(abs(notch.x) / 0.022, notch.y / 0.040);
  colour = vec4(c * inside * (1.0 - tooth), 1.0);
}
