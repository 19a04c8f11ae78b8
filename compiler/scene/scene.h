#pragma once
#include <array>
#include <complex>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "compiler/base/angle.h"
#include "compiler/base/source_span.h"
#include "compiler/notation/orbifold.h"
#include "compiler/scene/color.h"

namespace orbc::scene {

/// A value and the place in the file where the author wrote it (no source for defaults).
template <class T>
struct Sourced {
  T value{};
  SourceSpan span;
};

// ---- the room -------------------------------------------------------------------------------------------------------------

/// A common perpendicular of two walls (numbered from 1) that cuts the polygon, and its length in curvature radii.
struct Cut {
  std::array<int, 2> walls{};
  double length = 1.4;
};

enum class ShapeKind { tangential, paper, lengths };

/// How the free side lengths of the polygon are chosen (design §4).
struct Shape {
  ShapeKind kind = ShapeKind::tangential;
  double cut = 1.4;                 ///< `paper`: length of every cut that `cuts` does not name
  std::vector<Cut> cuts;            ///< `paper`: another decomposition; empty = the paper's forward reading
  std::map<int, double> lengths;    ///< `lengths`: wall number → side length, N−3 of them (N for none free: 0)
  double scale = 1;                 ///< E² only: inradius (tangential); of `**` half the distance of the mirrors
  double aspect = 1;                ///< `*2222` only: side 1 / side 2
  double strip_length = 4;          ///< `**` only: distance of the plain end walls, in units of `scale`
  SourceSpan span;
};

// ---- what surfaces are made of ----------------------------------------------------------------------------------------------

enum class MaterialKind { matte, glossy, metal, mirror, glass, emissive };
enum class Pattern { plain, checker, marble, wood, granite, texture };

/// What a surface looks like. Colours are linear reflectances; `texture` is a path as written, relative to the scene file.
struct Material {
  MaterialKind kind = MaterialKind::matte;
  Pattern pattern = Pattern::plain;
  Color color{0.8, 0.8, 0.8};
  Color second{0.2, 0.2, 0.2};      ///< the other colour of a pattern
  double cell = 0.25;               ///< size of a pattern's cell, intrinsic length
  double roughness = 0.3;           ///< glossy and metal, 0…1
  double index = 1.5;               ///< refractive index of glass
  double emission = 1;              ///< emissive: radiance = emission × color
  Sourced<std::string> texture;
  /// A picture like `texture`: where it is less opaque (or, without alpha, darker) than `cutoff` there is no surface; empty: none
  Sourced<std::string> opacity_mask;
  double cutoff = 0.5;
  SourceSpan span;
};

/// A geodesic beam around a mirror: a box of square section `width`, half of it over the mirror, half over the wall.
struct Frame {
  double width = 0.03;
  Material material;
};

/// A mirror: a rectangle on its wall, `span` along the wall from corner i and `height` above the floor; missing = all of it.
struct Mirror {
  std::optional<std::array<double, 2>> span;
  std::optional<std::array<double, 2>> height;
  double reflectance = 0.9;         ///< = 1 − attenuation, 0…1
  Color tint{1, 1, 1};
  Color glow{0, 0, 0};              ///< radiance of its own, added to what it reflects (the tracer alone draws it)
  std::optional<Frame> frame;
  SourceSpan source;
};

/// A wall: what is not covered by mirrors is plain. No mirrors = a plain wall.
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
  std::vector<Wall> walls;          ///< one for each wall, in order; `all` and the single entries are merged by the reader
  SourceSpan span;
};

// ---- places ------------------------------------------------------------------------------------------------------------------

/// Where something stands on the floor, in the coordinates of the room (centre at the origin, corner 1 towards +x).
struct AtCentre {};
struct AtDisk { std::complex<double> z; };                       ///< disk chart
struct AtPolar { double r = 0; Angle angle; };                   ///< intrinsic distance and direction from the centre
/// Geodesic coordinates: from the centre `x` along the geodesic of the x axis, then `y` along the perpendicular to it (E²: Cartesian)
struct AtXy { double x = 0, y = 0; };
/// `distance` from the centre towards corner or the middle of wall `number`
struct AtToward { bool corner = true; int number = 1; double distance = 0; };
struct AtWalls { std::array<int, 2> walls{}; std::array<double, 2> distances{}; };  ///< given distances from two walls
struct Place {
  std::variant<AtCentre, AtDisk, AtPolar, AtXy, AtToward, AtWalls> floor;
  std::optional<double> z;          ///< height; what is missing is decided by what is placed (objects stand on the floor)
  SourceSpan span;
};

// ---- objects -----------------------------------------------------------------------------------------------------------------

struct MeshFile { Sourced<std::string> path; };                  ///< as written, relative to the scene file
struct SphereSpec { double radius = 0.1; };
struct CylinderSpec { double radius = 0.1, height = 0.3; };
struct BoxSpec { std::array<double, 3> size{0.2, 0.2, 0.2}; };
struct TorusSpec { double radius = 0.15, tube = 0.05; };
struct TorusKnotSpec { int p = 2, q = 3; double radius = 0.15, tube = 0.04; };
struct BeamSpec { Place from, to; double width = 0.03; };        ///< a geodesic beam between two positions of the room

enum class Embedding { conformal, exponential };
/// An axis of a mesh, in either direction.
enum class Axis { plus_x, minus_x, plus_y, minus_y, plus_z, minus_z };

