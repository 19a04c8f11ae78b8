// Two passes over the copies: what will come out of each, then everything at its place; so the bytes do not depend on who runs when.
// Most parts of most copies need no split: a bound from distances alone (part_net.cpp) sends them straight through the vector kernel.
#include "compiler/bend/bend.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <memory>

#include "compiler/bend/clip.h"
#include "compiler/bend/cut_as_seen.h"
#include "compiler/bend/log_map.h"
#include "compiler/bend/sight.h"
#include "compiler/bend/tessellate.h"

namespace orbc::bend {
namespace {

using geometry::Isometry;

/// A part of a model: a net and its uv.
struct ModelPart {
  std::size_t net = 0;
  const Uv* uv = nullptr;
  bool flat = false;
};

/// What is the same for all copies.
struct Work {
  const std::vector<cover::Copy>& copies;
  const std::vector<std::uint32_t>& model_of_copy;
  std::vector<PartNet> nets;                                      // of each mesh once
  std::vector<std::vector<ModelPart>> models;
  // By number; those above and below the room's own; nets that are used there
  std::map<int, std::vector<std::unique_ptr<OwnPart>>> storeys;
  Isometry eye_from_cover, eye_from_room;
  Sight sight;
  BendOptions options;
  double margin = 0;                                              // radians beyond the border of a wedge that count
};

/// What one copy takes, and how wrong it is.
struct CopyCount {
  std::size_t vertices = 0, triangles = 0;
  double worst = 0;
  bool too_many = false;
  std::vector<std::vector<bool>> decisions;   ///< Tessellation::decisions of each part that is split: the second pass judges nothing
};

bool colours_vary(const place::PlacedRoom& room, const place::PlacedMesh& mesh) {
  std::uint16_t last = 0xffff;
  for (const std::uint16_t i : mesh.look) {
    if (i == last || i >= room.looks.size()) continue;
    last = i;
    const auto pattern = room.looks[i].material.pattern;
    // Chequered panels are cut along their cells (flat colours); a chequered object is a solid pattern.
    if (room.looks[i].texture >= 0 ||
        (pattern != scene::Pattern::plain && (pattern != scene::Pattern::checker || mesh.kind == place::PartKind::object))) {
      return true;
    }
  }
  return false;
}

const std::vector<ModelPart>& model_of(const Work& work, std::size_t copy) {
  return work.models[work.model_of_copy.empty() ? 0 : work.model_of_copy[copy]];
}

CopyMap copy_map(const Work& work, const cover::Copy& copy) {
  const Isometry eye_from_copy = work.eye_from_cover * copy.cover_from_room;
  return {work.options.view, {eye_from_copy.space, geometry::matrix(eye_from_copy), copy.sheet}};
}

/// A wall belongs to two copies; the one from which it lies beyond draws it. The charts of View::disk know no sheets.
bool is_drawn(const Work& work, const PartNet& net, const cover::Copy& copy) {
  if (work.options.view == View::disk && copy.sheet > 0) return false;
  const int wall = net.mesh->wall;
  return net.mesh->kind != place::PartKind::wall || wall < 0 || wall >= 64 || !((copy.nearer_walls >> wall) & 1);
}

/// The parts of one copy: those of its storey, cut to its wedge. Made anew for each pass, which gives the same.
struct CopyPart {
  const PartNet* net = nullptr;
  const Uv* uv = nullptr;
  bool flat = false;
};
class CopyParts {
 public:
  CopyParts(const Work& work, std::size_t index) {
    const cover::Copy& copy = work.copies[index];
    const auto storey = work.storeys.find(copy.storey.number);
    // Wedges are seen from the eye, whatever the view.
    const LogMap seen{work.eye_from_room.space, geometry::matrix(work.eye_from_room * copy.cover_from_room), copy.sheet};
    for (const ModelPart& part : model_of(work, index)) {
      const PartNet& net = storey == work.storeys.end() ? work.nets[part.net] : storey->second[part.net]->net;
      if (!is_drawn(work, net, copy)) continue;
      const InWedge place = copy.wedge ? place_in(*copy.wedge, seen, net, work.margin) : InWedge::all;
      if (place == InWedge::all) parts_.push_back({&net, part.uv, part.flat});
      if (place != InWedge::some) continue;
      // For the eye what is split alike on both sides of a wall is cut at last (cut_as_seen.h).
      own_.push_back(work.options.view == View::eye ? reaching(*copy.wedge, seen, net, *part.uv, work.margin)
                                                    : clipped(*copy.wedge, seen, net, *part.uv));
      if (!own_.back()->mesh.triangles.empty()) parts_.push_back({&own_.back()->net, &own_.back()->uv, part.flat});
    }
  }
  [[nodiscard]] auto begin() const { return parts_.begin(); }
  [[nodiscard]] auto end() const { return parts_.end(); }

