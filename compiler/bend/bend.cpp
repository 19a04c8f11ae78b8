// Two passes over the copies: the first counts what each needs, the second writes everything at its place. So the bytes do not depend on
// the order of execution. Most parts of most copies need no split: error_bound finds that from distances alone, and they go straight
// through the vector kernel.
#include "compiler/bend/bend.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <memory>

#include "compiler/bend/clip.h"
#include "compiler/bend/clip_in_eye_space.h"
#include "compiler/bend/screen_metric.h"
#include "compiler/bend/tessellate.h"

namespace orbc::bend {
namespace {

using geometry::Isometry;

constexpr std::uint64_t kMaxVertices = 0xffffffff;  // indices are of 32 bits

/// A part of a model, with the index of its mesh in BendContext::meshes.
struct ModelPart {
  std::size_t mesh = 0;
  const Uv* uv = nullptr;
  bool unsplit = false;
};

/// Input and prepared data that all copies share.
struct BendContext {
  DrawList list;
  std::vector<EdgeMesh> meshes;  // every mesh of the models, once
  std::vector<std::vector<ModelPart>> models;
  std::map<int, std::vector<std::unique_ptr<ClippedPart>>> storeys;  // by number, other than 0: the meshes that are drawn there
  Isometry eye_from_cover, eye_from_room;
  ScreenMetric metric;
  BendOptions options;
  double margin = 0;  // radians by which wedges are enlarged before bending
};

/// The size and the error of one bent copy.
struct CopyTotals {
  std::size_t vertices = 0, triangles = 0;
  double max_error = 0;
  bool too_many = false;
  std::vector<std::vector<bool>> decisions;  // Tessellation::decisions of each part that is split
};

/// Whether colours change inside of a mesh's triangles. Checkered panels are cut along their cells, whose colours are flat; a checkered
/// object has a solid pattern.
bool colors_vary(const place::Interior& room, const place::PlacedMesh& mesh) {
  std::uint16_t last = 0xffff;
  for (const std::uint16_t i : mesh.style) {
    if (i == last || i >= room.styles.size()) continue;
    last = i;
    const auto pattern = room.styles[i].material.pattern;
    if (room.styles[i].texture >= 0 ||
        (pattern != scene::Pattern::plain && (pattern != scene::Pattern::checker || mesh.kind == place::PartKind::object))) {
      return true;
    }
  }
  return false;
}

const std::vector<ModelPart>& model_of(const BendContext& context, std::size_t copy) {
  return context.models[context.list.model_of_copy.empty() ? 0 : context.list.model_of_copy[copy]];
}

CopyMap copy_map(const BendContext& context, const cover::Copy& copy) {
  const Isometry eye_from_copy = context.eye_from_cover * copy.cover_from_room;
  return {context.options.view, {eye_from_copy.space, geometry::matrix(eye_from_copy), copy.sheet}, context.options.chart_scale};
}

/// A wall belongs to two copies: the one whose wall does not face the eye draws it. The charts of View::disk have no sheets.
bool is_drawn(const BendContext& context, const place::PlacedMesh& mesh, const cover::Copy& copy) {
  if (context.options.view == View::disk && copy.sheet > 0) return false;
  return mesh.kind != place::PartKind::wall || !cover::faces_eye(copy, mesh.wall);
}

/// A part as one copy draws it.
struct CopyPart {
  const EdgeMesh* part = nullptr;
  const Uv* uv = nullptr;
  bool unsplit = false;
};

/// The parts of one copy, on its storey and clipped to its wedge. Every pass makes them anew, with the same result.
class CopyParts {
 public:
  CopyParts(const BendContext& context, std::size_t index) {
    const cover::Copy& copy = context.list.copies[index];
    const auto storey = context.storeys.find(copy.storey.number);
    // Wedges belong to the eye, also for View::disk.
    const LogMap eye_map{context.eye_from_room.space, geometry::matrix(context.eye_from_room * copy.cover_from_room), copy.sheet};
    for (const ModelPart& part : model_of(context, index)) {
      const EdgeMesh& whole = storey == context.storeys.end() ? context.meshes[part.mesh] : storey->second[part.mesh]->part;
      if (!is_drawn(context, *whole.mesh, copy)) continue;
      const WedgeOverlap overlap = copy.wedge ? wedge_overlap(*copy.wedge, eye_map, whole, context.margin) : WedgeOverlap::inside;
      if (overlap == WedgeOverlap::inside) parts_.push_back({&whole, part.uv, part.unsplit});
      if (overlap != WedgeOverlap::partial) continue;
      clipped_.push_back(context.options.view == View::eye ? triangles_touching(*copy.wedge, eye_map, whole, *part.uv, context.margin)
                                                           : clipped(*copy.wedge, eye_map, whole, *part.uv));
      const ClippedPart& own = *clipped_.back();
      if (!own.mesh.triangles.empty()) parts_.push_back({&own.part, &own.uv, part.unsplit});
    }
  }
  [[nodiscard]] auto begin() const { return parts_.begin(); }
  [[nodiscard]] auto end() const { return parts_.end(); }

