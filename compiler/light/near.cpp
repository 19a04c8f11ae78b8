#include "compiler/light/near.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "compiler/base/elementary.h"
#include "compiler/geometry/chart.h"
#include "compiler/light/shade.h"

namespace orbc::light {
namespace {

using geometry::Space;

constexpr int kAcross = 12, kUp = 4;
constexpr std::size_t kMaxImagesForFlatList = 8;     // images: to look at them all costs no more than to look up which

int cell_of(double at, int cells) { return at > 0 ? static_cast<int>(std::min(at * cells, cells - 1.0)) : 0; }

}  // namespace

NearImages near_images(const LightField& field, const Executor& executor) {
  NearImages near;
  const Space space = field.scene.prism.space;
  if (field.images.size() <= kMaxImagesForFlatList || space == Space::spherical) {
    near.images[0].resize(field.images.size());
    std::iota(near.images[0].begin(), near.images[0].end(), 0u);
    return near;
  }
  const place::PlacedRoom& room = *field.scene.room;
  near.height = room.height, near.across = kAcross, near.up = kUp;
  for (const geometry::Point& p : room.room.outline) near.reach = std::max(near.reach, math::abs(geometry::disk_from_point(space, p)));
  near.images.resize(static_cast<std::size_t>(kAcross) * kAcross * kUp);
  executor(near.images.size(), [&](std::size_t cell) {
    const auto number = static_cast<int>(cell);
    const int i = number % kAcross, j = number / kAcross % kAcross, k = number / kAcross / kAcross;
    const double size = 2 * near.reach / kAcross, half = size / std::numbers::sqrt2;
    const std::complex<double> middle(-near.reach + (i + 0.5) * size, -near.reach + (j + 0.5) * size);
    const double outer = std::min(near.reach, math::abs(middle) + half);
    if (math::abs(middle) - half > near.reach) return;   // no point of the room is there
    // The disk's lengths are at most 2/(1 − ρ²) times those of the paper; the way to a point of the room stays in its circle.
    const std::complex<double> centre = math::abs(middle) > near.reach ? near.reach / math::abs(middle) * middle : middle;
    const double stretch = space == Space::euclidean ? 1 : 2 / std::max(1e-9, 1 - outer * outer);
    const double rise = near.height / kUp;
    const geometry::Position at{geometry::point_from_disk(space, centre), (k + 0.5) * rise};
    near.images[cell] = images_near(field, at, math::hypot((half + math::abs(middle - centre)) * stretch, rise / 2), 1 / std::numbers::pi);
  });
  return near;
}

const std::vector<std::uint32_t>& images_at(const LightField& field, const geometry::Position& at) {
  const NearImages& near = field.near;
  if (near.across == 0) return near.images.front();
  const std::complex<double> z = geometry::disk_from_point(field.scene.prism.space, at.floor);
  const int i = cell_of((z.real() / near.reach + 1) / 2, near.across), j = cell_of((z.imag() / near.reach + 1) / 2, near.across),
            k = cell_of(at.z / near.height, near.up);
  return near.images[static_cast<std::size_t>((k * near.across + j) * near.across + i)];
}

}  // namespace orbc::light
