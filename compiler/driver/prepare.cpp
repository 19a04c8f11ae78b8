#include "compiler/driver/prepare.h"

#include <algorithm>
#include <utility>

#include "compiler/driver/straight.h"
#include "compiler/lod/build.h"
#include "compiler/lod/select.h"
#include "compiler/native_lights/split.h"

namespace orbc::driver {
namespace {

constexpr double kProxyOffset = 0.004;  // of the room's circumradius: how far a proxy's surfaces may be off
// Between these extents a room is baked at the densities of the options. In a tiny room the points of the options would find no shadow, and
// no picture would hold the points of a huge one.
constexpr double kMinExtent = 0.5, kMaxExtent = 64;
// Pixels per radian for which BakeOptions::max_density is meant: 800 pixels across 80°. Borders of shadows would be saws in
// larger pictures.
constexpr double kPixelsPerRadian = 480, kMaxPictureFactor = 4;

LoadedScene unlit_scene(const LoadedScene& lit) {
  native_lights::UnlitCopy copy = native_lights::unlit_copy(lit.scene, *lit.interior);
  return {std::move(copy.scene),
          std::make_shared<const place::Interior>(std::move(copy.interior)),
          std::make_shared<const light::LampSet>(),
          lit.eye,
          {},
          {},
          lit.unit_of_length};
}

Result<DrawnSurfaces> plain_surfaces(const PreparedScene& scene, const place::Interior& interior) {
  auto atlas = bake::make_atlas(with_exposure(interior, scene.scene().exposure),
                                {scene.options().max_atlas_side, scene.scene().bake.atlas != scene::AtlasFormat::srgb8});
  if (!atlas) return atlas.error();
  DrawnSurfaces surfaces{std::move(atlas->room.parts), {}, std::move(*atlas)};
  surfaces.plain.room = {};
  return surfaces;
}

DrawnSurfaces baked_surfaces(const place::Interior& interior, const Executor& executor) {
  DrawnSurfaces surfaces;
  surfaces.patches.resize(interior.parts.size());
  surfaces.meshes.resize(interior.parts.size());
  executor(interior.parts.size(), [&](std::size_t p) {
    surfaces.patches[p] = bake::make_patches(interior, static_cast<std::uint32_t>(p), surface::part_normals(interior, interior.parts[p]));
    surfaces.meshes[p] = bake::split_by_patch(interior.parts[p], surfaces.patches[p]);
  });
  return surfaces;
}

}  // namespace

PreparedScene::PreparedScene(LoadedScene loaded, const PrepareOptions& options)
    : loaded_(std::move(loaded)), options_(options), is_baked_(bake::needs_bake(loaded_.scene, *loaded_.interior)) {
  if (draws_straight(loaded_.scene)) options_.lods = false;
}

const lod::InteriorWithLods& PreparedScene::lods(const Run& run) const {
  return lods_.get([&] {
    report(run.progress, "levels of detail", 0, 0);
    return options_.lods ? lod::build_lods(interior(), run.executor) : lod::without_lods(interior());
  });
}

const TraceContext& PreparedScene::trace_context(const Run& run) const {
  return trace_context_.get([&] {
    report(run.progress, "preparing", 0, 0);
    return TraceContext{trace::prepare(interior(), run.executor),
                        light::prepare_light(scene(), interior(), loaded_.lamps, light::light_options(scene()), run.executor)};
  });
}

const trace::TraceScene& PreparedScene::proxy_tracer(const Run& run) const {
  return proxy_
      .get([&] {
        auto room = std::make_unique<place::Interior>(lod::coarse_proxy(lods(run), kProxyOffset * interior().polygon.circumradius));
        trace::TraceScene tracer = trace::prepare(*room, run.executor);
        return Proxy{std::move(room), std::move(tracer)};
      })
      .tracer;
}

const Result<DrawnSurfaces>& PreparedScene::surfaces(const Run& run) const {
  return surfaces_.get([&]() -> Result<DrawnSurfaces> {
    const place::Interior& with_lods = lods(run).interior;
    if (!is_baked_) return plain_surfaces(*this, with_lods);
    return baked_surfaces(with_lods, run.executor);
  });
}

const bake::DiffuseTexels& PreparedScene::diffuse(const Run& run) const {
  return diffuse_.get([&] {
    report(run.progress, "atlas", 0, 0);
    return bake::bake_texels(lods(run).interior, surfaces(run)->patches, baked_lighting(*this, run), bake_options(*this), run.executor,
                             run.progress);
  });
}

const PreparedScene& PreparedScene::drawn_scene() const {
  if (!native_lights::uses_native_lights(scene())) return *this;
  return *unlit_copy_.get([&] { return std::make_unique<const PreparedScene>(unlit_scene(loaded_), options_); });
}

light::LightingContext baked_lighting(const PreparedScene& scene, const Run& run) {
  light::LightingContext lighting = scene.trace_context(run).lighting;
  lighting.options = bake::bake_light_options(scene.scene());
  return lighting;
}

bake::BakeOptions bake_options(const PreparedScene& scene) { return bake_options(scene, scene.scene().bake); }

bake::BakeOptions bake_options(const PreparedScene& scene, const scene::BakeSpec& spec) {
  bake::BakeOptions options = bake::bake_options(spec);
  options.max_side = scene.options().max_atlas_side;
  options.with_image16 = spec.atlas != scene::AtlasFormat::srgb8;
  const double extent = std::max(scene.interior().polygon.circumradius, scene.interior().height);
  const double factor = extent < kMinExtent ? 1 / extent : extent > kMaxExtent ? kMaxExtent / extent : 1;
  options.min_density *= factor;
  options.max_density *= factor * std::clamp(place::pixels_per_radian(scene.loaded().eye) / kPixelsPerRadian, 1.0, kMaxPictureFactor);
  options.texture_density *= factor;
  return options;
}

place::Interior with_exposure(place::Interior interior, double exposure) {
  for (place::SurfaceStyle& look : interior.styles)
    look.color = (exposure * (look.material.kind == scene::MaterialKind::emissive ? look.material.emission : 1)) * look.color;
  return interior;
}

}  // namespace orbc::driver
