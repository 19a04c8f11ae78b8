#include "compiler/driver/compile.h"

#include <fmt/format.h>

#include <utility>

#include "compiler/driver/assemble.h"
#include "compiler/driver/plan.h"
#include "compiler/driver/straight.h"
#include "compiler/native_lights/split.h"

namespace orbc::driver {
namespace {

constexpr std::uint64_t kLargeTriangles = 1'000'000;  // before splitting: from here on it pays to plan ahead

/// Guards the promise of a budget. lod::fit_to_budget counts the very triangles that are drawn: an error here means that it does not.
Diagnostics check_budget(const Job& job, std::uint64_t triangles) {
  if (!job.options.budget || job.options.bend.view != bend::View::eye || triangles <= *job.options.budget) return {};
  return {make_error("bend.too-dense", fmt::format("{} triangles come out where {} are allowed", triangles, *job.options.budget),
                     "allow more with --max-triangles")};
}

/// unfold → levels of detail → endings → atlas → draw list → bend.
Result<Drawing> draw(const Job& job) {
  auto copies = unfold_within_memory(job);
  if (!copies) return copies.error();
  auto detail = choose_detail(job, std::move(*copies));
  if (!detail) return detail.error();
  if (job.options.on_large_plan && detail->stats.triangles > kLargeTriangles)
    if (const auto planned = plan_detail(job, *detail)) job.options.on_large_plan(*planned);
  const cutoff::CutoffEstimate endings = estimate_endings(job, *detail);
  auto appearance = make_appearance(job, *detail, endings);
  if (!appearance) return appearance.error();
  DrawList list = draw_list(job, std::move(detail->copies), *detail, *appearance);
  if (&job.scene != &job.lit_scene) list = split_emissive_copies(job.scene.interior(), std::move(list));
  if (auto too_large = check_memory(job, *detail, list); !too_large.empty()) return too_large;
  if (job.options.by_object) list = split_by_object(job.scene.interior(), appearance->panels, std::move(list));
  auto bent = bend::bend(job.scene.interior(), {list.copies, list.models, list.model_of_copy}, job.eye, detail->bending, job.run.executor,
                         job.run.progress);
  if (!bent) return bent.error();
  if (auto over_budget = check_budget(job, bent->indices.size() / 3); !over_budget.empty()) return over_budget;
  return Drawing{std::move(*detail), endings, std::move(*appearance), std::move(list), std::move(*bent)};
}

}  // namespace

Result<Compiled> compile(const PreparedScene& scene, const place::Camera& eye, const CompileOptions& asked, const Executor& executor,
                         const Progress& progress) {
  const CompileOptions options = with_rays(asked, scene.scene(), eye);
  if (native_lights::uses_native_lights(scene.scene()) && options.bend.view != bend::View::eye)
    return make_error("driver.native-view",
                      "lamps of the renderer's own hang where one eye sees them along geodesics: --view disk and straight rays have none",
                      "bake the light (`lights: baked`), or leave out --view disk or `rays: straight`", scene.scene().span);
  if (auto unsupported = unsupported_features(scene, eye, asked.bend.view); !unsupported.empty()) return unsupported;
  const Job job{scene.drawn_scene(), scene, eye, scene.scene().cover, options, {executor, progress}};
  auto drawing = draw(job);
  if (!drawing) return with_bounces_that_fit(drawing.error(), job);
  return assemble(job, std::move(*drawing));
}

Result<Compiled> compile(const LoadedScene& scene, const CompileOptions& options, const Executor& executor, const Progress& progress) {
  return compile(PreparedScene(scene), scene.eye, options, executor, progress);
}

}  // namespace orbc::driver
