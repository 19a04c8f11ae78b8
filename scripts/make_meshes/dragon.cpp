// A dragon on a rock, seated, a pearl in its raised right claw, its head turned to its right, its tail curled round to its left: left,
// right and front can be told from anywhere, which is what mirror images are looked at for. Looks along +x; z up.
#include "scripts/make_meshes/sdf.h"

namespace make_meshes {
namespace {

constexpr double kRock = 0.09;

/// A distance to a flat triangle, rounded by `thick`. Source: Quilez, udTriangle.
double sail(const Vector3& p, const Vector3& a, const Vector3& b, const Vector3& c, double thick) {
  const Vector3 ba = b - a, pa = p - a, cb = c - b, pb = p - b, ac = a - c, pc = p - c, n = cross(ba, ac);
  const auto sign = [](double x) { return x > 0 ? 1 : x < 0 ? -1 : 0; };
  const auto edge = [](const Vector3& e, const Vector3& q) {
    const Vector3 d = std::clamp(dot(e, q) / dot(e, e), 0.0, 1.0) * e - q;
    return dot(d, d);
  };
  const bool beside = sign(dot(cross(ba, n), pa)) + sign(dot(cross(cb, n), pb)) + sign(dot(cross(ac, n), pc)) < 2;
  const double square = beside ? std::min({edge(ba, pa), edge(cb, pb), edge(ac, pc)}) : dot(n, pa) * dot(n, pa) / dot(n, n);
  return std::sqrt(square) - thick;
}

struct Sail {
  Vector3 a, b, c;
};

/// Everything that hangs together, with a ball around it: far from it nothing inside is looked at.
struct Part {
  Field field;
  Vector3 middle;
  double radius;
};

struct Wing {
  std::vector<std::vector<Knot>> bones;
  std::vector<Sail> sails;
};

Wing make_wing(double side, double lift) {
  const auto at = [&](double x, double y, double z) { return Vector3{x, side * y, z + lift * y}; };
  const Vector3 shoulder = at(0.02, 0.13, 0.86), elbow = at(-0.32, 0.4, 1.2), wrist = at(-0.06, 0.72, 1.5), root = at(-0.42, 0.16, 0.62);
  const Vector3 tips[] = {at(-0.5, 1.28, 1.52), at(-0.84, 1.1, 1.12), at(-0.92, 0.78, 0.84), at(-0.78, 0.42, 0.7)};
  Wing wing;
  wing.bones.push_back(curve({{shoulder, 0.075}, {elbow, 0.05}, {wrist, 0.04}}, 8));
  wing.bones.push_back({{wrist, 0.032}, {wrist + at(0.13, 0.02, 0.09) - at(0, 0, 0), 0.006}});
  for (int i = 0; i < 4; ++i) {
    const Vector3 from = i < 3 ? wrist : elbow, bend = mix(from, tips[i], 0.45) + at(0, 0.0, 0.07) - at(0, 0, 0);
    wing.bones.push_back(curve({{from, 0.03}, {bend, 0.022}, {tips[i], 0.008}}, 6));
  }
  const auto scallop = [&](const Vector3& from, const Vector3& s, const Vector3& t) {
    const Vector3 bend_s = mix(from, s, 0.45) + Vector3{0, 0, 0.07}, bend_t = mix(from, t, 0.45) + Vector3{0, 0, 0.07};
    const Vector3 hollow = mix(0.5 * (s + t), from, 0.2);
    wing.sails.insert(wing.sails.end(), {{from, bend_s, bend_t}, {bend_s, s, hollow}, {bend_s, hollow, bend_t}, {bend_t, hollow, t}});
  };
  scallop(wrist, tips[0], tips[1]);
  scallop(wrist, tips[1], tips[2]);
  const Vector3 bend = mix(wrist, tips[2], 0.45) + Vector3{0, 0, 0.07}, inner = mix(elbow, tips[3], 0.45) + Vector3{0, 0, 0.07};
  wing.sails.insert(wing.sails.end(), {{wrist, bend, elbow},
                                       {elbow, bend, inner},
                                       {bend, tips[2], mix(mix(tips[2], tips[3], 0.5), elbow, 0.2)},
                                       {bend, mix(mix(tips[2], tips[3], 0.5), elbow, 0.2), inner},
                                       {inner, mix(mix(tips[2], tips[3], 0.5), elbow, 0.2), tips[3]},
                                       {elbow, inner, root},
                                       {inner, mix(tips[3], root, 0.5), root},
                                       {inner, tips[3], mix(mix(tips[3], root, 0.5), elbow, 0.1)},
                                       {elbow, root, shoulder}});
  return wing;
}

double foot(const Vector3& p, const Vector3& at, const Vector3& forward, const Vector3& across, double size) {
  double d = 1e9;
  for (int toe = -1; toe <= 1; ++toe) {
    const Vector3 way = normalised(forward + (0.5 * toe) * across);
    const Vector3 knuckle = at + size * way + Vector3{0, 0, 0.1 * size}, end = knuckle + 0.75 * size * way - Vector3{0, 0, 0.45 * size};
    d = blend(d, cone(p, at, knuckle, 0.42 * size, 0.33 * size), 0.2 * size);
    d = blend(d, cone(p, knuckle, end, 0.27 * size, 0.05 * size), 0.06 * size);
  }
  return d;
}

}  // namespace

Field dragon() {
  const auto spine = curve({{{0.52, 0.66, 0.27}, 0.012},
                            {{0.38, 0.88, 0.1}, 0.028},
                            {{0.02, 1.0, 0.045}, 0.05},
                            {{-0.5, 0.93, 0.05}, 0.072},
                            {{-0.92, 0.6, 0.075}, 0.098},
                            {{-0.98, 0.16, 0.17}, 0.14},
                            {{-0.68, 0, 0.34}, 0.225},
                            {{-0.36, 0, 0.5}, 0.272},
                            {{-0.02, 0, 0.66}, 0.262},
                            {{0.2, 0, 0.86}, 0.205},
                            {{0.29, -0.01, 1.08}, 0.145},
                            {{0.25, -0.03, 1.28}, 0.112},
                            {{0.3, -0.06, 1.46}, 0.098},
                            {{0.44, -0.12, 1.55}, 0.092}},
                           8);
  const Vector3 skull{0.46, -0.13, 1.555}, ahead = normalised(Vector3{0.84, -0.5, -0.1}), aside = normalised(cross({0, 0, 1}, ahead)),
                                           above = cross(ahead, aside);
  const auto head_at = [=](double x, double y, double z) { return skull + x * ahead + y * aside + z * above; };
  std::vector<Part> parts;

  parts.push_back({[=](const Vector3& p) {
                     double d = limb(p, spine);
                     for (const double s : {-1.0, 1.0}) {
                       d = blend(d, ellipsoid(p, {-0.42, 0.235 * s, 0.34}, {0.27, 0.14, 0.25}), 0.08);
                       d = blend(d, ellipsoid(p, {0.16, 0.17 * s, 0.66}, {0.13, 0.1, 0.2}), 0.07);
                     }
                     return d;
                   },
                   {-0.2, 0.35, 0.7},
                   1.35});
  // Spikes from the neck to the tip of the tail.
  std::vector<std::pair<Knot, Knot>> spikes;
  for (std::size_t i = 5; i + 1 < spine.size(); i += 3) {
    const auto& k = spine[i];
    const Vector3 along = normalised(spine[i + 1].at - spine[i - 1].at);
    Vector3 up = Vector3{0, 0, 1} - dot(Vector3{0, 0, 1}, along) * along;
    if (along.z > 0.6) up = Vector3{-1, 0, 0.25} - dot(Vector3{-1, 0, 0.25}, along) * along;
    up = normalised(up);
    const double size = 0.05 + 0.42 * k.radius;
    spikes.push_back({{k.at + 0.8 * k.radius * up, 0.3 * size}, {k.at + k.radius * up + size * (up - 0.55 * along), 0.006}});
  }
  parts.push_back({[=](const Vector3& p) {
                     double d = 1e9;
                     for (const auto& [a, b] : spikes) d = std::min(d, cone(p, a.at, b.at, a.radius, b.radius));
                     return d;
                   },
                   {-0.2, 0.35, 0.7},
                   1.4});
  const std::vector<Knot> horn_knots = {
      {{-0.04, 0.055, 0.075}, 0.034}, {{-0.13, 0.085, 0.15}, 0.027}, {{-0.25, 0.11, 0.16}, 0.018}, {{-0.36, 0.13, 0.22}, 0.006}};
  std::vector<std::vector<Knot>> horns;
  for (const double s : {-1.0, 1.0}) {
    std::vector<Knot> horn, whisker;
    for (const auto& k : horn_knots) horn.push_back({head_at(k.at.x, s * k.at.y, k.at.z), k.radius});
    horns.push_back(curve(horn, 6));
    for (int fin = 0; fin < 3; ++fin) {
      horns.push_back({{head_at(-0.03 - 0.01 * fin, s * 0.07, 0.03 - 0.045 * fin), 0.028},
                       {head_at(-0.18 - 0.03 * fin, s * (0.19 - 0.03 * fin), 0.05 - 0.085 * fin), 0.006}});
    }
    horns.push_back(curve({{head_at(0.33, s * 0.03, -0.005), 0.014},
                           {head_at(0.36, s * 0.1, 0.0), 0.011},
                           {head_at(0.3, s * 0.19, -0.07), 0.009},
                           {head_at(0.34, s * 0.25, -0.16), 0.006}},
                          6));
  }
  parts.push_back({[=](const Vector3& p) {
                     double d = blend(ellipsoid(p, head_at(0.02, 0, 0.01), {0.125, 0.125, 0.1}),
                                      cone(p, head_at(0.06, 0, 0.015), head_at(0.31, 0, 0.005), 0.085, 0.052), 0.05);
                     d = blend(d, ball(p, head_at(0.335, 0, 0.022), 0.044), 0.03);
                     d = blend(d, cone(p, head_at(0.03, 0, -0.075), head_at(0.24, 0, -0.15), 0.058, 0.034), 0.03);
                     d = blend(d, ball(p, head_at(0.245, 0, -0.148), 0.036), 0.02);
                     for (const double s : {-1.0, 1.0}) {
                       d = blend(d, cone(p, head_at(-0.03, 0.07 * s, 0.09), head_at(0.14, 0.052 * s, 0.068), 0.026, 0.018), 0.02);
                       d = blend(d, ball(p, head_at(0.085, 0.07 * s, 0.045), 0.03), 0.006);
                       d = carve(d, ball(p, head_at(0.375, 0.026 * s, 0.045), 0.014), 0.01);
                       for (int tooth = 0; tooth < 3; ++tooth) {
                         d = blend(
                             d,
                             cone(p, head_at(0.2 + 0.05 * tooth, (0.046 - 0.006 * tooth) * s, -0.035),
                                  head_at(0.205 + 0.05 * tooth, (0.043 - 0.006 * tooth) * s, -0.085 + 0.012 * (tooth == 1)), 0.014, 0.005),
                             0.006);
                       }
                     }
                     for (const auto& horn : horns) d = blend(d, limb(p, horn), 0.014);
                     return d;
                   },
                   head_at(0, 0, 0), 0.5});
  // Left foreleg on the ground, right one raised with the pearl; hind legs.
  const auto left =
      curve({{{0.14, 0.2, 0.66}, 0.12}, {{0.06, 0.3, 0.4}, 0.088}, {{0.27, 0.29, 0.2}, 0.062}, {{0.36, 0.29, 0.065}, 0.06}}, 6);
  const auto right =
      curve({{{0.17, -0.2, 0.68}, 0.118}, {{0.24, -0.34, 0.46}, 0.085}, {{0.47, -0.34, 0.52}, 0.06}, {{0.6, -0.33, 0.6}, 0.052}}, 6);
  parts.push_back(
      {[=](const Vector3& p) {
         double d = blend(limb(p, left), foot(p, {0.38, 0.29, 0.06}, {1, 0.05, 0}, {0, 1, 0}, 0.125), 0.04);
         double claw = blend(limb(p, right), foot(p, {0.62, -0.33, 0.61}, normalised(Vector3{1, 0, 0.25}), {0, 1, 0}, 0.1), 0.03);
         claw = blend(claw, cone(p, {0.6, -0.33, 0.57}, {0.69, -0.33, 0.49}, 0.035, 0.02), 0.03);
         d = std::min(d, claw);
         d = blend(d, ball(p, {0.765, -0.33, 0.585}, 0.1), 0.006);
         for (const double s : {-1.0, 1.0}) {
           const auto hind =
               std::vector<Knot>{{{-0.36, 0.28 * s, 0.22}, 0.11}, {{-0.2, 0.33 * s, 0.08}, 0.075}, {{-0.05, 0.34 * s, 0.06}, 0.062}};
           d = blend(d, blend(limb(p, hind), foot(p, {-0.06, 0.34 * s, 0.055}, {1, 0.12 * s, 0}, {0, 1, 0}, 0.125), 0.04), 0.04);
         }
         return d;
       },
       {0.2, 0, 0.4},
       0.85});
  for (const double s : {-1.0, 1.0}) {
    const auto wing = make_wing(s, s < 0 ? 0.16 : -0.02);
    parts.push_back({[=](const Vector3& p) {
                       double bones = 1e9, skin = 1e9;
                       for (const auto& bone : wing.bones) bones = blend(bones, limb(p, bone), 0.02);
                       for (const auto& t : wing.sails) skin = blend(skin, sail(p, t.a, t.b, t.c, 0.0135), 0.012);
                       return blend(bones, skin, 0.016);
                     },
                     {-0.4, 0.7 * s, 1.15},
                     1.0});
  }
  return [=](const Vector3& world) {
    const Vector3 p = world - Vector3{0, 0, kRock};
    double d = 1e9;
    for (const auto& part : parts) {
      const double far = length(p - part.middle) - part.radius;
      if (far > std::min(d, 0.25) + 0.05) {
        d = std::min(d, std::max(far, 0.1));
        continue;
      }
      d = blend(d, part.field(p), 0.035);
    }
    // The rock: a round slab with a broken rim.
    const double angle = std::atan2(p.y - 0.1, p.x + 0.15), r = std::hypot(p.x + 0.15, p.y - 0.1);
    const double rim = 1.12 + 0.035 * std::sin(5 * angle + 0.6) + 0.025 * std::sin(9 * angle + 2) + 0.012 * std::sin(17 * angle);
    const double dx = r - rim + 0.03, dz = std::abs(p.z + 0.04) - 0.05 + 0.03;
    const double rock = (std::min(std::max(dx, dz), 0.0) + std::hypot(std::max(dx, 0.0), std::max(dz, 0.0)) - 0.03) * 0.9;
    return blend(d, rock, 0.03);
  };
}

}  // namespace make_meshes
