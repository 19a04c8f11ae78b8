#pragma once
#include "compiler/light/lighting.h"
#include "compiler/place/interior.h"
#include "compiler/scene/scene.h"

namespace orbc::bake {

/// How the light is found that surfaces give each other (solve_radiosity).
struct RadiosityOptions {
  int samples = 256;    ///< directions that are traced from every gather point
  double density = 24;  ///< gather points per unit of length, intrinsic
};

/// How finely light is baked. Densities are points or texels per unit of length of the room, intrinsic.
struct BakeOptions {
  double min_density = 32;       ///< of points that are always lit: smaller shadows may be missed
  double max_density = 160;      ///< of points where light changes, at the borders of shadows
  double texture_density = 400;  ///< of texels where a texture or a solid pattern changes
  double tolerance = 1.5;        ///< steps of 1/255 of the picture: what is interpolated may be off by so much
  int max_side = 16384;          ///< texels of the atlas
  bool with_image16 = false;     ///< make a picture of 16 bits a channel as well
  RadiosityOptions radiosity;    ///< used if LightOptions ask for light that surfaces give each other
};
/// The options for what the author of a scene, or the command line, says of the bake.
[[nodiscard]] BakeOptions bake_options(const scene::BakeSpec& spec);
/// The options of light for a bake of that quality: a draft leaves out more of the images of lamps that add little.
[[nodiscard]] light::LightOptions bake_light_options(const scene::Scene& scene);

/// Whether a material shows what lies around it: mirror and glass always, metal where there is light.
[[nodiscard]] bool is_specular(const scene::Material& material, bool lit);
/// Whether any style of a room is specular.
[[nodiscard]] bool is_specular(const place::Interior& interior, bool lit);

/// Whether the plain colours of `make_atlas` do not suffice: there are lamps, light between surfaces, mirror or glass objects, or solid
/// patterns (which a scene without lamps shows unlit).
[[nodiscard]] bool needs_bake(const scene::Scene& scene, const place::Interior& interior);

}  // namespace orbc::bake
