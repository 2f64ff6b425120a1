// Shared by every shader: what the scene is lit by, and small lighting functions. Metres in the block; millimetres
// where a variable ends in _mm.
layout(std140) uniform Scene {
  mat4 view_projection;
  mat4 lamp_projection;
  vec4 eye;            // xyz, T
  vec4 lamp;           // xyz, T; w: gain in mm^2 (stands for the camera's automatic gain)
  vec4 axis;           // xyz: viewing direction; w: time in s
  vec4 tip;            // xyz, T: instrument tip; w: shaft radius
  vec4 shaft;          // xyz: from the tip back along the shaft; w: its length
  vec4 dimple;         // xyz, T: underside of the tip that presses; w: depth
  vec4 dimple_normal;  // xyz: out of the tissue; w: spread of the dent
};

#ifdef DIMPLED
// How far the instrument's underside presses a place aside.
struct Dent {
  float deep;   // m, against the contact's normal
  vec3 slope;   // of `deep` along T
  float reach;  // squared distance from the underside, in spreads
};

// By the point of it that is `s` from the tip. Round the underside the dent fades like a Gaussian.
Dent dent_from(vec3 from, float s, vec3 rise) {
  vec3 off = from - s * shaft.xyz;
  float height = dot(off, dimple_normal.xyz);
  vec3 aside = off - height * dimple_normal.xyz;
  float spread2 = dimple_normal.w * dimple_normal.w;
  float above = clamp(height, 0.0, dimple.w), over = min(height, 0.0);
  float share = exp(-0.5 * dot(aside, aside) / spread2);
  share *= 1.0 - smoothstep(1.5 * dimple.w + 0.003, 2.0 * dimple.w + 0.006, height);  // another fold, over the tool
  vec3 slope = height > 0.0 && height < dimple.w ? rise : vec3(0.0);
  return Dent(share * above, share * (slope - above / spread2 * aside),
              (dot(aside, aside) + over * over) / spread2);
}

// The deeper of what the tip and what the shaft does.
Dent dent(vec3 place) {
  vec3 from = place - dimple.xyz, along = shaft.xyz - dot(shaft.xyz, dimple_normal.xyz) * dimple_normal.xyz;
  Dent result = dent_from(from, 0.0, dimple_normal.xyz);
  float flat2 = dot(along, along);
  if (flat2 > 0.01) {
    float s = clamp(dot(from, along) / flat2, 0.0, shaft.w);
    Dent beside = dent_from(from, s, dimple_normal.xyz - dot(shaft.xyz, dimple_normal.xyz) / flat2 * along);
    if (beside.deep > result.deep) result.deep = beside.deep, result.slope = beside.slope;
    result.reach = min(result.reach, beside.reach);
  }
  return result;
}
#endif

float ggx(float n_h, float alpha) {
  float a2 = alpha * alpha;
  float d = n_h * n_h * (a2 - 1.0) + 1.0;
  return a2 / (3.14159265 * d * d);
}

float schlick(float f0, float v_h) {
  float m = 1.0 - v_h;
  float m2 = m * m;
  return f0 + (1.0 - f0) * m2 * m2 * m;
}

// Light of the fibre bundle at a point: falls off with the square of distance and off the scope's axis.
float lamp_power(vec3 to_lamp) {
  float d2_mm = dot(to_lamp, to_lamp) * 1e6;
  float c = max(dot(-normalize(to_lamp), axis.xyz), 0.0);
  float c2 = c * c;
  // Beyond the working distance the camera's gain and light thrown back by the walls soften the fall.
  float plain = lamp.w * c2 * c2 / (d2_mm + 60.0);
  return plain < 1.0 ? pow(plain, 0.62) : pow(plain, 0.80);
}

// What the air adds and takes over a distance: the far wall is paler and flatter than the organ before the lens.
vec3 hazed(vec3 light, vec3 at) {
  float thick = 1.0 - exp(-1.4 * max(length(at - eye.xyz) - 0.06, 0.0));
  return mix(light, vec3(0.070, 0.036, 0.029), thick);
}

// Share of the lamp's light that reaches a point; the floor is light scattered inside the tissue and thrown back by the walls.
float lamp_shadow(sampler2DShadow map, vec3 at) {
  vec4 s = lamp_projection * vec4(at, 1.0);
  vec3 uvz = s.xyz / s.w * 0.5 + 0.5;
  uvz.z -= 0.0012;
#if defined(PRESET_LOW)
  float sum = texture(map, uvz);
#elif defined(PRESET_SOFT)
  float sum = 0.5 * (texture(map, uvz + vec3(-0.0010, -0.0004, 0.0)) + texture(map, uvz + vec3(0.0010, 0.0004, 0.0)));
#else
  float sum = texture(map, uvz + vec3(-0.0011, -0.0004, 0.0)) + texture(map, uvz + vec3(0.0004, -0.0011, 0.0));
  sum += texture(map, uvz + vec3(0.0011, 0.0004, 0.0)) + texture(map, uvz + vec3(-0.0004, 0.0011, 0.0));
  sum *= 0.25;
#endif
  return 0.30 + 0.70 * sum;
}

// Darkening near the instrument: the nearer the shaft to a surface, the darker the surface under it.
float contact_shade(vec3 at) {
  float along = clamp(dot(at - tip.xyz, shaft.xyz), 0.0, shaft.w);
  float gap_mm = 1000.0 * max(length(at - tip.xyz - along * shaft.xyz) - tip.w, 0.0);
  return 1.0 - 0.55 * exp(-gap_mm * gap_mm / 18.0);
}
