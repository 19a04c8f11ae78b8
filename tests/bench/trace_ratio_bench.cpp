// The tracer against the limit: Embree's rtcIntersect1 on straight rays in the Euclidean room, walls analytic on both sides. Repetitions
// are interleaved in one process and the medians' ratios printed, since absolute times drift. One thread: CPU time of the thread. With two
// threads both clocks are told: the wall's, and that of the busier thread, which a busy machine does not lengthen.
//   trace_ratio_bench [repetitions] [triangle counts…] [--threads] [--json FILE]
#include <pmmintrin.h>
#include <time.h>
#include <xmmintrin.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <fstream>
#include <string>
#include <thread>

#include "tests/bench/trace_scenes.h"
#include "tests/support/threads.h"
#ifdef ORBC_EMBREE
#include <embree3/rtcore.h>
#endif

using namespace orbc;
using namespace orbc::trace;
using namespace orbc::trace::bench;

namespace {

double cpu_seconds() {
  timespec t;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

double wall_seconds() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

/// All figures once more, for machines.
struct Figures {
  std::string text;
  void add(const std::string& key, double value) {
    char number[40];
    std::snprintf(number, sizeof number, "%.4g", value);
    text += (text.empty() ? "{\n " : ",\n ") + ('"' + key + "\": ") + number;
  }
} figures;

struct Work {
  std::uint64_t rays = 0, hits = 0;
};

/// Follows a ray through the walls: the loop that both sides share, with `find` = what a ray meets.
template <class Find>
void bounce(const TraceScene& scene, Ray ray, int bounces, const Find& find, Work& work) {
  for (int i = 0;; ++i) {
    const Hit hit = find(ray);
    ++work.rays;
    work.hits += hit.kind == HitKind::triangle;
    if (hit.kind != HitKind::wall || i >= bounces) return;
    ray = reflected_in_wall(scene.prism, ray, hit.t, hit.wall);
  }
}

/// The same for many rays at once, as a renderer's tile would.
Work streams(const Case& c, std::size_t begin, std::size_t end, int bounces) {
  constexpr std::size_t kTile = 256;
  Work work;
  std::vector<Ray> going;
  for (; begin < end; begin += kTile) {
    going.assign(c.rays.begin() + static_cast<std::ptrdiff_t>(begin),
                 c.rays.begin() + static_cast<std::ptrdiff_t>(std::min(end, begin + kTile)));
    for (int i = 0; !going.empty(); ++i) {
      const std::vector<Hit> hits = closest(c.scene, going);
      work.rays += hits.size();
      std::size_t left = 0;
      for (std::size_t j = 0; j < hits.size(); ++j) {
        work.hits += hits[j].kind == HitKind::triangle;
        if (hits[j].kind == HitKind::wall && i < bounces)
          going[left++] = reflected_in_wall(c.scene.prism, going[j], hits[j].t, hits[j].wall);
      }
      going.resize(left);
    }
  }
  return work;
}

#ifdef ORBC_EMBREE
struct Embree {
  RTCDevice device;
  RTCScene scene;
  explicit Embree(const place::PlacedMesh& mesh) {
    device = rtcNewDevice("threads=1,isa=avx2");
    scene = rtcNewScene(device);
    rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_HIGH);
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* v = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 12, mesh.floor.size()));
    for (std::size_t i = 0; i < mesh.floor.size(); ++i) {
      v[3 * i] = static_cast<float>(mesh.floor[i].x);
      v[3 * i + 1] = static_cast<float>(mesh.floor[i].y);
      v[3 * i + 2] = static_cast<float>(mesh.z[i]);
    }
    auto* t =
        static_cast<unsigned*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 12, mesh.triangles.size()));
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) std::copy(mesh.triangles[i].begin(), mesh.triangles[i].end(), t + 3 * i);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene);
  }
  ~Embree() {
    rtcReleaseScene(scene);
    rtcReleaseDevice(device);
  }
  Hit closest(const TraceScene& room, const Ray& ray) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRayHit query;
    query.ray.org_x = static_cast<float>(ray.at.x);
    query.ray.org_y = static_cast<float>(ray.at.y);
    query.ray.org_z = static_cast<float>(ray.z);
    query.ray.dir_x = static_cast<float>(ray.c * ray.along.x);
    query.ray.dir_y = static_cast<float>(ray.c * ray.along.y);
    query.ray.dir_z = static_cast<float>(ray.m);
    query.ray.tnear = 0;
    query.ray.tfar = std::numeric_limits<float>::infinity();
    query.ray.time = 0;
    query.ray.mask = ~0u;
    query.ray.flags = 0;
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(scene, &context, &query);
    Hit hit;
    if (query.hit.geomID != RTC_INVALID_GEOMETRY_ID) {
      hit.kind = HitKind::triangle;
      hit.t = query.ray.tfar;
      hit.triangle = static_cast<int>(query.hit.primID);
      hit.b[1] = query.hit.u;
      hit.b[2] = query.hit.v;
      return hit;
    }
    const Exit exit = exit_of(room.prism, ray);
    hit.kind = exit.surface >= 0 ? HitKind::wall : exit.surface == kFloor ? HitKind::floor : HitKind::ceiling;
    hit.t = exit.t;
    hit.wall = exit.surface;
    return hit;
  }
};
#endif

