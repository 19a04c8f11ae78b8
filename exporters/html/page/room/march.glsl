// Follows a ray of the floor through the real mirrors of the room until it meets floor, ceiling or a plain wall, and shades what it meets.
// Nothing is unfolded, so it is right at any depth; only objects and frames are drawn as copies.
uniform vec3 wall_start[N];      // where the arc length is 0
uniform vec3 wall_along[N];      // the direction there
uniform vec4 mirror_area[M];     // arc from, to, height from, to; M = N times mirrors a wall
uniform vec3 mirror_share[M];    // the light that it reflects; x < 0: there is no mirror
uniform vec4 surface_color[S];   // walls, then floor, then ceiling: first color, and the pattern's number in w
uniform vec4 surface_second[S];  // second color, and the cell's size in w
uniform vec4 horizontal_mirror[2];  // floor, ceiling: what they reflect; w = 1 if they are mirrors
uniform float height;
uniform vec3 background;         // where mirrors are followed no further; before exposure
uniform int bounces;
uniform float min_weight;
uniform sampler2D floor_light;
uniform sampler2D ceiling_light;
uniform sampler2D wall_light;
uniform float light_reach;
uniform float wall_length[N];
#ifdef TEXTURED
uniform sampler2D shell_texture;
#endif

float brightest(vec3 c) { return max(c.r, max(c.g, c.b)); }

vec3 pattern_color(int s, vec2 at, vec3 in_space) {
  vec4 first = surface_color[s], second = surface_second[s];
  int pattern = int(first.w);
  if (pattern == 0) return first.rgb;
  if (pattern == 1) {
    vec2 cell = floor(at / second.w);
    return mod(cell.x + cell.y, 2.0) > 0.5 ? second.rgb : first.rgb;
  }
#ifdef TEXTURED
  if (pattern == 5) return first.rgb * pow(texture(shell_texture, vec2(in_space.x, -in_space.y) / second.w).rgb, vec3(2.2));
#endif
#ifdef SOLID
  vec3 there = in_space / second.w;
  return mix(first.rgb, second.rgb, pattern == 2 ? marble(there) : pattern == 3 ? wood(there) : granite(there));
#else
  return first.rgb;
#endif
}

vec3 horizontal_color(vec3 p, bool ceiling) {
  vec2 axial;
#if K > 0
  axial = atan(p.yz, vec2(p.x));
  if (p.x < 0.0) axial = atan(p.yz / p.x);
#elif K < 0
  axial = atanh(clamp(p.yz / p.x, -0.9999999, 0.9999999));
#else
  axial = p.yz;
#endif
  vec2 disk = p.yz / (1.0 + p.x);
#if K == 0
  disk = p.yz;
#endif
  vec3 color = pattern_color(ceiling ? N + 1 : N, axial, vec3(K == 0 ? disk : 2.0 * disk, ceiling ? height : 0.0));
  if (lit == 0) return color;
  vec2 uv = (disk / light_reach * 0.5 + 0.5) * (95.0 / 96.0) + 0.5 / 96.0;
  return color * (ceiling ? texture(ceiling_light, uv).rgb : texture(floor_light, uv).rgb);
}

// In: a unit vector v at p; the height, the height gained for each length on the floor. Makes: the light before exposure; the walls that
// turned the ray back, four bits each, the first lowest.
vec3 march(vec3 p, vec3 v, float z, float slope, int most, vec3 weight, out uvec2 code) {
  code = uvec2(0u);
  int letters = 0;
  float up = slope;
  for (int step = 0; step < 64; ++step) {
    float rest = up > 0.0 ? (height - z) / max(up, 1e-9) : z / max(-up, 1e-9);
    float best = NONE, a, t;
    int hit = -1;
    vec3 line = vec3(0.0);
    WALLS
    float s;
#if K > 0
    s = hit < 0 ? 1e9 : atan(1.0, best);
#elif K == 0
    s = hit < 0 ? 1e9 : 1.0 / best;
#else
    s = hit < 0 ? 1e9 : 0.5 * log((best + 1.0) / (best - 1.0));
#endif
    bool flat_hit = s >= rest;
    if (flat_hit) s = rest;
    float c, n;
#if K > 0
    c = cos(s); n = sin(s);
#elif K == 0
    c = 1.0; n = s;
#else
    if (flat_hit) { c = cosh(s); n = sinh(s); }
    else { n = inversesqrt(best * best - 1.0); c = best * n; }
#endif
    vec3 q = c * p + n * v;
#if K == 0
    p = q;
#else
    v = c * v - float(K) * n * p;
    p = q;
#endif
    z += up * s;
    if (flat_hit) {
      bool ceiling = up > 0.0;
      vec4 mirror = horizontal_mirror[ceiling ? 1 : 0];
      if (mirror.w == 0.0) return weight * horizontal_color(p, ceiling);
      if (most-- <= 0 || brightest(weight * mirror.rgb) < min_weight) return weight * background;
      weight *= mirror.rgb;
      up = -up;
      continue;
    }
    if (hit < 0) return weight * background;
    vec3 share = vec3(-1.0);
    float arc = 0.0;
#ifdef PARTIAL
    vec3 start = wall_start[hit], along = wall_along[hit];
#if K > 0
    arc = atan(dot(p, along), dot(p, start));
    if (arc < -1e-3) arc += 6.283185307;
#elif K == 0
    arc = dot(p.yz - start.yz, along.yz);
#else
    arc = asinh(dot(p.yz, along.yz) - p.x * along.x);
#endif
    for (int m = MIRRORS - 1; m >= 0; --m) {
      vec4 area = mirror_area[hit * MIRRORS + m];
      vec3 own = mirror_share[hit * MIRRORS + m];
      if (own.x >= 0.0 && arc >= area.x && arc <= area.y && z >= area.z && z <= area.w) share = own;
    }
    if (share.x < 0.0) {
      vec3 color = pattern_color(hit, vec2(arc, z), vec3((K == 0 ? 1.0 : 2.0) * p.yz / (K == 0 ? 1.0 : 1.0 + p.x), z));
      if (lit == 0) return weight * color;
      return weight * color * texture(wall_light, vec2(arc / wall_length[hit], (float(hit) + clamp(z / height, 0.04, 0.96)) / float(N))).rgb;
    }
#else
    share = mirror_share[hit];
#endif
    if (most-- <= 0 || brightest(weight * share) < min_weight) return weight * background;
    weight *= share;
#ifdef CODED
    if (letters < 8) code.x |= uint(hit + 1) << uint(4 * letters);
    else code.y |= uint(hit + 1) << uint(4 * letters - 32);
    ++letters;
#endif
#if K == 0
    vec3 normal = vec3(0.0, line.yz);
#else
    vec3 normal = vec3(float(K) * line.x, line.yz);
#endif
    p -= dot(line, p) * normal;
    v -= 2.0 * dot(line, v) * normal;
#if K < 0
    p.x = sqrt(1.0 + dot(p.yz, p.yz));
    v.x = dot(v.yz, p.yz) / p.x;
    v *= inversesqrt(dot(v.yz, v.yz) - v.x * v.x);
#elif K > 0
    p = normalize(p);
    v = normalize(v - dot(v, p) * p);
#endif
  }
  return weight * background;
}
