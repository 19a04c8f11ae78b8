// Systematic sampling in the order of distance, with a chance proportional to a guess of what is drawn: the triangles of the parts that a
// wedge meets. Where the guess is right but for a factor that changes slowly with the distance, so is the estimate.
#include "compiler/cover/sample.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <tuple>

#include "compiler/base/elementary.h"

namespace orbc::cover {
namespace {

using geometry::Ambient;
using geometry::Space;

/// A circle on the floor around a part, and how many triangles are in it.
struct Disk {
  geometry::Point centre;
  double radius = 0, triangles = 0;
  int wall = -1;
};

Disk disk_of(Space space, const place::PlacedMesh& mesh) {
  Disk disk;
  disk.triangles = static_cast<double>(mesh.triangles.size());
  disk.wall = mesh.kind == place::PartKind::wall ? mesh.wall : -1;
  Ambient sum{0, 0, 0};
  for (const geometry::Point& p : mesh.floor) sum = sum + p;
  if (!mesh.floor.empty() && (space != Space::spherical || sum.w * sum.w + sum.x * sum.x + sum.y * sum.y > 1e-6))
    disk.centre = geometry::normalised_point(space, sum);
  for (const geometry::Point& p : mesh.floor) disk.radius = std::max(disk.radius, geometry::distance(space, disk.centre, p));
  return disk;
}

double angle_between(const Bearing& a, const Bearing& b) { return math::atan2(turn(a, b), a.x * b.x + a.y * b.y); }

/// The share of the bearings of a disk that lie in the wedge.
double share_in(const Wedge& wedge, Space space, const Ambient& seen, double radius) {
  const double rho = math::hypot(seen.x, seen.y), across = geometry::sin_k(space, std::min(radius, std::numbers::pi / 2));
  if (rho <= across || rho < 1e-12) return std::min(1.0, angle_between(wedge.from, wedge.to) / std::numbers::pi);
  const Bearing middle{seen.x / rho, seen.y / rho};
  const double half = math::asin(across / rho), from = -angle_between(wedge.from, middle), to = angle_between(middle, wedge.to);
  const double shared = std::min(half, to) - std::max(-half, from);
  return half > 0 ? std::clamp(shared / (2 * half), 0.0, 1.0) : 1;
}

struct Model {
  std::vector<Disk> disks;
  double triangles = 0;
};

std::vector<Model> models_of(const Contents& contents, Space space) {
  std::map<const place::PlacedMesh*, Disk> known;   // looked up only
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

struct Guess {
  double distance = 0, triangles = 0;
  std::size_t copy = 0;
};

}  // namespace

Contents contents_of(const place::PlacedRoom& room) {
  Contents contents{&room, {{}}, {}};
  for (const place::PlacedMesh& part : room.parts) contents.models.front().push_back(&part);
  return contents;
}

std::vector<Sample> sample_of(const std::vector<Copy>& copies, const Contents& contents, const place::Eye& eye, std::size_t most) {
  std::vector<Sample> samples;
  if (copies.size() <= most) {
    for (std::size_t i = 0; i < copies.size(); ++i) samples.push_back({i, 1});
    return samples;
  }
  const Space space = contents.room->room.space;
  const auto eye_from_cover = inverse(eye.room_from_eye);
  const std::vector<Model> models = models_of(contents, space);
  std::vector<Guess> guesses;
  guesses.reserve(copies.size());
  for (std::size_t i = 0; i < copies.size(); ++i) {
    const Copy& copy = copies[i];
    const auto eye_from_copy = eye_from_cover * copy.cover_from_room;
    const Ambient centre = eye_from_copy * geometry::Point();
    const Model& model = models[contents.model_of_copy.empty() ? 0 : contents.model_of_copy[i]];
    Guess guess{geometry::arc_k(space, centre.w, math::hypot(centre.x, centre.y)), 0.02 * model.triangles + 1, i};
    if (copy.sheet > 0)
      guess.distance = copy.sheet * std::numbers::pi + (copy.sheet % 2 == 1 ? std::numbers::pi - guess.distance : guess.distance);
    for (const Disk& disk : model.disks) {
      if (disk.wall >= 0 && disk.wall < 64 && ((copy.nearer_walls >> disk.wall) & 1)) continue;
      Ambient seen = eye_from_copy * disk.centre;
      if (copy.sheet % 2 == 1) seen = -1.0 * seen;
      guess.triangles += disk.triangles * (copy.wedge ? share_in(*copy.wedge, space, seen, disk.radius) : 1);
    }
    guesses.push_back(guess);
  }
  std::sort(guesses.begin(), guesses.end(),
            [](const Guess& a, const Guess& b) { return std::tie(a.distance, a.copy) < std::tie(b.distance, b.copy); });
  const std::size_t nearest = most / 4;
  double all = 0;
  for (std::size_t i = nearest; i < guesses.size(); ++i) all += guesses[i].triangles;
  for (std::size_t i = 0; i < nearest; ++i) samples.push_back({guesses[i].copy, 1});
  // A step for every sample; what is longer than a step is picked for certain and stands for itself alone.
  const double step = all / static_cast<double>(most - nearest);
  double along = step / 2;
  for (std::size_t i = nearest; i < guesses.size(); ++i) {
    const double t = guesses[i].triangles;
    if (t >= step) {
      samples.push_back({guesses[i].copy, 1});
      continue;
    }
    if (along < t) samples.push_back({guesses[i].copy, step / t}), along += step;
    along -= t;
  }
  return samples;
}

}  // namespace orbc::cover