 private:
  std::vector<std::unique_ptr<OwnPart>> own_;
  std::vector<CopyPart> parts_;
};

CopyCount count_copy(const Work& work, std::size_t index, std::uint64_t most) {
  CopyCount count;
  const CopyMap map = copy_map(work, work.copies[index]);
  for (const auto& [part, uv, flat] : CopyParts(work, index)) {
    const PartNet& net = *part;
    count.vertices += net.points.w.size();
    const double bound = flat ? 0 : error_bound(map, work.sight, net);
    if (bound <= 1) {
      count.triangles += net.mesh->triangles.size();
      count.worst = std::max(count.worst, bound);
      continue;
    }
    Tessellation fine = tessellate(map, work.sight, net, *uv, most);
    count.vertices += fine.vertices.size();
    count.triangles += fine.triangles.size();
    count.worst = std::max(count.worst, fine.worst);
    count.too_many |= fine.too_many;
    count.decisions.push_back(std::move(fine.decisions));
  }
  return count;
}

/// Writes the pieces of one copy at their places.
class Writer {
 public:
  Writer(const Work& work, std::size_t copy_index, const BentRange& range, const std::vector<std::vector<bool>>& decisions,
         BentCover& out)
      : work_(work), map_(copy_map(work, work.copies[copy_index])), out_(out), vertex_(range.first_vertex), index_(range.first_index) {
    const cover::Copy& copy = work.copies[copy_index];
    // An odd number of reflections turns triangles inside out, and so does going round the sphere to the far side.
    turned_ = (copy.cover_from_room.reversing != (copy.sheet % 2 == 1)) != (copy.storey.sign < 0);
    std::size_t split = 0;
    for (const auto& [part, uv, flat] : CopyParts(work, copy_index)) {
      const PartNet& net = *part;
      if (flat || error_bound(map_, work.sight, net) <= 1) {
        write_points(net.points);
        write_uv(*uv);
        write_triangles(net.mesh->triangles);
        vertex_ += net.points.w.size();
      } else {
        write_fine(net, *uv, tessellate_again(map_, work.sight, net, *uv, decisions[split++]));
      }
    }
    ORBC_CHECK(vertex_, ==, range.first_vertex + range.vertex_count);
    ORBC_CHECK(index_, ==, range.first_index + range.index_count);
  }

 private:
  void write_points(const PointColumns& points, std::size_t offset = 0) {
    if (points.w.empty()) return;
    float* to = out_.positions[vertex_ + offset].data();
    if (work_.options.view == View::eye) return bend_points(map_.log, points, 0, points.w.size(), to);
    for (std::size_t i = 0; i < points.w.size(); ++i, to += 3) {
      const auto p = image_of(map_, {points.w[i], points.x[i], points.y[i]}, points.z[i]);
      to[0] = static_cast<float>(p.x);
      to[1] = static_cast<float>(p.y);
      to[2] = static_cast<float>(p.z);
    }
  }

  void write_uv(const Uv& uv) {
    std::copy(uv.begin(), uv.end(), out_.uv.begin() + static_cast<std::ptrdiff_t>(vertex_));
  }

  void write_triangles(const std::vector<mesh::Triangle>& triangles) {
    const auto base = static_cast<std::uint32_t>(vertex_);
    std::uint32_t* to = out_.indices.data() + index_;
    const int second = turned_ ? 2 : 1, third = 3 - second;
    for (const auto& t : triangles) {
      *to++ = base + t[0];
      *to++ = base + t[second];
      *to++ = base + t[third];
    }
    index_ += 3 * triangles.size();
  }