struct Runner {
  std::string name;
  std::function<Work(std::size_t begin, std::size_t end)> run;
  std::vector<double> times, cpu;   ///< of the measure's clock; two threads: also CPU time of the busier
  Work work;
  double median() {
    std::sort(times.begin(), times.end());
    return times[times.size() / 2];
  }
  double rate() { return static_cast<double>(work.rays) / median() * 1e-6; }
};

template <class Find>
Runner runner(const std::string& name, const Case& c, int bounces, Find find) {
  return {name, [&c, bounces, find](std::size_t begin, std::size_t end) {
            Work work;
            for (std::size_t i = begin; i < end; ++i) bounce(c.scene, c.rays[i], bounces, find, work);
            return work;
          }, {}, {}, {}};
}

void measure(std::vector<Runner>& runners, std::size_t rays, int repetitions, int threads) {
  for (Runner& r : runners) r.times.clear(), r.cpu.clear();
  for (int i = 0; i < repetitions; ++i)
    for (Runner& r : runners) {
      if (threads == 1) {
        const double start = cpu_seconds();
        r.work = r.run(0, rays);
        r.times.push_back(cpu_seconds() - start);
      } else {
        const double start = wall_seconds();
        Work other;
        double cpu = 0;
        std::thread second([&] {
          _MM_SET_FLUSH_ZERO_MODE(_MM_FLUSH_ZERO_ON);
          other = r.run(rays / 2, rays);
          cpu = cpu_seconds();
        });
        const double own = cpu_seconds();
        r.work = r.run(0, rays / 2);
        const double busy = cpu_seconds() - own;
        second.join();
        r.cpu.push_back(std::max(busy, cpu));
        r.work.rays += other.rays;
        r.times.push_back(wall_seconds() - start);
      }
    }
}

/// Runners: [Embree], E2 S2 H2 ray by ray, E2 S2 H2 in streams.
void print(int size, int bounces, std::vector<Runner>& runners) {
  const std::size_t own = runners.size() - 6;
  std::printf("%7d triangles, %s, 1 thread:", size, bounces ? "mirrors" : "camera ");
  if (own) std::printf("  Embree %.2f Mrays/s", runners[0].rate());
  for (std::size_t i = own; i < runners.size(); i += 3) {
    std::printf("\n    %s:", i == own ? "ray by ray" : "streams   ");
    for (std::size_t j = i; j < i + 3; ++j) std::printf("  %s %.2f", runners[j].name.c_str(), runners[j].rate());
    if (own)
      for (std::size_t j = i; j < i + 3; ++j)
        std::printf("%s %s %.2f", j == i ? "  | of Embree:" : "", runners[j].name.c_str(), runners[j].rate() / runners[0].rate());
    std::printf("  | of straight: S2 %.2f H2 %.2f", runners[i + 1].rate() / runners[i].rate(), runners[i + 2].rate() / runners[i].rate());
    const std::string key = std::to_string(size) + (bounces ? " mirrors " : " camera ") + (i == own ? "singly " : "streams ");
    for (std::size_t j = i; j < i + 3; ++j) {
      figures.add(key + runners[j].name + " Mrays/s", runners[j].rate());
      if (own) figures.add(key + runners[j].name + " of Embree", runners[j].rate() / runners[0].rate());
      if (j > i) figures.add(key + runners[j].name + " of straight", runners[j].rate() / runners[i].rate());
    }
  }
  std::printf("\n");
}

}  // namespace

