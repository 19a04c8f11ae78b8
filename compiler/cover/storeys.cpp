#include "compiler/cover/storeys.h"

#include <fmt/core.h>

#include <algorithm>
#include <cstdlib>

namespace orbc::cover {
namespace {

const place::PlacedMirror* mirror_of(const place::Interior& room, int surface) {
  for (const place::PlacedMirror& mirror : room.mirrors)
    if (mirror.wall == surface) return &mirror;
  return nullptr;
}

}  // namespace

bool has_storeys(const place::Interior& room) { return mirror_of(room, -1) || mirror_of(room, -2); }

std::vector<WeightedStorey> storeys_within(const place::Interior& room, int max_bounces) {
  std::vector<WeightedStorey> storeys(1);
  const place::PlacedMirror *floor = mirror_of(room, -1), *ceiling = mirror_of(room, -2);
  scene::Color up{1, 1, 1}, down{1, 1, 1};
  bool goes_up = true, goes_down = true;
  for (int n = 1; n <= max_bounces && (goes_up || goes_down); ++n) {
    // The first mirror upwards is the ceiling, the first one downwards the floor.
    const place::PlacedMirror *above = n % 2 == 1 ? ceiling : floor, *below = n % 2 == 1 ? floor : ceiling;
    goes_up = goes_up && above;
    goes_down = goes_down && below;
    const double sign = n % 2 == 1 ? -1 : 1;
    if (goes_up) {
      up = up * above->throughput;
      storeys.push_back({{n, sign, (n % 2 == 1 ? n + 1 : n) * room.height}, up});
    }
    if (goes_down) {
      down = down * below->throughput;
      storeys.push_back({{-n, sign, (n % 2 == 1 ? -n + 1 : -n) * room.height}, down});
    }
  }
  return storeys;
}

Result<std::vector<Copy>> with_storeys(const std::vector<Copy>& copies, const place::Interior& room, const scene::CoverSpec& spec,
                                       std::uint64_t max_copies) {
  const std::vector<WeightedStorey> storeys = storeys_within(room, std::max(0, spec.max_bounces));
  std::vector<std::vector<Copy>> by_bounces(static_cast<std::size_t>(std::max(0, spec.max_bounces)) + 1);
  const auto bounces_of = [](const Copy& copy, const WeightedStorey& s) { return copy.bounces + std::abs(s.storey.number); };
  std::vector<std::uint64_t> counts(by_bounces.size());
  std::uint64_t count = 0;
  for (const Copy& copy : copies) {
    for (const WeightedStorey& s : storeys) {
      const int bounces = bounces_of(copy, s);
      if (bounces > spec.max_bounces || max_channel(copy.weight * s.weight) < spec.min_weight) continue;
      ++counts[static_cast<std::size_t>(bounces)];
      ++count;
    }
  }
  if (count > max_copies) {
    int fits = 0;
    for (std::uint64_t sum = 0; fits < spec.max_bounces; ++fits) {
      sum += counts[static_cast<std::size_t>(fits)];
      if (sum + counts[static_cast<std::size_t>(fits) + 1] > max_copies) break;
    }
    return make_error(
        "cover.too-much",
        fmt::format("max_bounces: {} makes {} copies on {} storeys, {} are allowed", spec.max_bounces, count, storeys.size(), max_copies),
        fmt::format("max_bounces: {} fits", fits));
  }
  for (std::size_t b = 0; b < counts.size(); ++b) by_bounces[b].reserve(counts[b]);
  for (const Copy& copy : copies) {
    for (const WeightedStorey& s : storeys) {
      Copy on = copy;
      on.bounces = bounces_of(copy, s);
      on.weight = copy.weight * s.weight;
      on.storey = s.storey;
      if (on.bounces > spec.max_bounces || max_channel(on.weight) < spec.min_weight) continue;
      by_bounces[static_cast<std::size_t>(on.bounces)].push_back(std::move(on));
    }
  }
  std::vector<Copy> all;
  all.reserve(count);
  for (auto& bucket : by_bounces) {
    for (Copy& copy : bucket) all.push_back(std::move(copy));
    std::vector<Copy>().swap(bucket);
  }
  return all;
}

}  // namespace orbc::cover
