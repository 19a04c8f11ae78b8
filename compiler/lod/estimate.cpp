#include "compiler/lod/estimate.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "compiler/cover/sample.h"

namespace orbc::lod {
namespace {

constexpr std::size_t kMinSampleCopies = 128, kMaxSampleCopies = 16384;

double bytes_of(double vertices, double triangles) { return cover::kBytesPerVertex * vertices + cover::kBytesPerTriangle * triangles; }

/// The mean number of triangles of a copy before splitting.
double mean_triangles(const cover::Contents& contents, std::size_t copies) {
  std::vector<double> of_model;
  for (const auto& meshes : contents.models) {
    double& sum = of_model.emplace_back(0);
    for (const place::PlacedMesh* mesh : meshes) sum += static_cast<double>(mesh->triangles.size());
  }
  if (contents.model_of_copy.empty()) return of_model.front();
  double sum = 0;
  for (const std::uint32_t model : contents.model_of_copy) sum += of_model[model];
  return sum / static_cast<double>(std::max<std::size_t>(1, copies));
}

std::vector<std::uint64_t> rounded(const std::vector<double>& values) {
  std::vector<std::uint64_t> whole;
  for (const double v : values) whole.push_back(static_cast<std::uint64_t>(std::llround(v)));
  return whole;
}

}  // namespace

Result<cover::Plan> estimate(const cover::Contents& contents, const place::Camera& eye, const std::vector<cover::Copy>& copies,
                             const BendSome& bend_some, const EstimateOptions& options) {
  cover::Plan plan = cover::plan_of(copies, *contents.room);
  const double affordable = static_cast<double>(options.max_triangles) / std::max(1.0, mean_triangles(contents, copies.size()));
  const auto most = static_cast<std::size_t>(std::clamp<double>(affordable, kMinSampleCopies, kMaxSampleCopies));
  const std::vector<cover::Sample> samples = cover::stratified_sample(copies, contents, eye, most);
  std::vector<std::size_t> which;
  for (const cover::Sample& sample : samples) which.push_back(sample.copy);
  const auto bent = bend_some(which);
  if (!bent) return bent.error();
  std::vector<double> bytes(plan.copies_per_bounces.size()), vertices(bytes.size()), triangles(bytes.size());
  for (std::size_t b = 0; b < bytes.size(); ++b) bytes[b] = cover::kBytesPerCopy * static_cast<double>(plan.copies_per_bounces[b]);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const bend::BentRange& range = bent->copies[i];
    const double v = samples[i].weight * static_cast<double>(range.vertex_count),
                 t = samples[i].weight * static_cast<double>(range.index_count) / 3;
    const auto bounces = static_cast<std::size_t>(copies[samples[i].copy].bounces);
    vertices[bounces] += v;
    triangles[bounces] += t;
    bytes[bounces] += bytes_of(v, t);
  }
  plan.vertices = static_cast<std::uint64_t>(std::llround(std::accumulate(vertices.begin(), vertices.end(), 0.0)));
  plan.triangles = static_cast<std::uint64_t>(std::llround(std::accumulate(triangles.begin(), triangles.end(), 0.0)));
  plan.vertices_per_bounces = rounded(vertices);
  plan.triangles_per_bounces = rounded(triangles);
  double sum = 0;
  int fits = -1;
  for (const double b : bytes) {
    sum += b;
    if (sum <= static_cast<double>(options.max_bytes)) ++fits;
  }
  plan.bytes = static_cast<std::uint64_t>(std::llround(sum));
  if (sum > static_cast<double>(options.max_bytes)) {
    return make_error(
        "cover.too-much",
        fmt::format("max_bounces: {} needs about {} MiB, as much again for the file that is made of it, and {} MiB are allowed",
                    options.max_bounces, (plan.bytes >> 20) + 1, options.max_bytes >> 19),
        fits < 0 ? std::string("not even the room itself fits: use coarser meshes or allow more memory")
                 : fmt::format("max_bounces: {} fits", fits));
  }
  return plan;
}

}  // namespace orbc::lod
