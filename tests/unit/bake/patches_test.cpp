#include "compiler/bake/patches.h"

#include <catch2/catch.hpp>

#include "compiler/bake/patch_texels.h"
#include "compiler/image/srgb.h"

using namespace orbc;
using bake::TexelPatch;

namespace {

/// A unit square of the plane on the floor: two triangles, whose common edge is the diagonal from (1, 0) to (0, 1).
place::Interior square(std::uint16_t second_style) {
  place::Interior interior;
  interior.polygon.space = geometry::Space::euclidean;
  interior.styles.resize(2);
  place::PlacedMesh part;
  part.kind = place::PartKind::floor;
  part.floor = {{1, 0, 0}, {1, 1, 0}, {1, 0, 1}, {1, 1, 1}};
  part.z = {0, 0, 0, 0};
  part.triangles = {{0, 1, 2}, {2, 1, 3}};
  part.style = {0, second_style};
  interior.parts = {part};
  return interior;
}

std::vector<TexelPatch> patches_of(const place::Interior& interior) {
  return bake::make_patches(interior, 0, surface::part_normals(interior, interior.parts[0]));
}

std::array<double, 2> position(const place::PlacedMesh& mesh, const bake::BarycentricPoint& at) {
  std::array<double, 2> sum{0, 0};
  for (std::size_t k = 0; k < 3; ++k) {
    const geometry::Point& corner = mesh.floor[mesh.triangles[at.triangle][k]];
    sum[0] += at.b[k] * corner.x;
    sum[1] += at.b[k] * corner.y;
  }
  return sum;
}

}  // namespace

TEST_CASE("two triangles of one style are a patch across their longest edge, others stay single", "[bake]") {
  const place::Interior same = square(0);
  const std::vector<TexelPatch> pair = patches_of(same);
  REQUIRE(pair.size() == 1);
  CHECK(pair[0].second == 1);
  CHECK(pair[0].length_u == Approx(1));
  CHECK(pair[0].length_v == Approx(1));
  const std::vector<TexelPatch> singles = patches_of(square(1));
  REQUIRE(singles.size() == 2);
  CHECK(singles[0].second == -1);
  CHECK(singles[1].first == 1);
}

TEST_CASE("points of a patch lie between its corners, in both triangles", "[bake]") {
  const place::Interior interior = square(0);
  const place::PlacedMesh& mesh = interior.parts[0];
  const TexelPatch patch = patches_of(interior)[0];
  const auto corner = [&](bool far_u, bool far_v) {
    const bake::PatchCorner at = bake::corner_of(patch, far_u, far_v);
    const geometry::Point& p = mesh.floor[mesh.triangles[at.triangle][at.k]];
    return std::array<double, 2>{p.x, p.y};
  };
  const auto origin = corner(false, false), to_u = corner(true, false), to_v = corner(false, true), far = corner(true, true);
  for (const double u : {0.0, 0.25, 0.6, 1.0})
    for (const double v : {0.0, 0.3, 0.75, 1.0}) {
      const auto at = position(mesh, bake::barycentric_point(patch, u, v));
      for (std::size_t c = 0; c < 2; ++c)
        CHECK(at[c] == Approx(origin[c] + u * (to_u[c] - origin[c]) + v * (to_v[c] - origin[c])).margin(1e-12));
    }
  for (std::size_t c = 0; c < 2; ++c) CHECK(far[c] == Approx(to_u[c] + to_v[c] - origin[c]).margin(1e-12));
  const auto inset = position(mesh, bake::inset_point(patch, 1, 1, 0.1));
  for (std::size_t c = 0; c < 2; ++c) CHECK(inset[c] == Approx(far[c] + 0.1 * (0.5 - far[c])).margin(1e-12));
}

TEST_CASE("texels of a patch are found again in the picture, below what was there, and interpolated in linear light", "[bake]") {
  const place::Interior interior = square(0);
  bake::ColorGrid colors{3, 2, {}};
  for (int i = 0; i < 6; ++i) colors.color.push_back({0.1 * i, 0.5, 1.0 - 0.1 * i});
  const bake::PatchTexels texels = bake::encode_texels(interior, patches_of(interior)[0], colors, true);
  REQUIRE(texels.rgba.size() == 6);
  CHECK(texels.rgba[5][0] == image::encode_srgb8(0.5));
  CHECK(texels.rgb16[5][0] == image::encode_srgb16(0.5));
  CHECK(texels.rgba[5][3] == 255);
  image::Image base{16, 2, std::vector<std::uint8_t>(16 * 2 * 4, 7)};
  const auto packed = bake::pack_below({{3, 2}}, base.width, base.height, 64);
  REQUIRE(packed);
  const image::Image picture = bake::assemble_image(base, {{texels.rgba.data(), texels.rgb16.data()}}, *packed);
  CHECK(std::equal(base.rgba.begin(), base.rgba.end(), picture.rgba.begin()));
  const auto red = [&](double u, double v) { return bake::color_in_rect(picture, packed->rects[0], u, v).r; };
  for (const int i : {0, 1, 2}) CHECK(red(i / 2.0, 0) == Approx(0.1 * i).margin(4e-3));
  CHECK(red(0.25, 0) == Approx((red(0, 0) + red(0.5, 0)) / 2));
  CHECK(red(1, 0.5) == Approx((red(1, 0) + red(1, 1)) / 2));
  CHECK(red(7, 7) == red(1, 1));
}
