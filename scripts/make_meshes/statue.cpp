// A dancer in a long dress on a round plinth, an orb in her raised right hand. Looks along +x; z up; about 2.2 high.
#include "scripts/make_meshes/sdf.h"

namespace make_meshes {
namespace {

constexpr double kPlinth = 0.24;

double plinth(const Vector3& p) {
  double d = disc(p, 0, 0.09, 0.46, 0.012);
  d = blend(d, disc(p, 0.05, 0.2, 0.395, 0.01), 0.03);
  d = std::min(d, disc(p, 0.19, kPlinth, 0.43, 0.02));
  return d;
}

/// The middle of the body at a height: a gentle S.
Vector3 axis(double z) { return {-0.02 * std::sin(2.2 * z), 0.045 * std::sin(3.1 * (z - 0.35)) * smoothstep(0, 0.5, z), z}; }

double dress(const Vector3& p) {
  const double z = std::clamp(p.z, 0.0, 1.12);
  const Vector3 c = axis(z);
  const double x = p.x - c.x, y = p.y - c.y, angle = std::atan2(y, x);
  // From hem to waist: bell, knees, hips, waist.
  double r = 0.335 * (1 - smoothstep(0, 0.34, z)) + 0.205 * smoothstep(0, 0.34, z);
  r +=
      (0.188 - 0.205) * smoothstep(0.3, 0.72, z) + (0.182 - 0.188) * smoothstep(0.72, 0.9, z) + (0.112 - 0.182) * smoothstep(0.88, 1.12, z);
  const double depth = 0.125 * (1 - smoothstep(0.0, 0.9, z)) + 0.02 * (1 - smoothstep(0.8, 1.08, z));
  const double turn = angle + 1.15 * z + 0.35 * std::sin(2 * angle);
  r *= 1 + depth * (std::cos(11 * turn) * 0.8 + 0.2 * std::cos(22 * turn));
  const double side = (std::hypot(x * 1.08, y) - r) * 0.55;
  return std::max(side, p.z - 1.12);
}

double torso(const Vector3& p0) {
  Vector3 p = p0 - axis(std::clamp(p0.z, 0.9, 1.5));
  p.z = p0.z;
  const Vector3 q{p.x * 1.3, p.y, p.z};
  double d = cone(q, {0, 0, 0.98}, {0, 0, 1.13}, 0.16, 0.105);
  d = blend(d, cone(q, {0, 0, 1.13}, {0.01, 0, 1.34}, 0.103, 0.135), 0.05);
  d = blend(d, cone(q, {-0.01, -0.13, 1.425}, {-0.01, 0.13, 1.425}, 0.058, 0.058), 0.09);
  d *= 0.8;
  for (const double side : {-1.0, 1.0}) d = blend(d, ball(p, {0.062, 0.062 * side, 1.325}, 0.058), 0.045);
  // A belt.
  const double r = std::hypot(p.x * 1.25, p.y);
  d = blend(d, (std::hypot(r - 0.112, p.z - 1.115) - 0.013) * 0.8, 0.012);
  return d;
}

double head(const Vector3& p0) {
  // Tilted towards the raised hand.
  constexpr double kScale = 1.1;
  const Vector3 pivot = axis(1.5) + Vector3{0, 0, -0.005};
  const double a = 0.16, b = -0.2;
  Vector3 p = 1 / kScale * (p0 - pivot);
  p = {p.x, std::cos(a) * p.y - std::sin(a) * p.z, std::sin(a) * p.y + std::cos(a) * p.z};
  p = {std::cos(b) * p.x - std::sin(b) * p.z, p.y, std::sin(b) * p.x + std::cos(b) * p.z};
  double d = cone(p, {-0.012, 0, -0.09}, {0.0, 0, 0.08}, 0.048, 0.04);
  p.z += 0.02;
  double skull = ellipsoid(p, {0.005, 0, 0.205}, {0.092, 0.076, 0.096});
  skull = blend(skull, ellipsoid(p, {0.038, 0, 0.15}, {0.052, 0.05, 0.074}), 0.05);
  skull = blend(skull, ball(p, {0.066, 0, 0.1}, 0.022), 0.035);
  for (const double s : {-1.0, 1.0}) {
    skull = carve(skull, ellipsoid(p, {0.102, 0.032 * s, 0.192}, {0.026, 0.021, 0.014}), 0.022);
    skull = blend(skull, ellipsoid(p, {0.079, 0.031 * s, 0.19}, {0.013, 0.017, 0.0105}), 0.004);
  }
  skull = blend(skull, cone(p, {0.091, 0, 0.196}, {0.111, 0, 0.154}, 0.007, 0.0125), 0.014);
  skull = blend(skull, ellipsoid(p, {0.088, 0, 0.128}, {0.014, 0.022, 0.0065}), 0.007);
  skull = blend(skull, ellipsoid(p, {0.0855, 0, 0.1165}, {0.014, 0.018, 0.0065}), 0.006);
  d = blend(d, skull, 0.035);
  // Hair combed back from the forehead into a knot.
  const double comb = 0.0035 * std::sin(22 * std::atan2(p.y, p.z - 0.17)) * smoothstep(0.005, 0.05, std::hypot(p.y, p.z - 0.17));
  double hair = ellipsoid(p, {-0.012, 0, 0.218}, {0.106, 0.093, 0.102}) - comb;
  const double line = p.x - (-0.004 + 0.8 * (p.z - 0.16) - 5 * p.y * p.y);
  hair = carve(hair, -0.8 * line, 0.012);
  hair = carve(hair, p.z - 0.128, 0.02);
  const Vector3 k{-0.122, 0, 0.2};
  const Vector3 q = p - k;
  const double knot = ellipsoid(p, k, {0.05, 0.06, 0.058}) - 0.0035 * std::sin(4 * std::atan2(q.z, q.y) + 130 * std::hypot(q.y, q.z));
  return kScale * blend(blend(d, hair, 0.008), knot, 0.014);
}

struct Arms {
  std::vector<Knot> right, left, scarf;
  Arms() {
    const Vector3 c = axis(1.43);
    right = curve({{c + Vector3{-0.01, -0.15, 0.0}, 0.056},
                   {c + Vector3{0.02, -0.27, 0.06}, 0.046},
                   {c + Vector3{0.05, -0.4, 0.16}, 0.037},
                   {c + Vector3{0.09, -0.405, 0.31}, 0.036},
                   {c + Vector3{0.1, -0.36, 0.43}, 0.0225},
                   {c + Vector3{0.1, -0.345, 0.49}, 0.024}},
                  6);
    left = curve({{c + Vector3{-0.01, 0.15, 0.0}, 0.056},
                  {c + Vector3{-0.02, 0.26, -0.07}, 0.045},
                  {c + Vector3{-0.02, 0.375, -0.18}, 0.037},
                  {c + Vector3{0.05, 0.46, -0.27}, 0.034},
                  {c + Vector3{0.13, 0.53, -0.32}, 0.022},
                  {c + Vector3{0.175, 0.56, -0.335}, 0.021}},
                 6);
    // A shawl from arm to arm behind the back, its end hanging down from the left one.
    scarf = curve({{{0.05, -0.43, 1.49}, 0.012},
                   {{-0.03, -0.43, 1.57}, 0.02},
                   {{-0.17, -0.27, 1.26}, 0.022},
                   {{-0.245, -0.02, 1.02}, 0.024},
                   {{-0.2, 0.26, 1.0}, 0.022},
                   {{-0.03, 0.43, 1.17}, 0.02},
                   {{0.06, 0.485, 1.14}, 0.02},
                   {{0.05, 0.5, 0.98}, 0.019},
                   {{-0.01, 0.54, 0.82}, 0.018},
                   {{-0.03, 0.62, 0.68}, 0.017},
                   {{0.03, 0.67, 0.55}, 0.013}},
                  7);
  }
};

double hand(const Vector3& p, const Vector3& wrist, const Vector3& along, const Vector3& across, double curl) {
  const Vector3 up = cross(along, across);
  double d = cone(p, wrist, wrist + 0.045 * along, 0.021, 0.024);
  for (int f = 0; f < 4; ++f) {
    const double s = (f - 1.5) * 0.0135, l = f == 0 ? 0.85 : f == 3 ? 0.75 : 1;
    const Vector3 a = wrist + 0.05 * along + s * across, b = a + 0.04 * l * (along + (0.6 * s / 0.02) * across + curl * up),
                  c = b + 0.036 * l * (along + 2 * curl * up);
    d = blend(d, std::min(cone(p, a, b, 0.0098, 0.0085), cone(p, b, c, 0.0085, 0.0068)), 0.008);
  }
  const Vector3 t = wrist + 0.012 * along - 0.016 * across, u = t + 0.03 * along - 0.024 * across + 0.012 * up;
  return blend(d, std::min(cone(p, t, u, 0.011, 0.0095), cone(p, u, u + 0.026 * along + 0.012 * up, 0.0095, 0.0075)), 0.012);
}

}  // namespace

Field statue() {
  const Arms arms;
  return [arms](const Vector3& world) {
    double base = plinth(world);
    const Vector3 p = world - Vector3{0, 0, kPlinth};
    double body = blend(dress(p), torso(p), 0.03);
    const double limbs = std::min(limb(p, arms.right), limb(p, arms.left));
    body = blend(body, limbs, 0.028);
    body = blend(body, head(p), 0.03);
    const Vector3 c = axis(1.43);
    const Vector3 orb = c + Vector3{0.105, -0.33, 0.645};
    double d =
        blend(body, hand(p, arms.right.back().at, normalised(Vector3{0.0, 0.1, 1}), normalised(Vector3{-0.3, 1, -0.1}), -0.28), 0.014);
    d = blend(d, hand(p, arms.left.back().at, normalised(Vector3{0.8, 0.45, -0.12}), normalised(Vector3{0.45, -0.8, 0.1}), 0.12), 0.014);
    double shawl = 1e9;
    for (int strand = -1; strand <= 1; ++strand) {
      // The strands lie above each other behind the back, and side by side, a ribbon, where they hang.
      const double s = 0.034 * strand, hangs = smoothstep(1.1, 0.95, p.z) * smoothstep(0.3, 0.45, p.y);
      shawl = blend(shawl,
                    limb(p - Vector3{(-0.55 - 0.3 * smoothstep(0.9, 0.55, p.z)) * s * hangs, 0.012 * std::abs(strand), 0.8 * s}, arms.scarf),
                    0.022);
    }
    d = blend(d, shawl * 0.9, 0.008);
    d = blend(d, ball(p, orb, 0.085), 0.006);
    // Three rings round the orb.
    const Vector3 q = p - orb;
    for (const Vector3& n : {normalised(Vector3{0.2, 0.1, 1}), normalised(Vector3{1, 0.3, 0.1}), normalised(Vector3{-0.2, 1, 0.15})}) {
      const double h = dot(q, n);
      d = std::min(d, std::hypot(length(q - h * n) - 0.089, h) - 0.008);
    }
    return std::max(blend(base, d, 0.02), -world.z);
  };
}

}  // namespace make_meshes
