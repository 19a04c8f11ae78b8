#pragma once
#include <memory>
#include <optional>

#include "compiler/place/camera.h"
#include "compiler/render/film.h"
#include "compiler/scene/scene.h"
#include "exporters/html/core/light_job.h"
#include "exporters/html/core/page_assets.h"

namespace orbc::html {

inline void append(Diagnostics& to, const Diagnostics& more) { to.insert(to.end(), more.begin(), more.end()); }

/// A scene of the page, furnished and placed. It stays at its address: the tracer refers to its interior.
struct OpenScene {
  scene::Scene scene;
  place::Interior interior;
  std::shared_ptr<const light::LampSet> lamps;
  place::Camera eye;
  DrawnMeshes drawn;
  std::vector<surface::PartNormals> normals;
  std::optional<trace::TraceScene> tracer;  ///< made when it is first asked for
  std::optional<LightJob> light;            ///< likewise
  std::size_t lit = 0;                      ///< points of the light job that are done
};

/// A scene with the diagnostics of its author, or with those that say why there is none.
struct Opened {
  std::unique_ptr<OpenScene> scene;
  Diagnostics diagnostics;
};

/// Reads a scene and furnishes its room, as driver::load does, with the files of the page.
[[nodiscard]] Opened open_scene(const std::shared_ptr<const SourceText>& source, const PageFiles& files);

/// The tracer and the light job of a scene, made when they are first asked for.
[[nodiscard]] const trace::TraceScene& tracer_of(OpenScene& scene);
[[nodiscard]] LightJob& light_job_of(OpenScene& scene);

/// A picture that the tracer refines, sample by sample.
struct RefinedPicture {
  place::Camera eye;
  double shift_x = 0, shift_y = 0;  ///< of the principal point from the middle of the picture, in pixels to the right and down
  std::vector<scene::Color> sums;   ///< of radiances, a pixel
  std::vector<int> counts;          ///< samples, a pixel
};

/// A part of a picture, in pixels.
struct Tile {
  int x = 0, y = 0, width = 0, height = 0;
};

/// Adds sample `index` of `samples` to the pixels of a tile. Makes: 4 bytes a pixel of the tile, sRGB of the mean of its samples so far.
[[nodiscard]] std::vector<std::uint8_t> refine(OpenScene& scene, RefinedPicture& picture, const Tile& tile, int index, int samples);

}  // namespace orbc::html
