#include "compiler/driver/detail.h"

#include <algorithm>
#include <utility>

#include "compiler/cover/beam.h"
#include "compiler/cover/unfold.h"
#include "compiler/lod/budget.h"

namespace orbc::driver {
namespace {

bool is_for_eye(const Job& job) { return job.options.bend.view == bend::View::eye; }

bend::BendOptions bend_options(const Job& job) {
  bend::BendOptions options = job.options.bend;
  options.colors_vary = options.colors_vary || job.scene.is_baked();
  return options;
}

/// With a budget.
Result<Detail> fit_detail(const Job& job, const std::vector<cover::Copy>& copies) {
  const Result<DrawnSurfaces>& surfaces = job.scene.surfaces(job.run);
  if (!surfaces) return surfaces.error();
  const place::Interior& interior = job.scene.interior();
  cutoff::ImpostorPanels panels = cutoff::impostor_panels(interior, job.eye);
  if (!cutoff::shows_cutoff(job.cover)) panels.depth.clear();
  for (auto* list : {&panels.depth, &panels.size, &panels.size_unsplit}) *list = drawn_panels(job.scene, std::move(*list)).meshes;
  lod::BudgetScene scene{job.scene.lods(job.run), {}, job.eye, job.cover, panels};
  for (const place::PlacedMesh& mesh : surfaces->meshes) scene.drawn.push_back(&mesh);
  Detail detail;
  detail.bending = bend_options(job);
  auto fit = lod::fit_to_budget(scene, copies, *job.options.budget, detail.bending, job.run.executor, job.run.progress);
  if (!fit) return fit.error();
  detail.copies = std::move(fit->copies);
  detail.selection = std::move(fit->selection);
  detail.bending.tolerance_px = fit->tolerance_px;
  detail.bending.max_triangles = lod::bending_limit(*job.options.budget);
  detail.culled = fit->culled;
  detail.cull_px = fit->cull_px;
  detail.has_impostors = fit->has_impostors;
  detail.impostors_dropped = !fit->has_impostors && (cutoff::shows_cutoff(job.cover) || job.cover.min_pixels > 0 || fit->culled > 0);
  return detail;
}

}  // namespace

Result<std::vector<cover::Copy>> unfold_within_memory(const Job& job) {
  report(job.run.progress, "unfolding", 0, 0);
  const place::Interior& interior = job.scene.interior();
  const std::uint64_t max_bytes = job.options.max_memory / 2;
  const bool by_beams = cover::needs_beams(interior);
  if (!by_beams) {
    const auto planned = cover::plan(interior, job.eye, job.cover, {max_bytes});
    if (!planned) return planned.error();
  }
  const double bytes_each = by_beams ? cover::kBytesPerBeam : cover::kBytesPerCopy;
  const auto max_copies = static_cast<std::uint64_t>(static_cast<double>(max_bytes) / bytes_each);
  auto copies = cover::unfold(interior, job.eye, job.cover, {std::min(max_copies, cover::UnfoldOptions().max_copies), job.run.progress});
  if (!copies || is_for_eye(job)) return copies;
  if (std::any_of(copies->begin(), copies->end(), [](const cover::Copy& c) { return !c.height_bounds.empty(); }))
    return make_error(
        "cover.stacked-mirrors",
        "the mirrors above each other that differ show their copies to one eye along geodesics: --view disk and straight rays have none",
        "give them the same reflectance and tint, or leave out --view disk or `rays: straight`");
  return copies;
}

Result<Detail> choose_detail(const Job& job, std::vector<cover::Copy> copies) {
  Detail detail;
  if (job.options.budget && is_for_eye(job)) {
    auto fitted = fit_detail(job, copies);
    if (!fitted) return fitted.error();
    detail = std::move(*fitted);
  } else {
    detail.bending = bend_options(job);
    detail.has_impostors = is_for_eye(job);
    detail.selection = is_for_eye(job) ? lod::select_lods(job.scene.lods(job.run), copies, job.eye, detail.bending)
                                       : lod::full_detail(job.scene.lods(job.run), copies.size());
    detail.copies = std::move(copies);
  }
  detail.stats = lod::lod_stats(job.scene.lods(job.run), detail.selection);
  return detail;
}

cutoff::CullTest cull_test(const Job& job, const Detail& detail) {
  return detail.has_impostors ? cutoff::cull_below(job.scene.interior(), job.eye, job.cover, detail.cull_px) : cutoff::CullTest{};
}

PicturePanels picture_panels(const Job& job, const Detail& detail) {
  if (!detail.has_impostors) return {};
  const place::Interior& interior = job.scene.interior();
  cutoff::ImpostorPanels panels = cutoff::impostor_panels(interior, job.eye);
  PicturePanels chosen;
  chosen.size_unsplit = cutoff::can_skip_splitting(interior, std::max(job.cover.min_pixels, detail.cull_px));
  if (cutoff::shows_cutoff(job.cover)) chosen.depth = std::move(panels.depth);
  if (cull_test(job, detail)) chosen.size = std::move(chosen.size_unsplit ? panels.size_unsplit : panels.size);
  return chosen;
}

cutoff::CutoffEstimate estimate_endings(const Job& job, const Detail& detail) {
  if (!is_for_eye(job)) return {};
  const scene::Scene& drawn = job.scene.scene();
  // Impostors are exposed like everything else, the background is not.
  const scene::Color background = (drawn.exposure > 0 ? 1 / drawn.exposure : 1) * job.cover.background;
  const bool wants_color = detail.has_impostors && job.cover.background_expected;
  const cutoff::CullTest is_culled = cull_test(job, detail);
  cutoff::CutoffEstimate estimate;
  if (wants_color || is_culled) {
    const TraceContext& context = job.lit_scene.trace_context(job.run);
    const std::vector<double> bands = is_culled ? cutoff::height_bands(job.scene.interior(), job.eye) : std::vector<double>{};
    estimate = cutoff::estimate_cutoff({job.lit_scene.scene(), job.eye, context.tracer, &context.lighting}, {wants_color, is_culled, bands},
                                       job.run.executor);
    if (&job.lit_scene != &job.scene) {  // the unlit copy shows radiance as the picture of the lit scene does
      const double exposure = job.lit_scene.scene().exposure;
      estimate.color = exposure * estimate.color;
      for (scene::Color& color : estimate.color_by_band) color = exposure * color;
    }
  } else {
    estimate = cutoff::estimate_cutoff({drawn, job.eye, job.scene.proxy_tracer(job.run)}, {}, job.run.executor);
  }
  if (!wants_color) estimate.color = background;
  return estimate;
}

DrawnPanels drawn_panels(const PreparedScene& scene, std::vector<place::PlacedMesh> panels) {
  if (!scene.is_baked() || panels.empty()) return {std::move(panels), {}};
  place::Interior interior;
  interior.polygon = scene.interior().polygon;
  interior.height = scene.interior().height;
  interior.parts = std::move(panels);
  DrawnPanels drawn;
  for (std::size_t p = 0; p < interior.parts.size(); ++p) {
    drawn.patches.push_back(
        bake::make_patches(interior, static_cast<std::uint32_t>(p), surface::part_normals(interior, interior.parts[p])));
    drawn.meshes.push_back(bake::split_by_patch(interior.parts[p], drawn.patches.back()));
  }
  return drawn;
}

}  // namespace orbc::driver
