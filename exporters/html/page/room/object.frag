// One program for each pattern and each way to shine (ProgramKey, Look): small programs start at once where there is no graphics card.
flat in vec3 share;
#if PATTERN == 0 || PATTERN == 5
in vec3 albedo;
#endif
#if PATTERN != 0
in vec3 at;
#endif
#if SHINE == 0
in vec3 arriving;
#else
in vec4 facing;
flat in mat3 eye_from_copy;
#endif
#if SHINE != 0 || defined(IN_ROOM)
in vec4 place;
#endif
#if K > 0
in vec2 reach;
#endif
#ifdef CODED
flat in uvec4 word_of_copy;
uniform highp usampler2D path_code;
#endif
uniform vec3 style_first, style_second;
uniform float style_cell, style_cutoff, style_emission, style_index;
uniform float eye_z;
uniform sampler2D picture;
uniform vec3 glow;            // added while the part is selected
layout(location = 0) out vec4 pixel;

vec3 surface_albedo() {
#if PATTERN == 5
  vec4 texel = texture(picture, at.xy);
  if (texel.a < style_cutoff) discard;
  return albedo * texel.rgb;
#elif PATTERN == 2
  return mix(style_first, style_second, marble(at / style_cell));
#elif PATTERN == 3
  return mix(style_first, style_second, wood(at / style_cell));
#elif PATTERN == 4
  return mix(style_first, style_second, granite(at / style_cell));
#else
  return albedo;
#endif
}

#if SHINE != 0
float product(vec4 a, vec4 b) { return a.y * b.y + a.z * b.z + float(K) * a.x * b.x + a.w * b.w; }

// The direction from the point to the eye, in room coordinates of the copy: (w, x, y, z), of length 1.
vec4 to_eye(vec4 p) {
  mat3 m = eye_from_copy;
#if K == 0
  vec2 eye = -vec2(dot(vec2(m[1].y, m[2].y), vec2(m[1].x, m[2].x)), dot(vec2(m[1].z, m[2].z), vec2(m[1].x, m[2].x)));
  vec3 d = vec3(0.0, eye - p.yz);
  float length_there = length(d.yz);
#else
  vec3 eye = vec3(m[0].x, float(K) * m[0].y, float(K) * m[0].z);
  float c = eye.x * p.x + float(K) * dot(eye.yz, p.yz);
  vec3 d = eye - c * p.xyz;
  float n = sqrt(max(1e-12, dot(d.yz, d.yz) + float(K) * d.x * d.x));
#if K > 0
  float length_there = atan(n, c);
#else
  float length_there = asinh(n);
#endif
  d *= length_there / n;
#endif
  vec4 v = vec4(d, eye_z - p.w);
  return v / max(1e-6, sqrt(length_there * length_there + v.w * v.w));
}

vec3 room_in(vec4 p, vec4 direction) {
  float flat_length = sqrt(max(1e-12, dot(direction.yz, direction.yz) + float(K) * direction.x * direction.x));
  uvec2 code;
  return march(p.xyz, direction.xyz / flat_length, p.w, direction.w / flat_length, min(bounces, REFLECTED), vec3(1.0), code);
}

// What a surface that reflects shows of the room: floor, ceiling and walls, without the things that stand there.
vec3 shine(vec3 color) {
  vec4 p = place;
#if K < 0
  p.xyz *= inversesqrt(max(1e-6, p.x * p.x - dot(p.yz, p.yz)));
#elif K > 0
  p.xyz = normalize(p.xyz);
#endif
  vec4 normal = facing;
#if K != 0
  normal.xyz -= (normal.x * p.x + float(K) * dot(normal.yz, p.yz)) * p.xyz;
#else
  normal.x = 0.0;
#endif
  normal /= sqrt(max(1e-9, product(normal, normal)));
  vec4 view_direction = to_eye(p);
  float cosine = clamp(product(normal, view_direction), 0.0, 1.0);
  vec4 reflected = 2.0 * cosine * normal - view_direction;
#if SHINE == 3
  // A ball of glass bends a ray towards its axis twice, each time by the angle of incidence less that of refraction.
  float fresnel = 0.04 + 0.96 * pow(1.0 - cosine, 5.0);
  float incidence = acos(cosine), refraction = asin(sin(incidence) / style_index), angle = 2.0 * refraction - incidence;
  vec4 across = (cosine * normal - view_direction) / max(1e-4, sin(incidence));
  vec4 through = sin(angle) * across - cos(angle) * normal;
  vec3 sum = vec3(0.0);
  for (int i = 0; i < 2; ++i) sum += (i == 0 ? vec3(fresnel) : (1.0 - fresnel) * color) * room_in(p, i == 0 ? reflected : through);
  return sum;
#elif SHINE == 2
  return color * room_in(p, reflected);
#else
  return (color + (1.0 - color) * pow(1.0 - cosine, 5.0)) * room_in(p, reflected);
#endif
}
#endif

void main() {
#ifdef CODED
  uvec2 code = texelFetch(path_code, ivec2(gl_FragCoord.xy), 0).xy;
  if ((code.x & word_of_copy.z) != word_of_copy.x || (code.y & word_of_copy.w) != word_of_copy.y) discard;
#endif
#ifdef IN_ROOM
  // What lies outside of the room is not seen: half of a frame lies behind its mirror.
  for (int i = 0; i < N; ++i)
    if (dot(wall_line[i], place.xyz) < -1e-5) discard;
#endif
#if SHINE == 0
  vec3 out_light = surface_albedo() * (style_emission > 0.0 ? vec3(style_emission) : lit == 1 ? arriving : vec3(1.0));
#else
  vec3 out_light = shine(surface_albedo());
#endif
  pixel = vec4(srgb(min(exposure * out_light, 1.0) * share + glow), 1.0);
}
