// Shared by all programs of the room. K is the curvature of the floor: 1, 0 or -1. Points of the floor are (w, x, y).
precision highp float;
precision highp int;

// The nearest points of the sRGB curve.
vec3 srgb(vec3 c) {
  c = clamp(c, 0.0, 1.0);
  return mix(12.92 * c, 1.055 * pow(max(c, 1e-7), vec3(1.0 / 2.4)) - 0.055, step(0.0031308, c));
}

uniform vec3 wall_line[N];       // covectors, positive inside
uniform float exposure;
uniform int lit;                 // 1: what is drawn has light; 0: its colors alone are shown