 private:
  std::vector<std::unique_ptr<ClippedPart>> clipped_;
  std::vector<CopyPart> parts_;
};

CopyTotals count_copy(const BendContext& context, const ScreenMetric& metric, std::size_t index) {
  CopyTotals totals;
  const CopyMap map = copy_map(context, context.list.copies[index]);
  for (const CopyPart& part : CopyParts(context, index)) {
    totals.vertices += part.part->points.w.size();
    const double bound = part.unsplit ? 0 : error_bound(map, metric, *part.part);
    if (bound <= 1) {
      totals.triangles += part.part->mesh->triangles.size();
      totals.max_error = std::max(totals.max_error, bound);
      continue;
    }
    Tessellation fine = tessellate(map, metric, *part.part, *part.uv, context.options.max_triangles);
    totals.vertices += fine.vertices.size();
    totals.triangles += fine.triangles.size();
    totals.max_error = std::max(totals.max_error, fine.max_error);
    totals.too_many |= fine.too_many;
    totals.decisions.push_back(std::move(fine.decisions));
  }
  return totals;
}

/// Writes one copy. Invariant: the next vertex and the next index lie within the copy's range.
class CopyWriter {
 public:
  CopyWriter(const BendContext& context, std::size_t copy_index, BentCover& out)
      : context_(context),
        map_(copy_map(context, context.list.copies[copy_index])),
        copy_index_(copy_index),
        out_(out),
        vertex_(out.copies[copy_index].first_vertex),
        index_(out.copies[copy_index].first_index) {
    const cover::Copy& copy = context.list.copies[copy_index];
    // An odd number of reflections reverses triangles, and so does the way around the sphere to the far side.
    reversed_ = (copy.cover_from_room.reversing != (copy.sheet % 2 == 1)) != (copy.storey.sign < 0);
  }

  void run(const std::vector<std::vector<bool>>& decisions) {
    std::size_t split = 0;
    for (const auto& [part, uv, unsplit] : CopyParts(context_, copy_index_)) {
      if (unsplit || error_bound(map_, context_.metric, *part) <= 1) {
        write_points(part->points, 0);
        write_uv(*uv);
        write_triangles(part->mesh->triangles);
        vertex_ += part->points.w.size();
      } else {
        write_split(*part, *uv, replay_tessellation(map_, context_.metric, *part, *uv, decisions[split++]));
      }
    }
    const BentRange& range = out_.copies[copy_index_];
    ORBC_CHECK(vertex_, ==, range.first_vertex + range.vertex_count);
    ORBC_CHECK(index_, ==, range.first_index + range.index_count);
  }

 private:
  void write_points(const PointColumns& points, std::size_t offset) {
    if (points.w.empty()) return;
    float* to = out_.positions[vertex_ + offset].data();
    if (context_.options.view == View::eye) return bend_points(map_.log, points, 0, points.w.size(), to);
    for (std::size_t i = 0; i < points.w.size(); ++i, to += 3) {
      const auto p = image_of(map_, {points.w[i], points.x[i], points.y[i]}, points.z[i]);
      to[0] = static_cast<float>(p.x);
      to[1] = static_cast<float>(p.y);
      to[2] = static_cast<float>(p.z);
    }
  }

  void write_uv(const Uv& uv) { std::copy(uv.begin(), uv.end(), out_.uv.begin() + static_cast<std::ptrdiff_t>(vertex_)); }

  void write_triangles(const std::vector<mesh::Triangle>& triangles) {
    const auto base = static_cast<std::uint32_t>(vertex_);
    std::uint32_t* to = out_.indices.data() + index_;
    const int second = reversed_ ? 2 : 1, third = 3 - second;
    for (const auto& t : triangles) {
      *to++ = base + t[0];
      *to++ = base + t[second];
      *to++ = base + t[third];
    }
    index_ += 3 * triangles.size();
  }

