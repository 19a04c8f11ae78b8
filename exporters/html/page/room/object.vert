layout(location = 0) in vec4 position;     // w, x, y, z
layout(location = 1) in vec4 normal;
layout(location = 2) in vec3 color;
layout(location = 3) in vec3 coordinate;   // of solid patterns; of textures u, v
layout(location = 4) in vec3 light;        // irradiance divided by π
layout(location = 5) in vec3 row_w;        // eye from copy, row by row
layout(location = 6) in vec3 row_x;
layout(location = 7) in vec3 row_y;
layout(location = 8) in vec4 weight;       // of the mirrors on the path; w: the sheet of the sphere, and 8 times the number of mirrors
#ifdef CODED
layout(location = 9) in uvec4 word;        // code, mask
flat out uvec4 word_of_copy;
#endif
uniform float eye_z;
uniform vec3 forward, right, up_vector;
uniform vec2 half_size;
uniform vec4 view;
uniform mat3 moved;        // where the part is while it is dragged: room from its old place
uniform float lifted;
flat out vec3 share;
#if PATTERN == 0 || PATTERN == 5
out vec3 albedo;
#endif
#if PATTERN != 0
out vec3 at;
#endif
#if SHINE == 0
out vec3 arriving;
#else
out vec4 facing;           // the normal in room coordinates
flat out mat3 eye_from_copy;
#endif
#if SHINE != 0 || defined(IN_ROOM)
out vec4 place;            // the point in room coordinates
#endif
#if K > 0
out vec2 reach;            // length on the floor, and that which the direction alone gives
#endif
void main() {
  vec3 p = moved * position.xyz;
  vec3 e = vec3(dot(row_w, p), dot(row_x, p), dot(row_y, p));
  float rho = length(e.yz);
  float r;
#if K > 0
  r = atan(rho, e.x);
  float sheet = mod(weight.w, 8.0);
  float far = mod(sheet, 2.0) < 0.5 ? sheet * 3.14159265 + r : -((sheet + 1.0) * 3.14159265 - r);
  reach = vec2(far < 0.0 ? -far : far, 0.0);
  r = far;
#elif K == 0
  r = rho;
#else
  r = asinh(rho);
#endif
  vec3 q = vec3((rho > 1e-6 ? r / rho : 1.0) * e.yz, position.w + lifted - eye_z);
  float depth = dot(q, forward);
  vec2 screen = vec2(dot(q, right), dot(q, up_vector)) / half_size;
  gl_Position = vec4(screen + view.zw * depth, (FAR + NEAR) / (FAR - NEAR) * depth - 2.0 * FAR * NEAR / (FAR - NEAR), depth);
  // A frame and its image meet in the mirror: the one behind fewer mirrors lies in front.
  gl_Position.z += 4e-6 * floor(weight.w / 8.0) * depth;
  share = weight.rgb;
#if PATTERN == 0 || PATTERN == 5
  albedo = color;
#endif
#if PATTERN != 0
  at = coordinate;
#endif
#if SHINE == 0
  arriving = light;
#else
  facing = vec4(moved * normal.xyz, normal.w);
  eye_from_copy = mat3(row_w, row_x, row_y);
#endif
#if SHINE != 0 || defined(IN_ROOM)
  place = vec4(p, position.w + lifted);
#endif
#ifdef CODED
  word_of_copy = word;
#endif
}
