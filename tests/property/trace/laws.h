#pragma once
// Laws of the tracer that are counted over many random rays: small counts in the fast tests, large ones in the slow.
#include <complex>

#include "tests/unit/trace/support.h"

namespace orbc::trace::testing {

/// A closed bumpy ball around a centre: 2·around·(rings − 1) triangles, poles included.
inline place::PlacedMesh ball(Space space, const Point& centre, double radius, double z, int rings, int around, Random& random) {
  place::PlacedMesh mesh;
  const auto move = geometry::translation_to(space, centre);
  const auto add = [&](double r, double angle, double height) {
    mesh.floor.push_back(move * at_polar(space, r, angle));
    mesh.z.push_back(height);
    return static_cast<std::uint32_t>(mesh.z.size() - 1);
  };
  const std::uint32_t bottom = add(0, 0, z - radius);
  for (int i = 1; i < rings; ++i)
    for (int j = 0; j < around; ++j) {
      // Flat enough to be seen whole from near its centre
      const double latitude = -kPi / 2 + kPi * i / rings, r = radius * (1 - random.unit() * 0.3 / rings);
      add(r * std::cos(latitude), 2 * kPi * j / around, z + r * std::sin(latitude));
    }
  const std::uint32_t top = add(0, 0, z + radius);
  const auto id = [&](int i, int j) { return bottom + 1 + static_cast<std::uint32_t>((i - 1) * around + j % around); };
  for (int j = 0; j < around; ++j) {
    mesh.triangles.push_back({bottom, id(1, j + 1), id(1, j)});
    mesh.triangles.push_back({top, id(rings - 1, j), id(rings - 1, j + 1)});
    for (int i = 1; i + 1 < rings; ++i) {
      mesh.triangles.push_back({id(i, j), id(i, j + 1), id(i + 1, j + 1)});
      mesh.triangles.push_back({id(i, j), id(i + 1, j + 1), id(i + 1, j)});
    }
  }
  mesh.style.assign(mesh.triangles.size(), 0);
  return mesh;
}

inline place::Interior room_of(Space space) {
  return furnished(space == Space::hyperbolic  ? regular_room(space, 5, 2)
                   : space == Space::euclidean ? regular_room(space, 4, 2)
                                               : regular_room(space, 3, 2));
}

/// Rays from inside a closed surface, aimed at its vertices, the middles and other points of its edges: how many get out.
inline int leaks(Space space, int rays, std::uint64_t seed) {
  Random random{seed};
  int out = 0;
  for (const auto& [rings, around] : {std::pair{4, 5}, {20, 30}, {60, 100}}) {
    auto placed = room_of(space);
    const Point centre = at_polar(space, 0.1, 0.7);
    placed.parts.push_back(ball(space, centre, 0.3, 0.5, rings, around, random));
    placed.styles.resize(1);
    const TraceScene scene = prepare(placed);
    const auto& mesh = placed.parts[0];
    const auto move = geometry::translation_to(space, centre);
    for (int i = 0; i < rays; ++i) {
      const geometry::Position from{move * at_polar(space, 0.06 * random.unit(), random.between(0, 2 * kPi)),
                                    0.5 + random.between(-0.06, 0.06)};
      const auto& t = mesh.triangles[random.bits() % mesh.triangles.size()];
      const std::uint32_t a = t[random.bits() % 3], b = t[random.bits() % 3];
      const double u = i % 3 == 0 ? 0 : i % 3 == 1 ? 0.5 : random.unit();
      const Ambient sum = (1 - u) * mesh.floor[a] + u * mesh.floor[b];
      const geometry::Position to{geometry::normalised_point(space, sum), (1 - u) * mesh.z[a] + u * mesh.z[b]};
      const Segment segment = segment_between(space, from, to);
      const Hit hit = closest(scene, segment.ray);
      if (hit.kind != HitKind::triangle || hit.t > segment.length + 1e-9) ++out;
    }
  }
  return out;
}

/// Rays that leave hit points in random directions: how many meet something else than trying all triangles does, or their own start.
inline int wrong_departures(Space space, int rays, std::uint64_t seed) {
  Random random{seed};
  auto placed = room_of(space);
  placed.parts.push_back(ball(space, at_polar(space, 0.1, 0.7), 0.3, 0.5, 12, 16, random));
  placed.parts.push_back(soup_of(placed, 30, 0.3, random));
  placed.styles.resize(1);
  const TraceScene scene = prepare(placed);
  int wrong = 0;
  for (int i = 0; i < rays; ++i) {
    const Ray ray = random_ray(placed, random);
    const Hit hit = closest(scene, ray);
    const SurfacePoint point = surface_at(scene, ray, hit);
    Direction d = random_direction(space, point.at.floor, random);
    if (inner(space, d, point.normal) < 0) d = -d;
    if (std::fabs(inner(space, d, point.normal)) < 1e-3) continue;
    const Ray next = spawn_ray(scene, point, d);
    const double end = space == Space::spherical && next.c > 0 ? kPi / next.c : kInfinity;
    const Hit fast = closest_triangle(scene, next);
    const BvhHit slow = try_all(space, scene.objects->triangles(), next, end);
    const bool met = fast.kind == HitKind::triangle;
    if (met != (slow.triangle != kNoTriangle) || (met && std::fabs(fast.t - slow.t) > 1e-12)) ++wrong;
    if (met && hit.kind == HitKind::triangle && fast.part == hit.part && fast.triangle == hit.triangle && fast.t < 1e-6) ++wrong;
  }
  return wrong;
}

/// A path by numerical integration in the disk chart, mirrors and all, in long double: z″ = 2κ·z̄·z′²/(1 + κ|z|²) (conformal metric
/// 2|dz|/(1 + κ|z|²); E²: z″ = 0), fourth-order Runge–Kutta; walls are circles there, met by halving the step.
inline geometry::Position integrate(const place::Interior& placed, const Ray& ray, long double length, long double step) {
  using Complex = std::complex<long double>;
  const Space space = placed.polygon.space;
  const long double k = geometry::curvature(space);
  struct State {
    Complex z, dz;
  };
  const auto acceleration = [&](const State& s) { return 2 * k * std::conj(s.z) * s.dz * s.dz / (1 + k * std::norm(s.z)); };
  const auto advance = [&](const State& s, long double h) {
    const auto slope = [&](const State& at) { return State{at.dz, acceleration(at)}; };
    const auto plus = [](const State& at, const State& d, long double f) { return State{at.z + f * d.z, at.dz + f * d.dz}; };
    const State k1 = slope(s), k2 = slope(plus(s, k1, h / 2)), k3 = slope(plus(s, k2, h / 2)), k4 = slope(plus(s, k3, h));
    return State{s.z + h / 6 * (k1.z + 2.0L * k2.z + 2.0L * k3.z + k4.z), s.dz + h / 6 * (k1.dz + 2.0L * k2.dz + 2.0L * k3.dz + k4.dz)};
  };
  const auto value = [&](const room::Wall& wall, const Complex& z) -> long double {
    if (space == Space::euclidean) return wall.line.w + wall.line.x * z.real() + wall.line.y * z.imag();
    return wall.line.w * (1 - k * std::norm(z)) + 2 * (wall.line.x * z.real() + wall.line.y * z.imag());
  };
  const auto z0 = geometry::disk_from_point(space, ray.at);
  State s{Complex(z0.real(), z0.imag()), 0};
  // dz/ds of (x + iy)/(1 + w) along the tangent.
  const long double w1 = space == Space::euclidean ? 1 : 1 + (long double)ray.at.w;
  s.dz = (Complex(ray.along.x, ray.along.y) - (space == Space::euclidean ? 0 : (long double)ray.along.w) * s.z) / w1;
  long double left = ray.c * length;
  while (left > 0) {
    const long double h = std::min(step, left);
    const State next = advance(s, h);
    const room::Wall* met = nullptr;
    long double first = h;
    for (const auto& wall : placed.polygon.walls) {
      if (value(wall, next.z) >= 0) continue;
      long double lo = 0, hi = h;
      if (value(wall, s.z) <= 1e-17L) lo = std::min(h, 1e-12L);  // just reflected here
      for (int i = 0; i < 70; ++i) {
        const long double middle = (lo + hi) / 2;
        (value(wall, advance(s, middle).z) >= 0 ? lo : hi) = middle;
      }
      if (hi <= first) first = hi, met = &wall;
    }
    s = met ? advance(s, first) : next;
    left -= met ? first : h;
    if (!met) continue;
    const Complex line(met->line.x, met->line.y);
    Complex n = space == Space::euclidean ? line : line - k * (long double)met->line.w * s.z;
    n /= std::abs(n);
    s.dz -= 2 * (s.dz * std::conj(n)).real() * n;
  }
  return {geometry::point_from_disk(space, {static_cast<double>(s.z.real()), static_cast<double>(s.z.imag())}),
          ray.z + ray.m * static_cast<double>(length)};
}

}  // namespace orbc::trace::testing