  void write_split(const EdgeMesh& part, const Uv& uv, const Tessellation& fine) {
    const std::size_t base = part.points.w.size();
    write_points(part.points, 0);
    write_uv(uv);
    // New vertices go through the same kernel as old ones, so that equal points get equal bits.
    PointColumns points;
    for (const NewVertex& v : fine.vertices) {
      const auto p = geometry::normalised_point(map_.log.space, v.v);
      points.w.push_back(p.w);
      points.x.push_back(p.x);
      points.y.push_back(p.y);
      points.z.push_back(static_cast<float>(v.z));
    }
    write_points(points, base);
    for (std::size_t i = 0; i < fine.vertices.size(); ++i) {
      const NewVertex& v = fine.vertices[i];
      const std::size_t at = vertex_ + base + i;
      out_.uv[at] = {static_cast<float>(v.uv[0]), static_cast<float>(v.uv[1])};
      if (v.on_circle) out_.positions[at] = {static_cast<float>(v.image.x), static_cast<float>(v.image.y), static_cast<float>(v.image.z)};
    }
    write_triangles(fine.triangles);
    vertex_ += base + fine.vertices.size();
  }

  const BendContext& context_;
  CopyMap map_;
  std::size_t copy_index_;
  BentCover& out_;
  std::size_t vertex_, index_;
  bool reversed_ = false;
};

/// Runs `task` for all copies in batches, so that the calling thread reports progress.
void for_copies(std::size_t count, const Executor& executor, const Progress& progress, const char* stage,
                const std::function<void(std::size_t)>& task) {
  const std::size_t batch = std::max<std::size_t>(64, count / 50);
  for (std::size_t from = 0; from < count; from += batch) {
    report(progress, stage, from, count, "copies");
    executor(std::min(batch, count - from), [&](std::size_t i) { task(from + i); });
  }
  report(progress, stage, count, count, "copies");
}

struct BendTotals {
  std::vector<CopyTotals> copies;
  std::uint64_t vertices = 0, triangles = 0;
  bool fits = true;
};

BendTotals count_all(const BendContext& context, const ScreenMetric& metric, const Executor& executor, const Progress& progress) {
  BendTotals totals;
  totals.copies.resize(context.list.copies.size());
  std::atomic<std::uint64_t> so_far{0};
  const std::uint64_t max_triangles = context.options.max_triangles;
  for_copies(totals.copies.size(), executor, progress, "splitting", [&](std::size_t i) {
    if (so_far.load(std::memory_order_relaxed) > max_triangles) return;
    totals.copies[i] = count_copy(context, metric, i);
    so_far.fetch_add(totals.copies[i].triangles, std::memory_order_relaxed);
  });
  for (const CopyTotals& copy : totals.copies) {
    totals.vertices += copy.vertices;
    totals.triangles += copy.triangles;
    totals.fits &= !copy.too_many;
  }
  totals.fits &= so_far.load() <= max_triangles && totals.vertices < kMaxVertices;
  return totals;
}

/// The diagnostic of a scene that is too dense, with a tolerance that was tried and fits.
Diagnostic too_dense(const BendContext& context, const Executor& executor) {
  const bool disk = context.options.view == View::disk && !context.options.chart_eye;
  const double asked = context.metric.tolerance, named = disk ? asked : context.options.message_factor * context.options.tolerance_px;
  std::uint64_t unsplit = 0;
  for (std::size_t i = 0; i < context.list.copies.size(); ++i) {
    for (const CopyPart& part : CopyParts(context, i)) unsplit += part.part->mesh->triangles.size();
  }
  const std::string message = "bending " + std::to_string(context.list.copies.size()) + " copies needs more than " +
                              std::to_string(context.options.max_triangles) + " triangles";
  if (context.options.advise && unsplit <= context.options.max_triangles) {
    ScreenMetric metric = context.metric;
    for (double factor = 4; factor < 2e6; factor *= 4) {
      metric.tolerance = asked * factor;
      if (!count_all(context, metric, executor, {}).fits) continue;
      return make_error("bend.too-dense", message + fmt::format(" at a tolerance of {:g}{}", named, disk ? "" : " px"),
                        fmt::format("a tolerance of {:g}{} fits", named * factor, disk ? "" : " px"));
    }
  }
  return make_error("bend.too-dense", message + fmt::format(" (without any split {})", unsplit),
                    "lower cover.max_bounces, or raise cover.min_pixels or cover.min_weight");
}

BendContext make_context(const place::Interior& room, const DrawList& list, const place::Camera& eye, const BendOptions& options,
                         const Executor& executor) {
  BendContext context;
  context.list = list;
  context.options = options;
  context.metric = screen_metric(eye, options);
  context.eye_from_room = inverse(eye.room_from_eye);
  context.eye_from_cover = options.view == View::eye ? context.eye_from_room : geometry::identity(room.polygon.space);
  // Chords outside of the picture may be off by several tolerances.
  context.margin = options.view == View::eye ? 0.01 + 2 * kOffscreenFactor * options.tolerance_px / context.metric.pixels : 0;
  std::map<const place::PlacedMesh*, std::size_t> known;  // never iterated: its order depends on addresses
  std::vector<const place::PlacedMesh*> meshes;
  for (const Model& model : list.models) {
    context.models.emplace_back();
    for (const Model::Part& part : model.parts) {
      ORBC_CHECK(part.uv->size(), ==, part.mesh->floor.size());
      const auto [at, is_new] = known.try_emplace(part.mesh, meshes.size());
      if (is_new) meshes.push_back(part.mesh);
      context.models.back().push_back({at->second, part.uv, part.unsplit});
    }
  }
  context.meshes.resize(meshes.size());
  executor(meshes.size(), [&](std::size_t i) {
    const bool vary = options.colors_vary || colors_vary(room, *meshes[i]);
    context.meshes[i] = edge_mesh(room.polygon.space, *meshes[i], vary ? options.color_tolerance : 0);
  });
  for (std::size_t i = 0; i < list.copies.size(); ++i) {
    const cover::Storey& storey = list.copies[i].storey;
    if (storey.number == 0) continue;
    auto& parts = context.storeys[storey.number];
    parts.resize(context.meshes.size());
    for (const ModelPart& part : model_of(context, i))
      if (!parts[part.mesh]) parts[part.mesh] = on_storey(storey, room.polygon.space, context.meshes[part.mesh]);
  }
  return context;
}

/// A cover with all its arrays in their final size, and the ranges of its copies.
BentCover allocated(const BendTotals& totals, double tolerance) {
  BentCover cover;
  cover.copies.reserve(totals.copies.size());
  BentRange next;
  double max_error = 0;
  for (const CopyTotals& copy : totals.copies) {
    next.vertex_count = copy.vertices;
    next.index_count = 3 * copy.triangles;
    cover.copies.push_back(next);
    next.first_vertex += next.vertex_count;
    next.first_index += next.index_count;
    max_error = std::max(max_error, copy.max_error);
    cover.split_parts += copy.decisions.size();
  }
  cover.error_bound_px = max_error * tolerance;
  cover.positions.resize(totals.vertices);
  cover.uv.resize(totals.vertices);
  cover.indices.resize(3 * totals.triangles);
  return cover;
}

}  // namespace

Model whole_model(const place::Interior& room, const std::vector<Uv>& uv) {
  ORBC_CHECK(uv.size(), ==, room.parts.size());
  Model model;
  for (std::size_t i = 0; i < uv.size(); ++i) model.parts.push_back({&room.parts[i], &uv[i]});
  return model;
}

Result<BentCover> bend(const place::Interior& room, const DrawList& list, const place::Camera& eye, const BendOptions& options,
                       const Executor& executor, const Progress& progress) {
  ORBC_CHECK(options.tolerance_px, >, 0);
  ORBC_CHECK(options.disk_tolerance, >, 0);
  ORBC_CHECK(options.color_tolerance, >, 0);
  if (!list.model_of_copy.empty()) ORBC_CHECK(list.model_of_copy.size(), ==, list.copies.size());
  for (const std::uint32_t model : list.model_of_copy) ORBC_CHECK(model, <, list.models.size());
  const BendContext context = make_context(room, list, eye, options, executor);
  BendTotals totals = count_all(context, context.metric, executor, progress);
  if (!totals.fits) return too_dense(context, executor);
  BentCover cover = allocated(totals, options.chart_eye ? options.tolerance_px : context.metric.tolerance);
  for_copies(list.copies.size(), executor, progress, "bending", [&](std::size_t i) {
    CopyWriter(context, i, cover).run(totals.copies[i].decisions);
    std::vector<std::vector<bool>>().swap(totals.copies[i].decisions);
  });
  if (options.view == View::eye) cover = clip_in_eye_space(std::move(cover), list.copies, eye, options.tolerance_px, executor);
  // Clipping may add triangles, but hardly ever does: it removes most of what it meets.
  if (cover.indices.size() / 3 > options.max_triangles || cover.positions.size() >= kMaxVertices) return too_dense(context, executor);
  return cover;
}

}  // namespace orbc::bend