int main(int argc, char** argv) {
  int repetitions = 7;
  bool threads = false;
  std::string json;
  std::vector<int> sizes;
  for (int i = 1; i < argc; ++i) {
    if (std::string(argv[i]) == "--threads") threads = true;
    else if (std::string(argv[i]) == "--json" && i + 1 < argc) json = argv[++i];
    else if (i == 1) repetitions = std::atoi(argv[i]);
    else sizes.push_back(std::atoi(argv[i]));
  }
  if (sizes.empty()) sizes = {12500, 1000000};
  _MM_SET_FLUSH_ZERO_MODE(_MM_FLUSH_ZERO_ON);
  _MM_SET_DENORMALS_ZERO_MODE(_MM_DENORMALS_ZERO_ON);
  for (const int size : sizes) {
    const int around = size > 100000 ? 200 : 20, steps = size / (2 * around);
    std::vector<Case> cases;
    for (const auto space : {geometry::Space::euclidean, geometry::Space::spherical, geometry::Space::hyperbolic})
      cases.push_back(make_case(space, steps, around));
    for (Case& c : cases) {
      const double cpu = cpu_seconds(), start = wall_seconds();
      c.scene = prepare(c.placed);
      std::printf("%s: %zu triangles, prepared in %.3f s (CPU %.3f s, one thread), %.1f bytes a triangle, %zu nodes, %zu blocks\n",
                  c.name.c_str(), c.placed.parts[0].triangles.size(), wall_seconds() - start, cpu_seconds() - cpu,
                  double(c.scene.objects->bytes()) / double(c.placed.parts[0].triangles.size()), c.scene.objects->charts()[0].nodes.size(),
                  c.scene.objects->charts()[0].blocks.size());
      const double both = wall_seconds();
      { const TraceScene again = prepare(c.placed, orbc::testing::threads(2)); }
      std::printf("    on two threads in %.3f s\n", wall_seconds() - both);
      const std::string key = std::to_string(size) + " " + c.name;
      figures.add(key + " prepared on two threads, s", wall_seconds() - both);
      figures.add(key + " prepared, CPU s", cpu_seconds() - cpu);
      figures.add(key + " bytes a triangle", double(c.scene.objects->bytes()) / double(c.placed.parts[0].triangles.size()));
    }
    for (const Case& c : cases) {
      BvhCounts counts;
      std::uint64_t hits = 0;
      for (const Ray& ray : c.rays)
        hits +=
            c.scene.objects->closest_counted(ray, c.name == "S2" && ray.c > 0 ? kPi / ray.c : kInfinity, counts).triangle != kNoTriangle;
      const double n = static_cast<double>(c.rays.size());
      std::printf("%s: a camera ray visits %.2f nodes, %.2f blocks, %.3f candidates for %.3f hits\n", c.name.c_str(),
                  double(counts.nodes) / n, double(counts.blocks) / n, double(counts.candidates) / n, double(hits) / n);
    }
#ifdef ORBC_EMBREE
    const Embree embree(cases[0].placed.parts[0]);
#endif
    for (const int bounces : {0, 40}) {
      std::vector<Runner> runners;
#ifdef ORBC_EMBREE
      runners.push_back(runner("Embree", cases[0], bounces, [&](const Ray& ray) { return embree.closest(cases[0].scene, ray); }));
#endif
      for (const Case& c : cases) runners.push_back(runner(c.name, c, bounces, [&c](const Ray& ray) { return closest(c.scene, ray); }));
      for (const Case& c : cases)
        runners.push_back(
            {c.name, [&c, bounces](std::size_t begin, std::size_t end) { return streams(c, begin, end, bounces); }, {}, {}, {}});
      measure(runners, cases[0].rays.size(), repetitions, 1);
      print(size, bounces, runners);
      if (!threads) continue;
      std::vector<double> one, one_cpu;
      for (Runner& r : runners) one.push_back(r.rate()), one_cpu.push_back(r.median());
      measure(runners, cases[0].rays.size(), repetitions, 2);
      std::printf("        two threads over one:");
      for (std::size_t i = 0; i < runners.size(); ++i) {
        Runner& r = runners[i];
        std::sort(r.cpu.begin(), r.cpu.end());
        const double by_cpu = one_cpu[i] / r.cpu[r.cpu.size() / 2];
        std::printf("  %s %.2f (by CPU time %.2f)", r.name.c_str(), r.rate() / one[i], by_cpu);
        const std::string key =
            std::to_string(size) + (bounces ? " mirrors " : " camera ") + (i + 3 >= runners.size() ? "streams " : "singly ") + r.name;
        figures.add(key + " two threads over one", r.rate() / one[i]);
        figures.add(key + " two threads over one, CPU time", by_cpu);
      }
      std::printf("\n");
    }
  }
  if (!json.empty()) std::ofstream(json) << figures.text << "\n}\n";
}
