#pragma once
#include <array>
#include <complex>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "compiler/base/angle.h"
#include "compiler/base/source_span.h"
#include "compiler/notation/orbifold.h"
#include "compiler/scene/color.h"

namespace orbc::scene {

/// A value and the span of the file where the author wrote it; defaults have no source.
template <class T>
struct Located {
  T value{};
  SourceSpan span;
};

// ---- the room -------------------------------------------------------------------------------------------------------------

/// A cut of the polygon along the common perpendicular of two walls.
struct Cut {
  std::array<int, 2> walls{};       ///< numbered from 1
  double length = 1.4;              ///< of the perpendicular, in curvature radii
};

enum class ShapeKind { tangential, paper, lengths };

/// The length of a wall is `factor` times that of wall `of`. Walls count from 1.
struct LengthRelation {
  int wall = 0;
  double factor = 1;
  int of = 0;
};

/// How the free side lengths of the polygon are chosen (design §4).
struct Shape {
  ShapeKind kind = ShapeKind::tangential;
  double cut = 1.4;                 ///< `paper`: length of every cut that `cuts` does not name
  std::vector<Cut> cuts;            ///< `paper`: the cuts of a decomposition; empty: the decomposition of the paper's forward reading
  std::map<int, double> lengths;    ///< `lengths`: wall number (from 1) → side length; with `relations` N−3 of them for N walls
  std::vector<LengthRelation> relations;  ///< `lengths`: at most one for each wall, and none for walls in `lengths`; by wall
  double scale = 1;                 ///< E² only: inradius; of `**` half the distance of the mirrors
  double aspect = 1;                ///< `*2222` only: side 1 / side 2
  double strip_length = 4;          ///< strips only: distance of the plain end walls, in units of `scale`
  SourceSpan span;
};

// ---- what surfaces are made of ----------------------------------------------------------------------------------------------

enum class MaterialKind { matte, glossy, metal, mirror, glass, emissive };
enum class Pattern { plain, checker, marble, wood, granite, texture };

/// A material. Colours are linear reflectances.
struct Material {
  MaterialKind kind = MaterialKind::matte;
  Pattern pattern = Pattern::plain;
  Color color{0.8, 0.8, 0.8};
  Color second{0.2, 0.2, 0.2};      ///< second colour of a pattern
  double cell = 0.25;               ///< size of a pattern's cell, intrinsic length
  double roughness = 0.3;           ///< glossy and metal, 0…1
  double index = 1.5;               ///< refractive index of glass
  double emission = 1;              ///< emissive: radiance = emission × color
  Located<std::string> texture;     ///< path as written, relative to the scene file; empty: none
  Located<std::string> opacity_mask;  ///< path of an image; there is no surface where its alpha (or brightness) is too low; empty: none
  double alpha_cutoff = 0.5;        ///< smallest opacity, 0…1, at which there is a surface
  SourceSpan span;
};

/// A frame around a mirror: a geodesic bar of square section, half of it over the mirror and half over the wall.
struct Frame {
  double width = 0.03;              ///< of the section
  Material material;
};

/// A mirror: a rectangle on its wall.
struct Mirror {
  std::optional<std::array<double, 2>> arc;     ///< arc lengths along the wall from its first corner; missing: all of the wall (key `span`)
  std::optional<std::array<double, 2>> height;  ///< heights above the floor; missing: all of the wall
  double reflectance = 0.9;         ///< 1 − attenuation, 0…1
  Color tint{1, 1, 1};              ///< multiplies the reflectance
  Color emission{0, 0, 0};          ///< radiance added to the reflected light; drawn by the tracer alone (key `glow`)
  std::optional<Frame> frame;
  SourceSpan span;
};

/// A wall. `material` is visible where no mirror covers it.
struct Wall {
  Material material;
  std::vector<Mirror> mirrors;
  SourceSpan span;
};

/// Floor or ceiling: a material, or a mirror.
struct Surface {
  Material material;
  std::optional<Mirror> mirror;
  SourceSpan span;
};

struct RoomSpec {
  Shape shape;
  double height = 1;
  Surface floor, ceiling;
  std::vector<Wall> walls;          ///< one per wall, in order; the reader has merged `all` with the walls' own entries
  SourceSpan span;
};

// ---- places ------------------------------------------------------------------------------------------------------------------

/// A place on the floor, in room coordinates: the centre is the origin, and corner 1 lies towards +x.
struct AtCentre {};
struct AtDisk { std::complex<double> z; };                       ///< coordinates of the disk chart
struct AtPolar { double r = 0; Angle angle; };                   ///< distance and direction from the centre
/// From the centre, `x` along the geodesic of the x axis, then `y` along its perpendicular (E²: Cartesian coordinates).
struct AtXy { double x = 0, y = 0; };
/// `distance` from the centre towards corner `number`, or the middle of wall `number` (from 1).
struct AtToward { bool corner = true; int number = 1; double distance = 0; };
struct AtWalls { std::array<int, 2> walls{}; std::array<double, 2> distances{}; };  ///< distances from two walls (numbered from 1)
struct Place {
  std::variant<AtCentre, AtDisk, AtPolar, AtXy, AtToward, AtWalls> floor;
  std::optional<double> z;          ///< height; the default depends on what is placed (objects: 0)
  SourceSpan span;
};

// ---- objects -----------------------------------------------------------------------------------------------------------------

struct MeshFile { Located<std::string> path; };                  ///< as written, relative to the scene file
struct SphereSpec { double radius = 0.1; };
struct CylinderSpec { double radius = 0.1, height = 0.3; };
struct BoxSpec { std::array<double, 3> size{0.2, 0.2, 0.2}; };
struct TorusSpec { double radius = 0.15, tube = 0.05; };
struct TorusKnotSpec { int p = 2, q = 3; double radius = 0.15, tube = 0.04; };
struct BarSpec { Place from, to; double width = 0.03; };        ///< a geodesic bar between two positions (key `beam`)

enum class Embedding { conformal, exponential };
/// An axis of a mesh, in either direction.
enum class Axis { plus_x, minus_x, plus_y, minus_y, plus_z, minus_z };

struct Object {
  std::string name;  ///< unique: as given, or the file name without ending, or the primitive's name, with "-2", "-3", … if it is taken
  SourceSpan name_span;             ///< of the given name; no source for other names
  std::variant<MeshFile, SphereSpec, CylinderSpec, BoxSpec, TorusSpec, TorusKnotSpec, BarSpec> shape;
  std::optional<double> size;       ///< longer horizontal extent before `turn`, intrinsic length; missing: the mesh's own units
  SourceSpan size_span;
  Embedding embedding = Embedding::conformal;   ///< default: conformal for mesh files, exponential for primitives
  Axis up = Axis::plus_z;           ///< the axis of the mesh that points up (glTF: y); the following fields refer to the mesh with z up
  std::array<double, 3> scale{1, 1, 1};  ///< factors along x, y and z, before `rotate`; ≠ 0; negative ones mirror
  std::array<Angle, 3> rotate{};    ///< about the fixed axes x, then y, then z
  Place place;
  Angle turn;                       ///< about the vertical through its centroid, last
  std::optional<Material> material; ///< missing: the mesh file's own, else matte grey
  SourceSpan span;
};

// ---- lamps, camera, cover -------------------------------------------------------------------------------------------------------

enum class LampKind { point, sphere, rectangle, disk, tube, spot };
enum class Falloff { geodesic, inverse_square, none };
struct Lamp {
  LampKind kind = LampKind::sphere;
  Place place;
  std::optional<Place> to;          ///< tube: the other end; spot, rectangle, disk: the target (default: the floor below)
  double radius = 0.05;             ///< sphere, disk, tube
  std::array<double, 2> size{0.2, 0.2};  ///< rectangle
  double power = 10;                ///< radiant power Φ in all directions; the irradiance in E² is Φ/(4πr²)
  Color color{1, 1, 1};
  Angle cone = Angle::from_degrees(60);  ///< spot: full opening angle
  bool visible = true;              ///< whether the lamp's body is drawn
  Falloff falloff = Falloff::geodesic;
  SourceSpan span;
};

/// Direct light from lamps, also over mirrors (`direct`), or also indirect light between matte surfaces and from emissive objects (`path`).
/// It holds for exports and for the tracer.
enum class Integrator { direct, path };
enum class BakeQuality { draft, normal, fine };
/// Whether exports are lit by orbc, in the atlas, or by the renderer's own lamps along straight rays.
enum class LightMode { baked, native };
/// The texels of the atlas: 8 or 16 bits per channel, sRGB-encoded, or linear half floats.
enum class AtlasFormat { srgb8, srgb16, exr };
struct BakeSpec {
  AtlasFormat atlas = AtlasFormat::srgb8;
  LightMode lights = LightMode::baked;
  int indirect_bounces = 64;        ///< `path`: most diffuse reflections, in the bake and in the tracer
  int mirror_bounces = 2;           ///< most reflections of a lamp's light in mirrors, in the bake and in the tracer
  SourceSpan mirror_bounces_span;
  /// `path`: directions sampled at a point of the bake; the tracer follows one path per sample for every 32 of them. Missing: by `quality`.
  std::optional<int> samples;
  BakeQuality quality = BakeQuality::normal;
  int seed = 1;                     ///< of the tracer's random numbers
};

/// How pictures show the cover: along geodesics, or as the disk chart is seen by straight rays.
enum class Rays { curved, straight };
/// Of eyes that are 64 mm apart in a room of 2.5 m, in heights of the room.
inline constexpr double kEyeSeparation = 0.064 / 2.5;
enum class Projection { perspective, panorama, cylinder, stereo };
struct LookAtObject { std::string name; };
struct LookDirection { Angle azimuth, elevation; };              ///< azimuth from the +x direction of the eye's frame, counter-clockwise
/// A thin lens. Only the tracer draws its blur.
struct Lens {
  double radius = 0.01;             ///< of the aperture
  SourceSpan radius_span;
  /// What is in focus: a distance along the central geodesic, or the centre of an object, or a place.
  Located<std::variant<double, LookAtObject, Place>> focus;
};
struct Camera {
  Place place;                      ///< default z: half the height
  Located<std::variant<LookAtObject, Place, LookDirection>> look_at;  ///< default: the centre of the room at the eye's height
  Projection projection = Projection::perspective;
  Angle fov = Angle::from_degrees(75);  ///< horizontal field of view; panorama: always 360° × 180°
  Angle roll;                       ///< perspective: rotation about the line of sight, clockwise as seen from behind
  std::optional<Lens> lens;         ///< perspective; missing: a pinhole
  std::optional<double> eye_separation;  ///< stereo: between the two eyes; missing: kEyeSeparation × the room's height
  SourceSpan eye_separation_span;
  std::array<int, 2> size{800, 600};
  SourceSpan size_span, fov_span;
  SourceSpan span;
};

struct CoverSpec {
  int max_bounces = 12;             ///< most reflections of a path
  double min_weight = 0;            ///< paths end when the largest channel of their throughput falls below this
  double min_pixels = 0;            ///< exports only: copies smaller than this in the image are replaced by a panel of their mean colour
  Color background{0, 0, 0};        ///< radiance of a mirror where a path ends, times the path's throughput
  bool background_expected = false; ///< the radiance is the expected one of the copies beyond, instead of `background`
};

/// A key that the author wrote, such as `cover.min_pixels`. Keys inside lists are not included.
struct GivenKey {
  std::string path;
  SourceSpan span;
};

struct Animation;

struct Scene {
  notation::Orbifold orbifold;
  SourceSpan orbifold_span;         ///< of the notation
  bool allow_non_orbifold = false;
  RoomSpec room;
  std::vector<Object> objects;
  std::vector<Lamp> lamps;
  Color ambient{0, 0, 0};           ///< radiance of the ambient light; scenes without any light are shown in their plain colours
  double exposure = 1;              ///< factor on the radiance (and plain colours) in images, but not on the background
  Integrator integrator = Integrator::direct;
  Rays rays = Rays::curved;
  BakeSpec bake;
  Camera camera;
  CoverSpec cover;
  std::shared_ptr<const Animation> animation;  ///< missing: a still (scene/animation.h)
  std::vector<GivenKey> given_keys;  ///< in the order of the file; for warnings about keys without effect on a product
  std::string folder;               ///< of the scene file; paths of meshes and textures are relative to it
  SourceSpan span;
};

}  // namespace orbc::scene