struct Object {
  std::string name;                 ///< given, or the mesh's file name without ending, or the primitive's name; made unique by "-2"
  SourceSpan name_span;             ///< where the name was written; no source when it was not
  std::variant<MeshFile, SphereSpec, CylinderSpec, BoxSpec, TorusSpec, TorusKnotSpec, BeamSpec> shape;
  std::optional<double> size;       ///< longest horizontal extent as it stands, before `turn`; intrinsic length; missing = own units
  SourceSpan size_span;
  Embedding embedding = Embedding::conformal;   ///< when not given: of mesh files conformal, of bodies of stated lengths exponential
  Axis up = Axis::plus_z;           ///< which axis of the mesh points up (glTF files: y); after that its axes are x, y and z, upwards
  std::array<double, 3> scale{1, 1, 1};  ///< along these axes, before `rotate`; negative: a mirror image; none is 0
  std::array<Angle, 3> rotate{};    ///< about these axes: about x, then about y, then about z, all as they are before the first turn
  Place place;
  Angle turn;                       ///< about the vertical through its centroid, after everything else
  std::optional<Material> material; ///< missing: the file's own (glTF), else matte grey
  SourceSpan span;
};

// ---- light, eye, cover -------------------------------------------------------------------------------------------------------

enum class LampKind { point, sphere, rectangle, disk, tube, spot };
enum class Falloff { geodesic, inverse_square, none };
struct Lamp {
  LampKind kind = LampKind::sphere;
  Place place;
  std::optional<Place> to;          ///< tube: the other end; spot, rectangle, disk: what it faces (default: the floor)
  double radius = 0.05;             ///< sphere, disk, tube
  std::array<double, 2> size{0.2, 0.2};  ///< rectangle
  double power = 10;                ///< radiant power of all directions together, in units in which E² irradiance is Φ/(4πr²)
  Color color{1, 1, 1};
  Angle cone = Angle::from_degrees(60);
  bool visible = true;
  Falloff falloff = Falloff::geodesic;
  SourceSpan span;
};

/// Which light there is, in both roads: what comes straight from lamps or over mirrors (`direct`), or also what matte surfaces pass on to
/// each other, and emissive objects (`path`).
enum class Integrator { direct, path };
enum class BakeQuality { draft, normal, fine };
/// Who lights exports: orbc, in the atlas; or the renderer with lamps of its own, along straight rays.
enum class LightsBy { baked, native };
/// How finely the atlas holds colours: 8 or 16 bits a channel, sRGB-encoded, or half floats, linear.
enum class AtlasDepth { eight, sixteen, exr };
struct BakeSpec {
  AtlasDepth atlas = AtlasDepth::eight;
  LightsBy lights = LightsBy::baked;
  int bounces = 64;                 ///< `path`: how often matte surfaces may pass light on; the tracer keeps to it too
  int mirrors = 2;                  ///< mirrors on walls, floor and ceiling that the light of a lamp is followed over, in both roads
  SourceSpan mirrors_span;
  /// `path`: directions asked at a point of the baked light, and for every 32 of them a path for each sample of the
  std::optional<int> samples;
                                    ///< tracer; missing = the quality's
  BakeQuality quality = BakeQuality::normal;
  int seed = 1;                     ///< of the tracer's random numbers
};

enum class Projection { perspective, panorama, cylinder };
struct LookAtObject { std::string name; };
struct LookDirection { Angle azimuth, elevation; };              ///< azimuth from the +x direction of the eye's frame, counter-clockwise
/// A thin lens: things at the focus distance are sharp. The tracer alone draws it.
struct Lens {
  double radius = 0.01;             ///< of the aperture, intrinsic length
  SourceSpan radius_span;
  /// Distance from the eye of what is sharp, along the geodesic there: a length, or that of the centre of an object, or of a place
  Sourced<std::variant<double, LookAtObject, Place>> focus;
};
struct Camera {
  Place place;                      ///< default z: half the height
  Sourced<std::variant<LookAtObject, Place, LookDirection>> look_at;  ///< default: the centre of the room at the eye's height
  Projection projection = Projection::perspective;
  Angle fov = Angle::from_degrees(75);  ///< horizontal field of view; panorama: always 360° × 180°
  Angle roll;                       ///< perspective: the camera turned about its line of sight, clockwise as seen from behind it
  std::optional<Lens> lens;         ///< perspective: missing = a pinhole, all is sharp
  std::array<int, 2> size{800, 600};
  SourceSpan size_span, fov_span;
  SourceSpan span;
};

struct CoverSpec {
  int max_bounces = 12;
  double min_weight = 0;            ///< paths whose weight (largest channel) is below it end
  /// Exports only: copies smaller than this in the picture are merged: a panel of their mean colour stands for them
  double min_pixels = 0;
  Color background{0, 0, 0};        ///< what is seen where a path ends at a mirror, times the path's weight
  bool background_expected = false; ///< instead of it the colour expected beyond
};

/// A key that the author wrote, such as `cover.min_pixels`, and where. Keys inside lists are not among them.
struct GivenKey {
  std::string path;
  SourceSpan span;
};

struct Scene {
  notation::Orbifold orbifold;
  SourceSpan orbifold_span;         ///< where the notation was written
  bool allow_non_orbifold = false;
  RoomSpec room;
  std::vector<Object> objects;
  std::vector<Lamp> lamps;
  Color ambient{0, 0, 0};           ///< light from everywhere; a scene without lamps is shown in its plain colours
  double exposure = 1;              ///< radiance × exposure is what a picture shows, of plain colours too; not of the background
  Integrator integrator = Integrator::direct;
  BakeSpec bake;
  Camera camera;
  CoverSpec cover;
  std::vector<GivenKey> given;      ///< in the order of the file: to tell its author what has no effect on what is made of it
  std::string folder;               ///< of the scene file; paths of meshes and textures are relative to it
  SourceSpan span;
};

}  // namespace orbc::scene
