// Patterns in space. Their noise is that of surface/noise.h.
float lattice(ivec3 p) {
  uint h = uint(p.x) * 0x8da6b343u ^ uint(p.y) * 0xd8163841u ^ uint(p.z) * 0xcb1ab31fu;
  h ^= h >> 16; h *= 0x85ebca6bu; h ^= h >> 13; h *= 0xc2b2ae35u; h ^= h >> 16;
  return float(h) * (1.0 / 4294967296.0);
}
float noise(vec3 p) {
  vec3 f = floor(p), t = p - f;
  t = t * t * t * (t * (6.0 * t - 15.0) + 10.0);
  ivec3 i = ivec3(f);
  vec4 low = vec4(lattice(i), lattice(i + ivec3(1, 0, 0)), lattice(i + ivec3(0, 1, 0)), lattice(i + ivec3(1, 1, 0)));
  i.z += 1;
  vec4 high = vec4(lattice(i), lattice(i + ivec3(1, 0, 0)), lattice(i + ivec3(0, 1, 0)), lattice(i + ivec3(1, 1, 0)));
  vec4 m = mix(low, high, t.z);
  vec2 n = mix(m.xz, m.yw, t.x);
  return 2.0 * mix(n.x, n.y, t.y) - 1.0;
}
float turbulence(vec3 p) {
  float sum = 0.0, amplitude = 1.0;
  for (int i = 0; i < 5; ++i) {
    sum += amplitude * noise(p);
    amplitude *= 0.5;
    p = 2.03 * p + vec3(17.1, 5.7, 31.3);
  }
  return sum;
}
// The shares of the second color of solid patterns; the formulas are those of surface/albedo.cpp.
float marble(vec3 p) {
  float sheet = p.x + 0.6 * p.y + 0.8 * p.z + 1.3 * turbulence(1.1 * p);
  float vein = 1.0 - abs(sin(3.14159265358979 * sheet));
  return clamp(0.75 * smoothstep(0.72, 1.0, vein) + 0.25 * smoothstep(0.1, 0.9, vein) * smoothstep(-0.4, 0.8, noise(2.3 * p)), 0.0, 1.0);
}
float wood(vec3 p) {
  vec2 bent = p.xy + 0.18 * vec2(noise(1.3 * p), noise(1.3 * p + vec3(7.7, 3.1, 9.2)));
  float ring = 4.0 * length(vec2(bent.x + 0.9, bent.y + 0.4 + 0.08 * p.z)), within = ring - floor(ring);
  return clamp(smoothstep(0.15, 0.85, within) * (1.0 - smoothstep(0.9, 1.0, within)) + 0.12 * noise(vec3(28.0, 28.0, 2.0) * p), 0.0, 1.0);
}
float granite(vec3 p) {
  float grains = noise(6.0 * p) + 0.7 * noise(13.0 * p + vec3(3.3, 8.1, 1.7)) + 0.45 * noise(29.0 * p + vec3(9.4, 2.6, 5.5));
  return smoothstep(-0.35, 0.75, grains);
}
