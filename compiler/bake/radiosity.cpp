#include "compiler/bake/radiosity.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numbers>
#include <utility>

#include "compiler/bake/gather_net.h"
#include "compiler/light/connection.h"
#include "compiler/light/guide.h"
#include "compiler/light/light_path.h"
#include "compiler/surface/albedo.h"

namespace orbc::bake {
namespace {

using scene::Color;

constexpr int kMinLinkInterval = 4;                      // directions per link; light between surfaces is smoother than that of lamps
constexpr std::size_t kMaxLinks = std::size_t{1} << 24;  // 400 MB; where there would be more, the interval grows
constexpr int kRaysPerBatch = 512;                       // followed together
constexpr int kMaxRings = 256;                           // of points inside closed things that take on light from around
constexpr double kConvergence = 2e-4;                    // of white: change of a pass at which the iteration ends

/// A direction of a gather point that carries light between surfaces.
struct TransportLink {
  PatchUv from;
  std::array<float, 3> weight{};  ///< of the irradiance / π there
};

/// What the rays of a gather point have found.
struct PointTransport {
  Color source;           ///< from surfaces under their lamps, from emissive ones, from the background
  bool enclosed = false;  ///< most rays end on the inside of things
  std::vector<TransportLink> links;
};

struct Solver {
  const LitPatches& surfaces;
  const RadiosityOptions& options;
  const PatchLocator& locator;
  int link_interval = kMinLinkInterval;
};

int link_interval_for(const GatherNet& net, const RadiosityOptions& options) {
  const auto gathering = std::count_if(net.points.begin(), net.points.end(), [](const GatherPoint& p) { return p.base.patch < 0; });
  const std::size_t directions = static_cast<std::size_t>(gathering) * static_cast<std::size_t>(options.samples);
  return static_cast<int>(std::clamp((directions + kMaxLinks - 1) / kMaxLinks, std::size_t{kMinLinkInterval},
                                     static_cast<std::size_t>(std::max(kMinLinkInterval, options.samples))));
}

/// Rays from a gather point, with their weights.
struct RayBatch {
  std::vector<trace::Ray> rays;
  std::vector<double> weight;
  std::vector<bool> is_link;
};
RayBatch make_rays(const Solver& solver, const light::Guide& guide, const surface::ShadingPoint& at, int first, int end) {
  RayBatch batch;
  for (int k = first; k < end; ++k) {
    const light::DirectionSample direction = light::sample_direction(guide, surface::r3_point(k));
    if (direction.weight <= 0) continue;
    batch.rays.push_back(light::spawn_ray(solver.surfaces.lighting, at, direction.direction));
    batch.weight.push_back(direction.weight / solver.options.samples);
    batch.is_link.push_back(k % solver.link_interval == 0);
  }
  return batch;
}

/// In: `seed` of the random numbers that choose between reflection and refraction.
PointTransport gather_at(const Solver& solver, const surface::ShadingPoint& at, std::size_t seed) {
  const light::LightingContext& lighting = solver.surfaces.lighting;
  const place::Interior& interior = solver.surfaces.interior;
  const int samples = solver.options.samples;
  const double links_to_samples = static_cast<double>(samples) / ((samples + solver.link_interval - 1) / solver.link_interval);
  const light::Guide guide = light::guide_at(lighting, at);
  surface::Random random(seed);
  PointTransport transport;
  int directions = 0, ending_inside = 0;
  for (int first = 0; first < samples; first += kRaysPerBatch) {
    const RayBatch batch = make_rays(solver, guide, at, first, std::min(first + kRaysPerBatch, samples));
    std::vector<trace::Path> paths = trace::follow(lighting.scene, batch.rays, light::path_follow_options(lighting));
    directions += static_cast<int>(paths.size());
    for (std::size_t k = 0; k < paths.size(); ++k) {
      const light::LightPath start{{}, {batch.weight[k], batch.weight[k], batch.weight[k]}, {}};
      const light::LightPath path = light::extend_path(interior, lighting, start, std::move(paths[k]), random);
      transport.source = transport.source + path.radiance;
      if (!path.end) continue;
      ending_inside += !path.end->point.front_facing;
      const PatchUv on = solver.locator.find(path.end->point, path.end->hit);
      const Color weight = path.throughput * surface::hit_albedo(interior, path.end->point);
      Color radiosity = lighting.ambient;
      if (on.patch >= 0) {
        const IrradianceGrid& direct = solver.surfaces.direct[static_cast<std::size_t>(on.patch)];
        radiosity = radiosity + (1 / std::numbers::pi) * interpolate(direct, on.u, on.v);
      }
      transport.source = transport.source + weight * radiosity;
      if (on.patch < 0 || !batch.is_link[k]) continue;
      const Color link = links_to_samples * weight;
      transport.links.push_back({on, {static_cast<float>(link.r), static_cast<float>(link.g), static_cast<float>(link.b)}});
    }
  }
  transport.links.shrink_to_fit();
  transport.enclosed = 2 * ending_inside > directions;
  return transport;
}

std::vector<PointTransport> gather(const Solver& solver, const GatherNet& net, const Executor& executor, const Progress& progress) {
  constexpr std::size_t kChunk = 16;
  std::vector<PointTransport> transport(net.points.size());
  std::atomic<std::uint64_t> done{0};
  executor((net.points.size() + kChunk - 1) / kChunk, [&](std::size_t c) {
    for (std::size_t i = c * kChunk; i < std::min(net.points.size(), (c + 1) * kChunk); ++i)
      if (net.points[i].base.patch < 0) transport[i] = gather_at(solver, net.points[i].at, i);
    report(progress, "passing light on", done.fetch_add(kChunk), net.points.size(), "points");
  });
  return transport;
}

/// The light of all gather points as grids of the patches.
std::vector<IrradianceGrid> grids_of(const LitPatches& surfaces, const GatherNet& net, const std::vector<Color>& indirect) {
  std::vector<IrradianceGrid> grids;
  for (const std::vector<TexelPatch>& patches : surfaces.patches)
    for (const TexelPatch& patch : patches) {
      const PatchPoints& points = net.patches[grids.size()];
      IrradianceGrid grid;
      grid.width = points.width;
      grid.height = points.height;
      grid.light.resize(points.point.size());
      for (std::size_t k = 0; k < points.point.size(); ++k) {
        if (points.point[k] < 0) continue;
        const Color& c = indirect[static_cast<std::size_t>(points.point[k])];
        grid.light[k] = {static_cast<float>(c.r), static_cast<float>(c.g), static_cast<float>(c.b)};
      }
      grids.push_back(extrapolate_beyond_patch(std::move(grid), patch));
    }
  return grids;
}

/// Enclosed points take on the mean light of their neighbours on the grids of patches, ring by ring.
std::vector<Color> inpaint_enclosed(const GatherNet& net, const std::vector<PointTransport>& transport, std::vector<Color> indirect) {
  std::vector<std::uint8_t> enclosed;
  for (const PointTransport& point : transport) enclosed.push_back(point.enclosed);
  for (int ring = 0; ring < kMaxRings && std::count(enclosed.begin(), enclosed.end(), 1) > 0; ++ring) {
    std::vector<Color> sum(indirect.size());
    std::vector<int> count(indirect.size(), 0);
    const auto give = [&](std::int32_t from, std::int32_t to) {
      if (from < 0 || to < 0) return;
      const auto a = static_cast<std::size_t>(from), b = static_cast<std::size_t>(to);
      if (enclosed[a] || !enclosed[b]) return;
      sum[b] = sum[b] + indirect[a];
      ++count[b];
    };
    const auto exchange = [&](std::int32_t a, std::int32_t b) {
      give(a, b);
      give(b, a);
    };
    for (const PatchPoints& points : net.patches) {
      const auto width = static_cast<std::size_t>(points.width);
      for (std::size_t k = 0; k < points.point.size(); ++k) {
        if ((k + 1) % width != 0) exchange(points.point[k], points.point[k + 1]);
        if (k + width < points.point.size()) exchange(points.point[k], points.point[k + width]);
      }
    }
    bool reached_any = false;
    for (std::size_t i = 0; i < indirect.size(); ++i) {
      if (!enclosed[i] || count[i] == 0) continue;
      indirect[i] = (1.0 / count[i]) * sum[i];
      enclosed[i] = 0;
      reached_any = true;
    }
    if (!reached_any) break;
  }
  return indirect;
}

Color gather_over_links(const PointTransport& point, const std::vector<IrradianceGrid>& grids) {
  Color sum = point.source;
  for (const TransportLink& link : point.links) {
    const Color c = interpolate(grids[static_cast<std::size_t>(link.from.patch)], link.from.u, link.from.v);
    sum = sum + Color{link.weight[0] * c.r, link.weight[1] * c.g, link.weight[2] * c.b};
  }
  return sum;
}

/// Irradiance / π at all gather points.
std::vector<Color> iterate(const Solver& solver, const GatherNet& net, const std::vector<PointTransport>& transport,
                           const Executor& executor) {
  constexpr std::size_t kChunk = 256;
  const light::LightingContext& lighting = solver.surfaces.lighting;
  const double max_change = kConvergence / std::max(lighting.exposure, 1e-300);
  std::vector<Color> indirect;
  for (const PointTransport& point : transport) indirect.push_back(point.source);
  indirect = inpaint_enclosed(net, transport, std::move(indirect));
  for (int pass = 1; pass < lighting.options.indirect_bounces; ++pass) {
    const std::vector<IrradianceGrid> grids = grids_of(solver.surfaces, net, indirect);
    std::vector<Color> next(indirect.size());
    executor((next.size() + kChunk - 1) / kChunk, [&](std::size_t c) {
      for (std::size_t i = c * kChunk; i < std::min(next.size(), (c + 1) * kChunk); ++i) next[i] = gather_over_links(transport[i], grids);
    });
    double change = 0;
    for (std::size_t i = 0; i < next.size(); ++i)
      if (!transport[i].enclosed) change = std::max(change, max_channel(next[i] + -1.0 * indirect[i]));
    indirect = inpaint_enclosed(net, transport, std::move(next));
    if (change < max_change) break;
  }
  return indirect;
}

/// The points of levels of detail take over the light of the parts themselves.
std::vector<Color> copy_to_lods(const Solver& solver, const GatherNet& net, std::vector<Color> indirect) {
  const std::vector<IrradianceGrid> grids = grids_of(solver.surfaces, net, indirect);
  for (std::size_t i = 0; i < indirect.size(); ++i)
    if (const PatchUv& on = net.points[i].base; on.patch >= 0)
      indirect[i] = interpolate(grids[static_cast<std::size_t>(on.patch)], on.u, on.v);
  return indirect;
}

}  // namespace

std::vector<IrradianceGrid> solve_radiosity(const LitPatches& surfaces, const RadiosityOptions& options, const Executor& executor,
                                            const Progress& progress) {
  const PatchLocator locator(surfaces.interior, surfaces.patches);
  const GatherNet net = make_gather_net(surfaces, locator, options.density);
  const Solver solver{surfaces, options, locator, link_interval_for(net, options)};
  const std::vector<PointTransport> transport = gather(solver, net, executor, progress);
  std::vector<Color> indirect = copy_to_lods(solver, net, iterate(solver, net, transport, executor));
  return grids_of(surfaces, net, inpaint_enclosed(net, transport, std::move(indirect)));
}

}  // namespace orbc::bake
