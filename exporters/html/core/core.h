#pragma once
#include <stddef.h>
#include <stdint.h>

/// The compiler's core as the designer's page calls it: a C interface of plain numbers and bytes, compiled to WebAssembly from the same
/// rooms as the program. A core holds one scene at a time; every page has two cores, one in the page and one in its worker.
///
/// A reply is a JSON text and one block of bytes. Arrays are members of the JSON of the form {"type": "f32", "at": 1024, "count": 300}: so
/// many numbers of that type (f32, f64, u32, u8), little endian, from that byte of the block. Replies are owned by the core and are valid
/// until its next call. A failure of the machine (memory) is the reply {"failure": "…"}; mistakes of the author are "diagnostics".
///
/// Lengths are in curvature radii (E²: scene units), angles in radians, colors linear. Points of the floor are ambient vectors (w, x, y)
/// (geometry/point.h), heights follow as a fourth number. Matrices are 3×3, row by row, on ambient vectors.
#ifdef __cplusplus
extern "C" {
#endif

typedef struct {
  const char* json;
  size_t json_size;
  const uint8_t* block;
  size_t block_size;
} OrbcReply;

/// Gives the core a file that scenes, or other such files, may name: in the form of page_assets.h, or as it is on a disk. It replaces an
/// earlier one of that name.
void orbc_asset(const char* name, size_t name_size, const uint8_t* bytes, size_t size);

/// Reads a mesh file as it is on a disk (OBJ, PLY, STL, OFF, glTF, GLB; the ending of the name says which), and if it is fine gives it to
/// the core, as orbc_asset does. The files that it refers to are given before. {"diagnostics": […], "triangles": n}; "triangles" is missing
/// if there were errors.
const OrbcReply* orbc_take_mesh(const char* name, size_t name_size, const uint8_t* bytes, size_t size);

/// Reads a scene (UTF-8 YAML), realises its room and furnishes it. On errors the scene of the last call that had none stays open.
/// {"ok": true, "diagnostics": […], "nodes": […], "room": {…}, "shell": {…}, "styles": […], "textures": […], "meshes": {…}, "objects": […],
///  "lamps": […], "eye": {…}, "cover": {…}, "light": {…}}; describe.h says what these hold. With errors: "ok" is false, and only
/// "diagnostics" and "nodes" (if the text is YAML) follow.
const OrbcReply* orbc_open(const char* text, size_t size);

/// What is known of a notation alone: {"diagnostics": […], "notation": "*22222", "chi": "-1/4", "chi_value": −0.25, "space": "hyperbolic",
/// "orders": ["2", …]}. `real` ≠ 0 allows corners that are no integers.
const OrbcReply* orbc_notation(const char* text, size_t size, int real);

/// The copies of the open room within `bounces` reflections in its mirrors, at most `most`, by their normal forms: {"matrices": 9 f64 a
/// copy (cover from room), "words": u8, "lengths": u8 a copy, "whole": whether no copy was left out}. Words count walls from 0.
const OrbcReply* orbc_copies(int bounces, int most);

/// Computes the light of the open scene at the next points of its light job, up to `count` of them: vertices of the meshes, then points of
/// floor, ceiling and walls. Call it until "done" equals "all". {"done": n, "all": m, "first": index of the first point, "irradiance": 3
/// f32 a point}. The irradiance is divided by π, and ambient light is part of it.
const OrbcReply* orbc_light(int count);

/// Where the tracer stands: `room_from_eye` (9 numbers), height, then forward, right and up (3 numbers each), 19 numbers in all; horizontal
/// field of view in radians; size in pixels; the principal point's distance from the middle of the picture, in pixels to the right and
/// down.
void orbc_trace_begin(const double* eye, double fov, int width, int height, const double* shift);
/// Traces one sample for each pixel of the tile (x, y, width, height): sample `index` of `samples`, and adds it to the film. {"pixels": 4
/// u8 a pixel, sRGB of the mean of all samples so far}.
const OrbcReply* orbc_trace_tile(const int* tile, int index, int samples);


/// Compiles a scene as the program does, from reading it anew, for the format "glb", "pov" or "svg". `eye`: where to see it from instead
/// of its camera, 19 numbers as for orbc_trace_begin; null: as the scene has it. {"diagnostics": […], "files": [{"name": "" for the main
/// one, "bytes": u8}, …], "copies", "triangles", "error_px"}. Without files there were errors. It takes as long as the program with one
/// thread, and tells the function `told` of the module from time to time how far it is.
const OrbcReply* orbc_export(const char* text, size_t size, const char* format, const double* eye);

#ifdef __cplusplus
}
#endif