  void write_fine(const PartNet& net, const Uv& uv, const Tessellation& fine) {
    const std::size_t base = net.points.w.size();
    write_points(net.points);
    write_uv(uv);
    // New vertices take the same road as old ones, so that equal points get equal bits.
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
      if (v.fixed) out_.positions[at] = {static_cast<float>(v.at.x), static_cast<float>(v.at.y), static_cast<float>(v.at.z)};
    }
    write_triangles(fine.triangles);
    vertex_ += base + fine.vertices.size();
  }

  const Work& work_;
  CopyMap map_;
  BentCover& out_;
  std::size_t vertex_, index_;
  bool turned_ = false;
};

/// Runs `task` for all copies in pieces, so that progress is told by the calling thread.
void for_copies(const Work& work, const Executor& executor, const Progress& progress, const char* stage,
                const std::function<void(std::size_t)>& task) {
  const std::size_t count = work.copies.size(), piece = std::max<std::size_t>(64, count / 50);
  for (std::size_t from = 0; from < count; from += piece) {
    report(progress, stage, from, count, "copies");
    executor(std::min(piece, count - from), [&](std::size_t i) { task(from + i); });
  }
  report(progress, stage, count, count, "copies");
}

struct Totals {
  std::vector<CopyCount> copies;
  std::uint64_t vertices = 0, triangles = 0;
  bool fits = true;
};

Totals count_all(const Work& work, const Executor& executor, const Progress& progress) {
  Totals totals;
  totals.copies.resize(work.copies.size());
  std::atomic<std::uint64_t> so_far{0};
  const std::uint64_t most = work.options.max_triangles;
  for_copies(work, executor, progress, "splitting", [&](std::size_t i) {
    if (so_far.load(std::memory_order_relaxed) > most) return;
    totals.copies[i] = count_copy(work, i, most);
    so_far.fetch_add(totals.copies[i].triangles, std::memory_order_relaxed);
  });
  for (const CopyCount& c : totals.copies) {
    totals.vertices += c.vertices;
    totals.triangles += c.triangles;
    totals.fits &= !c.too_many;
  }
  totals.fits &= so_far.load() <= most && totals.vertices < 0xffffffffULL;
  return totals;
}

/// The diagnostic of a scene that is too dense, with a tolerance that was tried and fits.
Diagnostic too_dense(Work& work, const Executor& executor) {
  const bool disk = work.options.view == View::disk;
  const double named = disk ? 1 : work.options.message_factor;
  const double asked = work.sight.tolerance;
  std::uint64_t least = 0;
  for (std::size_t i = 0; i < work.copies.size(); ++i) {
    for (const CopyPart& part : CopyParts(work, i)) least += part.net->mesh->triangles.size();
  }
  const std::string message = "bending " + std::to_string(work.copies.size()) + " copies needs more than " +
                              std::to_string(work.options.max_triangles) + " triangles";
  if (work.options.advise && least <= work.options.max_triangles) {
    for (double factor = 4; factor < 2e6; factor *= 4) {
      work.sight.tolerance = asked * factor;
      if (!count_all(work, executor, {}).fits) continue;
      return make_error("bend.too-dense", message + fmt::format(" at a tolerance of {:g}{}", named * asked, disk ? "" : " px"),
                        fmt::format("a tolerance of {:g}{} fits", named * asked * factor, disk ? "" : " px"));
    }
  }
  return make_error("bend.too-dense", message + fmt::format(" (without any split {})", least),
                    "lower cover.max_bounces, or raise cover.min_pixels or cover.min_weight");
}

/// The nets of all meshes that the models name, each once, and the models in terms of them.
void prepare(Work& work, const place::PlacedRoom& room, const std::vector<Model>& models, const Executor& executor) {
  std::map<const place::PlacedMesh*, std::size_t> known;   // looked up only: addresses order nothing
  std::vector<const place::PlacedMesh*> meshes;
  for (const Model& model : models) {
    work.models.emplace_back();
    for (const Model::Part& part : model.parts) {
      ORBC_CHECK(part.uv->size(), ==, part.mesh->floor.size());
      const auto [at, is_new] = known.try_emplace(part.mesh, meshes.size());
      if (is_new) meshes.push_back(part.mesh);
      work.models.back().push_back({at->second, part.uv, part.flat});
    }
  }
  work.nets.resize(meshes.size());
  executor(meshes.size(), [&](std::size_t i) {
    const bool vary = work.options.colours_vary || colours_vary(room, *meshes[i]);
    work.nets[i] = part_net(room.room.space, *meshes[i], vary ? work.options.colour_tolerance : 0);
  });
  for (std::size_t i = 0; i < work.copies.size(); ++i) {
    const cover::Storey& storey = work.copies[i].storey;
    if (storey.number == 0) continue;
    auto& parts = work.storeys[storey.number];
    parts.resize(work.nets.size());
    for (const ModelPart& part : model_of(work, i))
      if (!parts[part.net]) parts[part.net] = lifted(storey, room.room.space, work.nets[part.net]);
  }
}

}  // namespace

