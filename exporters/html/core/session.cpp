#include "exporters/html/core/session.h"

#include <algorithm>
#include <cmath>

#include "compiler/image/srgb.h"
#include "compiler/place/furnish.h"
#include "compiler/render/draw.h"
#include "compiler/render/radiance.h"
#include "compiler/room/realise.h"
#include "compiler/scene/read.h"

namespace orbc::html {
namespace {

constexpr double kMaxEdge = 0.12;  // of triangles, as a share of min(1, inradius): chords then lie within a pixel of their geodesics

render::DrawOptions draw_options(OpenScene& scene, int samples) {
  const light::LightingContext& lighting = light_job_of(scene).lighting;
  render::DrawOptions draw;
  draw.samples = samples;
  draw.lighting = lighting.lit ? &lighting : nullptr;
  draw.max_bounces = scene.scene.cover.max_bounces;
  draw.min_weight = scene.scene.cover.min_weight;
  draw.paths = 1;
  draw.specular_samples = 64;
  draw.background = scene.scene.cover.background;
  if (scene.scene.exposure > 0) {  // the film is exposed as a whole; the background is not
    draw.background = (1 / scene.scene.exposure) * draw.background;
    draw.max_radiance = 1 / scene.scene.exposure;
  }
  return draw;
}

}  // namespace

Opened open_scene(const std::shared_ptr<const SourceText>& source, const PageFiles& files) {
  Opened opened;
  const auto refuse = [&](const Diagnostics& errors) {
    append(opened.diagnostics, errors);
    return std::move(opened);
  };
  auto read = scene::read_scene(source);
  if (!read) return refuse(read.error());
  auto made = std::make_unique<OpenScene>();
  made->scene = std::move(read->scene);
  const scene::Scene& scene = made->scene;
  opened.diagnostics = std::move(read->notes);
  const auto room = room::realise(scene.orbifold, scene.room.shape, scene.allow_non_orbifold);
  if (!room) return refuse(located(room.error(), scene.room.shape.span.source ? scene.room.shape.span : scene.orbifold_span));
  auto furnished = place::furnish(scene, *room, assets_of_page(files));
  if (!furnished) return refuse(located(furnished.error(), scene.span));
  append(opened.diagnostics, located(furnished->warnings, scene.span));
  auto lamps = light::prepare_lamps(scene, furnished->interior, light::light_options(scene));
  if (!lamps) return refuse(located(lamps.error(), scene.span));
  append(opened.diagnostics, located(lamps->warnings, scene.span));
  made->interior = light::with_lamp_bodies(scene, lamps->lamps, std::move(furnished->interior));
  made->lamps = std::make_shared<const light::LampSet>(std::move(*lamps));
  const auto eye = place::make_camera(scene, made->interior);
  if (!eye) return refuse(located(eye.error(), scene.camera.span.source ? scene.camera.span : scene.span));
  made->eye = *eye;
  for (const place::PlacedMesh& part : made->interior.parts) made->normals.push_back(surface::part_normals(made->interior, part));
  const double unit = room->inradius > 0 ? std::fmin(1, room->inradius) : 1;
  made->drawn = drawn_meshes(made->interior, made->normals, kMaxEdge * (room->space == geometry::Space::euclidean ? 1e9 : unit));
  opened.scene = std::move(made);
  return opened;
}

const trace::TraceScene& tracer_of(OpenScene& scene) {
  if (!scene.tracer) scene.tracer = trace::prepare(scene.interior);
  return *scene.tracer;
}

LightJob& light_job_of(OpenScene& scene) {
  if (!scene.light)
    scene.light = light_job(light::prepare_light(scene.scene, scene.interior, scene.lamps, light::light_options(scene.scene)),
                            scene.interior, scene.drawn);
  return *scene.light;
}

std::vector<std::uint8_t> refine(OpenScene& scene, RefinedPicture& picture, const Tile& tile, int index, int samples) {
  const trace::TraceScene& tracer = tracer_of(scene);
  const render::DrawOptions options = draw_options(scene, samples);
  const std::array<double, 2> offset = render::sample_points(samples)[static_cast<std::size_t>(index)];
  const int width = picture.eye.width, height = picture.eye.height;
  std::vector<std::uint8_t> pixels;
  std::vector<trace::Ray> rays;
  std::vector<std::size_t> places;
  for (int y = std::max(0, tile.y); y < std::min(height, tile.y + tile.height); ++y)
    for (int x = std::max(0, tile.x); x < std::min(width, tile.x + tile.width); ++x) {
      rays.push_back(render::eye_ray(picture.eye, x + offset[0] - picture.shift_x, y + offset[1] - picture.shift_y));
      places.push_back(static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x));
    }
  std::vector<trace::Path> paths = trace::follow(tracer, rays, render::follow_options(options));
  const double exposure = scene.scene.exposure;
  for (std::size_t i = 0; i < paths.size(); ++i) {
    const std::size_t at = places[i];
    const render::PixelSampler sampler(1, at, index, samples);
    const render::RayResult found = render::radiance(tracer, std::move(paths[i]), options, sampler);
    const double white = options.lighting ? light::white_level(*options.lighting) : options.max_radiance;
    picture.sums[at] = picture.sums[at] + render::shown_radiance(found, white).radiance;
    const double share = exposure / ++picture.counts[at];
    for (const double c : {picture.sums[at].r, picture.sums[at].g, picture.sums[at].b})
      pixels.push_back(static_cast<std::uint8_t>(std::lround(255 * image::encode_srgb(std::clamp(share * c, 0.0, 1.0)))));
    pixels.push_back(255);
  }
  return pixels;
}

}  // namespace orbc::html
