uniform mat3 eye_frame;     // columns: the eye's point of the floor, and its x and y directions
uniform float eye_z;
uniform vec3 forward, right, up_vector;
uniform vec2 half_size;     // tangents of half the field of view
uniform vec4 view;          // 2/width, 2/height, principal point in units of half the picture
layout(location = 0) out vec4 pixel;
#ifdef CODED
layout(location = 1) out uvec2 path;
#endif
void main() {
  vec2 at = gl_FragCoord.xy * view.xy - 1.0 - view.zw;
  vec3 d = forward + at.x * half_size.x * right + at.y * half_size.y * up_vector;
  float flat_length = max(length(d.xy), 1e-6);
  vec2 heading = d.xy / flat_length;
  uvec2 code;
  vec3 light = march(eye_frame[0], heading.x * eye_frame[1] + heading.y * eye_frame[2], eye_z, d.z / flat_length, bounces, vec3(1.0), code);
  pixel = vec4(srgb(exposure * light), 1.0);
#ifdef CODED
  path = code;
#endif
}
