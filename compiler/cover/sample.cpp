// Systematic sampling in the order of distance (Cochran, Sampling techniques, 1977, ch. 8 and 9A), with probabilities proportional to an
// estimate of the visible triangles: those of the parts that the wedge of a copy meets. The sum over all copies is accurate when the
// estimate is right up to a factor that changes slowly with the distance.
#include "compiler/cover/sample.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <tuple>

#include "compiler/base/elementary.h"
#include "compiler/geometry/circle.h"

namespace orbc::cover {
namespace {

using geometry::Ambient;
using geometry::Space;

/// A part of a model: a circle on the floor around it, and its triangles.
struct Disk {
  geometry::Circle circle;
  double triangles = 0;
  int wall = -1;  // of panels on walls
};

Disk disk_of(Space space, const place::PlacedMesh& mesh) {
  return {geometry::bounding_circle(space, mesh.floor), static_cast<double>(mesh.triangles.size()),
          mesh.kind == place::PartKind::wall ? mesh.wall : -1};
}

double angle_between(const Bearing& a, const Bearing& b) { return math::atan2(cross(a, b), a.x * b.x + a.y * b.y); }

/// The share of the bearings of a circle that lie in the wedge. In: its centre in eye coordinates.
double share_in(const Wedge& wedge, Space space, const Ambient& centre, double radius) {
  const double rho = math::hypot(centre.x, centre.y), across = geometry::sin_k(space, std::min(radius, std::numbers::pi / 2));
  if (rho <= across || rho < 1e-12) return std::min(1.0, angle_between(wedge.from, wedge.to) / std::numbers::pi);
  const Bearing middle{centre.x / rho, centre.y / rho};
  const double half = math::asin(across / rho), from = -angle_between(wedge.from, middle), to = angle_between(middle, wedge.to);
  const double shared = std::min(half, to) - std::max(-half, from);
  return half > 0 ? std::clamp(shared / (2 * half), 0.0, 1.0) : 1;
}

struct Model {
  std::vector<Disk> disks;
  double triangles = 0;
};

std::vector<Model> models_of(const Contents& contents, Space space) {
  std::map<const place::PlacedMesh*, Disk> known;  // never iterated: its order depends on addresses
  std::vector<Model> models;
  for (const auto& meshes : contents.models) {
    Model& model = models.emplace_back();
    for (const place::PlacedMesh* mesh : meshes) {
      auto found = known.find(mesh);
      if (found == known.end()) found = known.emplace(mesh, disk_of(space, *mesh)).first;
      model.disks.push_back(found->second);
      model.triangles += found->second.triangles;
    }
  }
  return models;
}

/// What a copy is expected to contribute.
struct ImportanceEstimate {
  double distance = 0;   // from the eye to the centre of the copy, along the ray
  double triangles = 0;  // visible ones
  std::size_t copy = 0;
};

constexpr double kVisibleShareAtLeast = 0.02;  // of a model's triangles; keeps weights bounded where the estimate is wrong

ImportanceEstimate estimate_of(const Copy& copy, const Model& model, const geometry::Isometry& eye_from_cover, std::size_t index) {
  const auto eye_from_copy = eye_from_cover * copy.cover_from_room;
  const Space space = eye_from_copy.space;
  const Ambient centre = eye_from_copy * geometry::Point();
  const double r = geometry::arc_k(space, centre.w, math::hypot(centre.x, centre.y));
  ImportanceEstimate estimate{r, kVisibleShareAtLeast * model.triangles + 1, index};
  if (copy.sheet > 0) estimate.distance = copy.sheet * std::numbers::pi + (copy.sheet % 2 == 1 ? std::numbers::pi - r : r);
  for (const Disk& disk : model.disks) {
    if (faces_eye(copy, disk.wall)) continue;
    Ambient middle = eye_from_copy * disk.circle.centre;
    if (copy.sheet % 2 == 1) middle = -1.0 * middle;
    estimate.triangles += disk.triangles * (copy.wedge ? share_in(*copy.wedge, space, middle, disk.circle.radius) : 1);
  }
  return estimate;
}

}  // namespace

Contents contents_of(const place::Interior& room) {
  Contents contents{&room, {{}}, {}};
  for (const place::PlacedMesh& part : room.parts) contents.models.front().push_back(&part);
  return contents;
}

std::vector<Sample> stratified_sample(const std::vector<Copy>& copies, const Contents& contents, const place::Camera& eye,
                                      std::size_t max_samples) {
  std::vector<Sample> samples;
  if (copies.size() <= max_samples) {
    for (std::size_t i = 0; i < copies.size(); ++i) samples.push_back({i, 1});
    return samples;
  }
  const auto eye_from_cover = inverse(eye.room_from_eye);
  const std::vector<Model> models = models_of(contents, contents.room->polygon.space);
  std::vector<ImportanceEstimate> estimates;
  estimates.reserve(copies.size());
  for (std::size_t i = 0; i < copies.size(); ++i)
    estimates.push_back(estimate_of(copies[i], models[contents.model_of_copy.empty() ? 0 : contents.model_of_copy[i]], eye_from_cover, i));
  std::sort(estimates.begin(), estimates.end(), [](const ImportanceEstimate& a, const ImportanceEstimate& b) {
    return std::tie(a.distance, a.copy) < std::tie(b.distance, b.copy);
  });
  const std::size_t nearest = max_samples / 4;
  for (std::size_t i = 0; i < nearest; ++i) samples.push_back({estimates[i].copy, 1});
  double all = 0;
  for (std::size_t i = nearest; i < estimates.size(); ++i) all += estimates[i].triangles;
  // The triangles of all further copies form a line that is divided into equal steps, with one sample in the middle of each. A copy that is
  // longer than a step is always sampled, with weight 1.
  const double step = all / static_cast<double>(max_samples - nearest);
  double to_next = step / 2;
  for (std::size_t i = nearest; i < estimates.size(); ++i) {
    const double length = estimates[i].triangles;
    if (length >= step) {
      samples.push_back({estimates[i].copy, 1});
      continue;
    }
    if (to_next < length) {
      samples.push_back({estimates[i].copy, step / length});
      to_next += step;
    }
    to_next -= length;
  }
  return samples;
}

}  // namespace orbc::cover
