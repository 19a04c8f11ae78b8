// Which options and keys matter for what. A row holds what an option belongs to, and a question that tells why it changes nothing even
// there, asked for each target. Options that are not in the table always matter: --threads, --quiet and the like.
#include "compiler/cli/effects.h"

#include <fmt/format.h>

#include <algorithm>

#include "compiler/bake/diffuse.h"
#include "compiler/driver/straight.h"

namespace orbc::cli {
namespace {

constexpr unsigned kExports = kPov | kGltf, kPictures = kTraced | kExports;

struct Situation {
  const Use& use;
  const driver::LoadedScene& loaded;
};

/// Why something changes nothing although it belongs to the target; nullptr when it does change something.
using Idle = const char* (*)(const Situation& now, unsigned target);

const char* never(const Situation&, unsigned) { return nullptr; }
const char* in_plans(const Situation& now, unsigned) { return now.use.plan ? "--plan writes no file" : nullptr; }
bool draws_straight(const Situation& now) { return driver::draws_straight(now.loaded.scene); }
const char* of_the_disk(const Situation& now, unsigned) {
  if (draws_straight(now)) return "straight rays show the chart in full, and light that does not depend on the eye";
  return now.use.disk_view ? "--view disk is seen from anywhere" : nullptr;
}
const char* of_tolerance(const Situation& now, unsigned) { return now.use.disk_view ? "--view disk is seen from anywhere" : nullptr; }
const char* of_rays(const Situation& now, unsigned) {
  if (now.loaded.interior->polygon.space == geometry::Space::euclidean) return "in flat rooms geodesics are straight";
  return now.use.disk_view ? "--view disk is seen from anywhere" : nullptr;
}
const char* of_lens(const Situation& now, unsigned) { return draws_straight(now) ? "straight rays belong to a pinhole" : nullptr; }
const char* with_all_passes(const Situation& now, unsigned) { return now.use.all_passes ? "an .exr holds all of them" : nullptr; }
const char* with_samples(const Situation& now, unsigned) {
  return now.use.samples > 1 ? "with more than one sample edges are mixed, and only --threshold counts" : nullptr;
}
const char* of_flat_rooms(const Situation& now, unsigned) {
  return now.loaded.interior->polygon.space == geometry::Space::euclidean ? "in flat rooms all models are the plane itself" : nullptr;
}
const char* without_lamps(const Situation& now, unsigned) { return now.loaded.scene.lamps.empty() ? "the scene has no lamps" : nullptr; }

bool is_lit(const scene::Scene& scene) { return !scene.lamps.empty() || scene.integrator == scene::Integrator::path; }
const char* without_light(const Situation& now, unsigned) {
  return is_lit(now.loaded.scene) ? nullptr : "without lamps or `integrator: path` a scene is shown in its plain colours";
}
const char* without_paths(const Situation& now, unsigned) {
  return now.loaded.scene.integrator == scene::Integrator::path ? nullptr
                                                                : "it belongs to `integrator: path`; without it surfaces pass no light on";
}
// How finely light is worked out.
const char* of_quality(const Situation& now, unsigned target) {
  if (target == kTraced) return without_paths(now, target);
  return bake::needs_bake(now.loaded.scene, *now.loaded.interior) ? nullptr : "plain colours are exact, nothing is baked";
}
const char* of_highlights(const Situation& now, unsigned target) {
  if (const char* why = of_the_disk(now, target)) return why;
  const auto shiny = [](const place::SurfaceStyle& look) {
    return look.material.kind != scene::MaterialKind::matte && look.material.kind != scene::MaterialKind::emissive;
  };
  const auto& looks = now.loaded.interior->styles;
  if (std::none_of(looks.begin(), looks.end(), shiny)) return "nothing in the scene is glossy, or of metal, mirror or glass";
  return of_quality(now, target);
}
struct Row {
  const char* name;
  unsigned belongs_to;
  Idle idle;
};

constexpr Row kOptions[] = {
    {"output", kPictures | kSvg, in_plans},
    {"format", kPictures | kSvg, in_plans},
    {"report", kExports, in_plans},
    {"nodes-per-copy", kGltf, in_plans},
    {"nodes-per-object", kGltf, in_plans},
    {"size", kPictures, never},
    {"max-bounces", kPictures | kSvg, never},
    {"projection", kPictures, never},
    {"expected-background", kPictures, of_the_disk},
    {"integrator", kPictures, never},
    {"quality", kPictures, of_quality},
    {"atlas", kExports, in_plans},
    {"lights", kExports, without_lamps},
    {"rays", kPictures, of_rays},
    {"tolerance", kExports, of_tolerance},
    {"max-triangles", kExports, never},
    {"no-lod", kExports, of_the_disk},
    {"no-highlights", kExports, of_highlights},
    {"max-atlas", kExports, never},
    {"view", kExports, never},
    {"model", kSvg, of_flat_rooms},
    {"colour", kSvg, never},
    {"pass", kTraced, with_all_passes},
    {"exact", kTraced, without_lamps},
    {"noise", kTraced, never},
    {"off-edge", kPictures, with_samples},
};

// Keys whose effect depends on what is made of the scene; the reader warns of those that never have one.
constexpr Row kKeys[] = {
    {"ambient", kPictures, without_light},
    {"bake.atlas", kExports, never},
    {"bake.lights", kExports, without_lamps},
    {"bake.mirrors", kPictures, without_lamps},
    {"bake.quality", kPictures, of_quality},
    {"cover.min_pixels", kExports, of_the_disk},
    {"rays", kPictures, of_rays},
    {"camera.lens", kPictures, of_lens},
};

const char* owner(unsigned targets) {
  switch (targets) {
    case kTraced:
      return "it belongs to the tracer";
    case kGltf:
      return "it belongs to glTF";
    case kSvg:
      return "it belongs to SVG";
    case kExports:
      return "it belongs to exports (.pov, .glb, .gltf)";
    default:
      return "it belongs to pictures and exports, not to the tiling";
  }
}

/// Why a row's option or key changes nothing here; nullptr when it does.
const char* why_idle(const Row& row, const Situation& now) {
  const unsigned both = row.belongs_to & now.use.targets;
  const char* why = owner(row.belongs_to);
  for (unsigned target = 1; target <= both; target *= 2) {
    if (!(both & target)) continue;
    why = row.idle(now, target);
    if (!why) return nullptr;
  }
  return why;
}

}  // namespace

Diagnostics without_effect(const std::vector<std::string>& options, const Use& use, const driver::LoadedScene& loaded) {
  const Situation now{use, loaded};
  Diagnostics warnings;
  for (const std::string& option : options) {
    const Row* row = std::find_if(std::begin(kOptions), std::end(kOptions), [&](const Row& r) { return option == r.name; });
    const char* why = row == std::end(kOptions) ? nullptr : why_idle(*row, now);
    if (why) warnings.push_back(make_warning("cli.no-effect", fmt::format("--{} changes nothing here: {}", option, why), "leave it out"));
  }
  if (use.targets == kSvg) return warnings;  // a scene is written for pictures; its tiling is a by-product
  for (const scene::GivenKey& key : loaded.scene.given_keys) {
    const Row* row = std::find_if(std::begin(kKeys), std::end(kKeys), [&](const Row& r) { return key.path == r.name; });
    const char* why = row == std::end(kKeys) ? nullptr : why_idle(*row, now);
    if (why)
      warnings.push_back(
          make_warning("scene.no-effect", fmt::format("`{}` changes nothing here: {}", key.path, why), "remove it", key.span));
  }
  return warnings;
}

}  // namespace orbc::cli
