#pragma once
#include <memory>
#include <vector>

#include "compiler/bake/diffuse.h"
#include "compiler/base/executor.h"
#include "compiler/base/progress.h"
#include "compiler/driver/lazy.h"
#include "compiler/driver/load.h"
#include "compiler/lod/lods.h"
#include "compiler/trace/follow.h"

namespace orbc::driver {

struct PrepareOptions {
  bool lods = true;            ///< draw small copies from coarser levels
  int max_atlas_side = 16384;  ///< pixels
};

/// What rays meet in a scene, and its light.
struct TraceContext {
  trace::TraceScene tracer;
  light::LightingContext lighting;
};

/// The meshes from which copies are drawn: the parts of a room and their levels, with the vertices that their colors need.
struct DrawnSurfaces {
  std::vector<place::PlacedMesh> meshes;               ///< parallel to InteriorWithLods::interior.parts
  std::vector<std::vector<bake::TexelPatch>> patches;  ///< of baked scenes, per mesh
  bake::Atlas plain;                                   ///< of other scenes: colors and textures; without its room
};

/// How stages work, and whom they tell how far they are.
struct Run {
  const Executor& executor;
  const Progress& progress;
};

/// A scene and all that no eye changes of it: levels of detail, tracer, light, diffuse bake. Each is made by the first picture that needs
/// it and serves all later ones. Invariant: each is made at most once, from the same scene, whichever thread asks first (lazy.h).
class PreparedScene {
 public:
  explicit PreparedScene(LoadedScene loaded, const PrepareOptions& options = {});

  [[nodiscard]] const LoadedScene& loaded() const { return loaded_; }
  [[nodiscard]] const scene::Scene& scene() const { return loaded_.scene; }
  [[nodiscard]] const place::Interior& interior() const { return *loaded_.interior; }
  [[nodiscard]] const PrepareOptions& options() const { return options_; }
  /// Whether surfaces get texels of their own: light, or patterns in space. Else plain colors and textures suffice.
  [[nodiscard]] bool is_baked() const { return is_baked_; }

  [[nodiscard]] const lod::InteriorWithLods& lods(const Run& run) const;
  [[nodiscard]] const TraceContext& trace_context(const Run& run) const;
  /// The tracer of a coarse proxy, for questions that need no colors.
  [[nodiscard]] const trace::TraceScene& proxy_tracer(const Run& run) const;
  /// Diagnostics: light.atlas-too-large, of plain scenes.
  [[nodiscard]] const Result<DrawnSurfaces>& surfaces(const Run& run) const;
  /// The diffuse light of all parts and levels. In: a baked scene.
  [[nodiscard]] const bake::DiffuseTexels& diffuse(const Run& run) const;
  /// The scene that exports draw: this one or, where renderers light it by lamps of their own, its unlit copy.
  [[nodiscard]] const PreparedScene& drawn_scene() const;

 private:
  struct Proxy {
    std::unique_ptr<place::Interior> room;  // the tracer refers to it
    trace::TraceScene tracer;
  };

  LoadedScene loaded_;
  PrepareOptions options_;
  bool is_baked_;
  Lazy<lod::InteriorWithLods> lods_;
  Lazy<TraceContext> trace_context_;
  Lazy<Proxy> proxy_;
  Lazy<Result<DrawnSurfaces>> surfaces_;
  Lazy<bake::DiffuseTexels> diffuse_;
  Lazy<std::unique_ptr<const PreparedScene>> unlit_copy_;
};

/// The lighting as the bake uses it: a draft leaves out more of what adds little.
[[nodiscard]] light::LightingContext baked_lighting(const PreparedScene& scene, const Run& run);

/// Options of the bake: densities are meant for rooms of some units of length and for pictures of 800 pixels. They are adapted to much
/// smaller and larger rooms, and to larger pictures from the scene's own camera.
[[nodiscard]] bake::BakeOptions bake_options(const PreparedScene& scene);
/// The same for another bake than the scene's own.
[[nodiscard]] bake::BakeOptions bake_options(const PreparedScene& scene, const scene::BakeSpec& spec);

/// The room with the colors that surfaces without light show.
[[nodiscard]] place::Interior with_exposure(place::Interior interior, double exposure);

}  // namespace orbc::driver
