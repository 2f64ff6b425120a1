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
  vec4 dimple;         // xyz, T: centre; w: depth
  vec4 dimple_normal;  // xyz: outward; w: spread of the dent
};

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
  // Beyond the working distance the camera's gain and light thrown back by the walls soften the fall.
  float plain = lamp.w * c * c * c * c / (d2_mm + 60.0);
  return plain < 1.0 ? pow(plain, 0.72) : pow(plain, 0.80);
}
