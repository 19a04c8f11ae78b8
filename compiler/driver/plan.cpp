#include "compiler/driver/plan.h"

#include <algorithm>
#include <utility>

#include "compiler/driver/fitting_bounces.h"
#include "compiler/driver/straight.h"
#include "compiler/lod/estimate.h"

namespace orbc::driver {
namespace {

constexpr double kEstimateError = 1.2;  // of lod::estimate, a factor
constexpr double kSplitFactor = 32;     // splitting multiplies triangles by less

/// Estimates the product from a sample of its copies.
/// Diagnostics: cover.too-much when it exceeds half of the memory allowed.
Result<cover::Plan> estimate_product(const Job& job, const Detail& detail, const DrawList& list) {
  const auto bend_some = [&](const std::vector<std::size_t>& sample) {
    std::vector<cover::Copy> copies;
    std::vector<std::uint32_t> models;
    for (const std::size_t i : sample) {
      copies.push_back(list.copies[i]);
      models.push_back(list.model_of_copy[i]);
    }
    return bend::bend(job.scene.interior(), {copies, list.models, models}, job.eye, detail.bending, job.run.executor);
  };
  cover::Contents contents{&job.scene.interior(), {}, list.model_of_copy};
  for (const bend::Model& model : list.models) {
    contents.models.emplace_back();
    for (const bend::Model::Part& part : model.parts) contents.models.back().push_back(part.mesh);
  }
  return lod::estimate(contents, job.eye, list.copies, bend_some, {job.cover.max_bounces, job.options.max_memory / 2});
}

Result<cover::Plan> plan_job(const Job& job) {
  auto copies = unfold_within_memory(job);
  if (!copies) return copies.error();
  const auto detail = choose_detail(job, std::move(*copies));
  if (!detail) return detail.error();
  return plan_detail(job, *detail);
}

/// Whether the product may exceed half of the memory allowed.
bool may_exceed_memory(const Job& job, const Detail& detail, std::size_t copy_count) {
  const auto triangles = static_cast<double>(detail.stats.triangles), copies = static_cast<double>(copy_count);
  // A closed surface has half as many vertices as triangles, and some more where styles meet.
  const double bytes = triangles * (cover::kBytesPerTriangle + cover::kBytesPerVertex) + copies * cover::kBytesPerCopy;
  return kSplitFactor * bytes > static_cast<double>(job.options.max_memory) / 2;
}

}  // namespace

Diagnostics unsupported_features(const PreparedScene& scene, const place::Camera& eye, bend::View view) {
  if (eye.projection == scene::Projection::stereo && view == bend::View::eye)
    return {make_error("driver.stereo-export",
                       "an export is bent for one eye, and a stereo panorama has two, which move from column to column",
                       "draw it with the tracer (`orbc trace`), or export `--projection panorama`", scene.scene().camera.span)};
  const std::vector<place::PlacedMirror>& mirrors = scene.interior().mirrors;
  if (std::none_of(mirrors.begin(), mirrors.end(), [](const place::PlacedMirror& m) { return !(m.emission == scene::Color{}); })) return {};
  return located({make_error("driver.glowing-mirror", "a mirror that glows adds light to all that is seen in it: exports can only multiply",
                             "leave out `glow`, or draw the scene with the tracer (`orbc trace`)")},
                 scene.scene().span);
}

Result<cover::Plan> plan_detail(const Job& job, const Detail& detail) {
  const auto appearance = without_colors(job, detail);
  if (!appearance) return appearance.error();
  return estimate_product(job, detail, draw_list(job, detail.copies, detail, *appearance));
}

Diagnostics check_memory(const Job& job, const Detail& detail, const DrawList& list) {
  if (!may_exceed_memory(job, detail, list.copies.size())) return {};
  const auto planned = estimate_product(job, detail, list);
  return planned ? Diagnostics{} : planned.error();
}

Diagnostics with_bounces_that_fit(Diagnostics errors, const Job& job) {
  const auto fits = [&](int bounces) {
    Job fewer = job;
    fewer.cover.max_bounces = bounces;
    const auto planned = plan_job(fewer);
    return planned && kEstimateError * static_cast<double>(planned->triangles) <= static_cast<double>(job.options.bend.max_triangles);
  };
  return located(with_fitting_bounces(std::move(errors), job.cover.max_bounces, fits), job.lit_scene.scene().span);
}

Result<cover::Plan> plan(const PreparedScene& scene, const place::Camera& eye, const CompileOptions& asked, const Executor& executor) {
  const CompileOptions options = with_rays(asked, scene.scene(), eye);
  if (auto unsupported = unsupported_features(scene, eye, asked.bend.view); !unsupported.empty()) return unsupported;
  const Progress silent;
  const Job job{scene.drawn_scene(), scene, eye, scene.scene().cover, options, {executor, silent}};
  auto planned = plan_job(job);
  if (!planned) return with_bounces_that_fit(planned.error(), job);
  return planned;
}

Result<cover::Plan> plan(const LoadedScene& scene, const CompileOptions& options, const Executor& executor) {
  return plan(PreparedScene(scene), scene.eye, options, executor);
}

}  // namespace orbc::driver