Model whole_model(const place::PlacedRoom& room, const std::vector<Uv>& uv) {
  ORBC_CHECK(uv.size(), ==, room.parts.size());
  Model model;
  for (std::size_t i = 0; i < uv.size(); ++i) model.parts.push_back({&room.parts[i], &uv[i]});
  return model;
}

Result<BentCover> bend(const place::PlacedRoom& room, const std::vector<Uv>& atlas_uv, const std::vector<cover::Copy>& copies,
                       const place::Eye& eye, const BendOptions& options, const Executor& executor, const Progress& progress) {
  return bend(room, {whole_model(room, atlas_uv)}, {}, copies, eye, options, executor, progress);
}

Result<BentCover> bend(const place::PlacedRoom& room, const std::vector<Model>& models, const std::vector<std::uint32_t>& model_of_copy,
                       const std::vector<cover::Copy>& copies, const place::Eye& eye, const BendOptions& options, const Executor& executor,
                       const Progress& progress) {
  ORBC_CHECK(options.tolerance_px, >, 0);
  ORBC_CHECK(options.disk_tolerance, >, 0);
  ORBC_CHECK(options.colour_tolerance, >, 0);
  if (!model_of_copy.empty()) ORBC_CHECK(model_of_copy.size(), ==, copies.size());
  for (const std::uint32_t model : model_of_copy) ORBC_CHECK(model, <, models.size());
  const Isometry eye_from_room = inverse(eye.room_from_eye);
  const Isometry eye_from_cover = options.view == View::eye ? eye_from_room : geometry::identity(room.room.space);
  Work work{copies, model_of_copy, {}, {}, {}, eye_from_cover, eye_from_room, sight_of(eye, options), options};
  // Chords outside of the picture may be off by some tolerances.
  work.margin = options.view == View::eye ? 0.01 + 16 * options.tolerance_px / work.sight.pixels : 0;
  prepare(work, room, models, executor);

  Totals totals = count_all(work, executor, progress);
  if (!totals.fits) return too_dense(work, executor);

  BentCover out;
  out.copies.resize(copies.size());
  BentRange next;
  double worst = 0;
  for (std::size_t i = 0; i < copies.size(); ++i) {
    next.vertex_count = totals.copies[i].vertices;
    next.index_count = 3 * totals.copies[i].triangles;
    out.copies[i] = next;
    next.first_vertex += next.vertex_count;
    next.first_index += next.index_count;
    worst = std::max(worst, totals.copies[i].worst);
    out.split_parts += totals.copies[i].decisions.size();
  }
  out.error_bound_px = worst * work.sight.tolerance;
  out.positions.resize(totals.vertices);
  out.uv.resize(totals.vertices);
  out.indices.resize(3 * totals.triangles);
  for_copies(work, executor, progress, "bending", [&](std::size_t i) {
    Writer(work, i, out.copies[i], totals.copies[i].decisions, out);
    std::vector<std::vector<bool>>().swap(totals.copies[i].decisions);
  });
  if (options.view == View::eye) out = cut_as_seen(std::move(out), copies, eye, options.tolerance_px, executor);
  // Cutting may add triangles, but hardly ever does: most of what it meets falls away.
  if (out.indices.size() / 3 > options.max_triangles || out.positions.size() >= 0xffffffffULL) return too_dense(work, executor);
  return out;
}

}  // namespace orbc::bend
