#include "compiler/driver/assemble.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>

#include "compiler/driver/dimmed_triangles.h"
#include "compiler/driver/renderer_scale.h"
#include "compiler/driver/unit_of_length.h"
#include "compiler/native_lights/lamps.h"
#include "compiler/native_lights/split.h"
#include "compiler/notation/print.h"
#include "compiler/place/alpha_mask.h"

namespace orbc::driver {
namespace {

// The room's centre is the origin of its coordinates.
double distance_to(const cover::Copy& copy, const place::Camera& eye) {
  const geometry::Space space = eye.room_from_eye.space;
  return geometry::distance(space, copy.cover_from_room * geometry::Point(), eye.room_from_eye * geometry::Point());
}

std::vector<ProductCopy> product_copies(const DrawList& list, const std::vector<bend::BentRange>& ranges, const place::Camera& eye) {
  std::vector<ProductCopy> copies;
  copies.reserve(list.copies.size());
  for (std::size_t i = 0; i < list.copies.size(); ++i) {
    const cover::Copy& c = list.copies[i];
    const bend::BentRange& r = ranges[i];
    ProductCopy copy{r.first_vertex,
                     r.vertex_count,
                     r.first_index,
                     r.index_count,
                     c.weight,
                     c.word,
                     c.bounces,
                     c.sheet,
                     c.cover_from_room.reversing,
                     distance_to(c, eye),
                     c.storey.number,
                     list.level_of_copy[i],
                     c.wedge,
                     list.shading[i]};
    if (!list.objects.empty()) {
      copy.object = list.object_of_copy[i];
      if (list.original_of_copy[i] != i) copy.duplicate_of = list.original_of_copy[i];
    }
    copies.push_back(std::move(copy));
  }
  return copies;
}

Product product_of(const Job& job, Drawing& drawing) {
  const scene::Scene& scene = job.lit_scene.scene();
  Product product;
  product.title = notation::to_text(scene.orbifold);
  product.eye = job.eye;
  product.background = scene.cover.background;
  product.atlas = std::move(drawing.appearance.image);
  product.atlas16 = std::move(drawing.appearance.image16);
  product.depth = scene.bake.atlas;
  product.masked = place::has_alpha_mask(job.lit_scene.interior());
  product.bilinear_atlas = job.scene.is_baked();
  product.copies = product_copies(drawing.list, drawing.bent.copies, job.eye);
  product.objects = drawing.list.objects;
  product.positions = std::move(drawing.bent.positions);
  product.uv = std::move(drawing.bent.uv);
  product.indices = std::move(drawing.bent.indices);
  product.disk_view = job.options.bend.view == bend::View::disk;
  product.chart_scale = job.options.bend.chart_scale;
  return product;
}

/// The lamps of the drawn copies.
Result<native_lights::NativeLights> native_lights_of(const Job& job, const DrawList& list) {
  const PreparedScene& scene = job.lit_scene;
  std::vector<std::size_t> lit_copies;
  for (std::size_t i = 0; i < list.copies.size(); ++i)
    if (list.shading[i] == native_lights::Shading::lit && (list.objects.empty() || list.original_of_copy[i] == i)) lit_copies.push_back(i);
  const light::LampSet& lamps = *scene.loaded().lamps;
  return native_lights::place_native_lights({scene.scene(), scene.interior(), job.eye, lamps.lamps, lamps.images}, list.copies, lit_copies);
}

LodSummary lod_summary(const lod::InteriorWithLods& lods, std::size_t part, double unit) {
  LodSummary summary{lods.interior.parts[part].name, {}, {}};
  for (const std::uint32_t level : lods.part_of_level[part]) {
    summary.triangles.push_back(lods.interior.parts[level].triangles.size());
    summary.surface_offset.push_back(lods.surface_offset[level] / unit);
  }
  return summary;
}

Report report_of(const Job& job, const Drawing& drawing, const Product& product) {
  const Detail& detail = drawing.detail;
  Report r;
  r.copies = static_cast<std::uint64_t>(std::count_if(product.copies.begin(), product.copies.end(), is_listed));
  r.vertices = product.positions.size();
  r.triangles = product.indices.size() / 3;
  r.triangles_at_full_detail = r.triangles + detail.stats.triangles_saved;
  r.error_bound_px = drawing.bent.error_bound_px + detail.selection.error_px;
  r.tolerance_px = kToleranceShares * detail.bending.tolerance_px;
  r.culled = detail.culled;
  r.cull_px = detail.cull_px;
  r.impostors = drawing.list.impostors;
  r.impostors_dropped = detail.impostors_dropped;
  r.weight_lost = drawing.endings.weight_lost;
  r.weight_culled = drawing.endings.weight_culled;
  r.highlights = drawing.appearance.view_counts;
  std::set<std::string> words;
  for (const ProductCopy& copy : product.copies) {
    if (!is_listed(copy)) continue;
    words.insert(cover::to_string(copy.word));
    r.beams += copy.wedge ? 1 : 0;
    r.longest_word = std::max(r.longest_word, static_cast<int>(copy.word.size()));
  }
  r.words = words.size();
  const lod::InteriorWithLods& lods = job.scene.lods(job.run);
  for (std::size_t p = 0; p < room_part_count(lods); ++p)
    if (lods.part_of_level[p].size() > 1) r.lods.push_back(lod_summary(lods, p, job.scene.loaded().unit_of_length));
  return r;
}

Diagnostics notes_of(const Job& job, const Detail& detail) {
  Diagnostics notes;
  if (job.eye.lens && job.options.bend.view == bend::View::eye)
    notes.push_back(make_warning("driver.no-lens",
                                 "exports belong to a pinhole: everything is sharp in them, the camera's lens is left out",
                                 "draw it with the tracer (`orbc trace`)", job.lit_scene.scene().camera.lens->radius_span));
  const std::string budget = fmt::format("--max-triangles {}", job.options.budget.value_or(0));
  if (detail.culled > 0)
    notes.push_back(make_warning(
        "driver.copies-left-out",
        fmt::format("{} leaves out {} copies that are smaller than {:.3g} px in the picture", budget, detail.culled, detail.cull_px),
        "allow more triangles, or lower cover.max_bounces"));
  if (detail.impostors_dropped)
    notes.push_back(
        make_warning("driver.no-curtains",
                     fmt::format("{} has no room for the panels that hide what is not drawn: the background is seen there", budget),
                     "allow more triangles"));
  return located(std::move(notes), job.lit_scene.scene().span);
}

void add_notes(Diagnostics& notes, const Diagnostics& more) { notes.insert(notes.end(), more.begin(), more.end()); }

}  // namespace

Result<Compiled> assemble(const Job& job, Drawing drawing) {
  Compiled compiled;
  compiled.notes = notes_of(job, drawing.detail);
  std::optional<native_lights::NativeLight> native;
  std::vector<std::array<float, 3>> normals;
  if (&job.lit_scene != &job.scene) {
    auto lights = native_lights_of(job, drawing.list);
    if (!lights) return lights.error();
    add_notes(compiled.notes, lights->warnings);
    native = std::move(lights->light);
    native_lights::CoverWithNormals shaded = native_lights::with_normals(std::move(drawing.bent), job.run.executor);
    drawing.bent = std::move(shaded.cover);
    normals = std::move(shaded.normals);
  }
  compiled.product = split_dimmed_triangles(product_of(job, drawing), drawing.appearance.first_dimmed_v);
  compiled.product.native = std::move(native);
  compiled.product.normals = std::move(normals);
  compiled.product = in_author_unit(std::move(compiled.product), job.scene.loaded().unit_of_length);
  add_notes(compiled.notes, located(scale_for_renderers(compiled.product), job.lit_scene.scene().camera.span));
  compiled.report = report_of(job, drawing, compiled.product);
  return compiled;
}

}  // namespace orbc::driver
