#include "compiler/driver/estimate.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "compiler/cover/sample.h"

namespace orbc::driver {
namespace {

constexpr std::size_t kFewest = 128, kMost = 2048;   // copies to be bent

double bytes_of(double vertices, double triangles) { return cover::kBytesPerVertex * vertices + cover::kBytesPerTriangle * triangles; }

}  // namespace

Result<cover::Plan> estimate(const place::PlacedRoom& room, const place::Eye& eye, const std::vector<cover::Copy>& copies, int max_bounces,
                             std::uint64_t max_bytes, const BendSome& bend_some, std::uint64_t most_triangles) {
  cover::Plan plan = cover::plan_of(copies, room);
  const std::size_t most = std::clamp<std::size_t>(most_triangles / std::max<std::uint64_t>(1, plan.room_triangles), kFewest, kMost);
  const std::vector<cover::Sample> samples = cover::sample_of(copies, room, eye, most);
  std::vector<std::size_t> which;
  for (const cover::Sample& sample : samples) which.push_back(sample.copy);
  const auto bent = bend_some(which);
  if (!bent) return bent.error();
  double vertices = 0, triangles = 0;
  std::vector<double> bytes(plan.copies_per_bounces.size());
  for (std::size_t b = 0; b < bytes.size(); ++b) bytes[b] = cover::kBytesPerCopy * static_cast<double>(plan.copies_per_bounces[b]);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const bend::BentRange& range = bent->copies[i];
    const double v = samples[i].stands_for * static_cast<double>(range.vertex_count),
                 t = samples[i].stands_for * static_cast<double>(range.index_count) / 3;
    vertices += v;
    triangles += t;
    bytes[static_cast<std::size_t>(copies[samples[i].copy].bounces)] += bytes_of(v, t);
  }
  plan.vertices = static_cast<std::uint64_t>(std::llround(vertices));
  plan.triangles = static_cast<std::uint64_t>(std::llround(triangles));
  double sum = 0;
  int fits = -1;
  for (const double b : bytes) {
    sum += b;
    if (sum <= static_cast<double>(max_bytes)) ++fits;
  }
  plan.bytes = static_cast<std::uint64_t>(std::llround(sum));
  if (sum > static_cast<double>(max_bytes)) {
    return make_error(
        "cover.too-much",
        fmt::format("max_bounces: {} needs about {} MiB, as much again for the file that is made of it, and {} MiB are allowed",
                    max_bounces, (plan.bytes >> 20) + 1, max_bytes >> 19),
        fits < 0 ? std::string("not even the room itself fits: use coarser meshes or allow more memory")
                 : fmt::format("max_bounces: {} fits", fits));
  }
  return plan;
}

}  // namespace orbc::driver
