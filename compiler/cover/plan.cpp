#include "compiler/cover/plan.h"

#include <fmt/core.h>

#include <algorithm>
#include <cstdlib>

#include "compiler/cover/beam.h"
#include "compiler/cover/reach.h"
#include "compiler/cover/storeys.h"
#include "compiler/cover/unfold.h"
#include "compiler/notation/growth.h"

namespace orbc::cover {
namespace {

/// Copies by bounces, up to the first count above `most`.
struct Counts {
  std::vector<Integer> by_bounces;
  Integer total = 0;
  bool complete = true;
};

bool whole_group(const Reach& reach) {
  return reach.min_pixels <= 0 && std::find(reach.open.begin(), reach.open.end(), false) == reach.open.end();
}

void count_to(Counts& counts, const std::vector<Integer>& by_bounces, const Integer& most) {
  counts = {};
  for (const Integer& n : by_bounces) {
    counts.by_bounces.push_back(n);
    counts.total += n;
    if (counts.total > most) {
      counts.complete = false;
      return;
    }
  }
}

Counts from_series(const Reach& reach, const notation::Orbifold& orbifold, const Integer& most) {
  Counts counts;
  if (reach.half_turn > 0) {
    const auto lengths = notation::copies_per_length(orbifold, reach.half_turn);
    std::vector<Integer> by_bounces(static_cast<std::size_t>(reach.max_bounces) + 1);
    for (int sheet = 0; sheet < reach.sheets; ++sheet) {
      for (std::size_t length = 0; length < lengths.size(); ++length) {
        const int bounces = bounces_on(reach, static_cast<int>(length), sheet);
        if (bounces <= reach.max_bounces) by_bounces[static_cast<std::size_t>(bounces)] += lengths[length];
      }
    }
    while (by_bounces.back() == 0) by_bounces.pop_back();
    count_to(counts, by_bounces, most);
    return counts;
  }
  // Growth may be exponential: lengths are asked for only as far as needed.
  for (int length = 32;; length *= 2) {
    const bool last = length >= reach.max_bounces;
    count_to(counts, notation::copies_per_length(orbifold, last ? reach.max_bounces : length), most);
    if (last || !counts.complete) return counts;
  }
}

Counts by_walking(const Reach& reach, const place::PlacedRoom& room, const place::Eye& eye, const Integer& most) {
  std::vector<std::uint64_t> by_bounces(static_cast<std::size_t>(reach.max_bounces) + 1);
  // Depth first, a walk that stops early knows no length to the end; so what is too much is counted again with fewer bounces.
  const std::uint64_t limit = most > 100'000'000 ? 100'000'000 : static_cast<std::uint64_t>(most);
  for (int bounces = reach.max_bounces;; bounces /= 2) {
    Reach part = reach;
    part.max_bounces = bounces;
    std::fill(by_bounces.begin(), by_bounces.end(), 0);
    std::uint64_t total = 0;
    for (int sheet = 0; sheet < reach.sheets && total <= limit; ++sheet) {
      walk_reach(part, room, eye, [&](const Element& element, const geometry::Isometry&) {
        const int b = bounces_on(reach, static_cast<int>(element.word.size()), sheet);
        if (b > bounces) return Walk::deeper;
        ++by_bounces[static_cast<std::size_t>(b)];
        return ++total > limit ? Walk::stop : Walk::deeper;
      });
    }
    if (total > limit && bounces > 0) continue;
    Counts counts;
    for (const std::uint64_t n : by_bounces) counts.by_bounces.emplace_back(n), counts.total += n;
    while (counts.by_bounces.size() > 1 && counts.by_bounces.back() == 0) counts.by_bounces.pop_back();
    counts.complete = bounces == reach.max_bounces;
    return counts;
  }
}

Counts count_copies(const Reach& reach, const place::PlacedRoom& room, const place::Eye& eye, const Integer& most) {
  return whole_group(reach) ? from_series(reach, room.room.orbifold, most) : by_walking(reach, room, eye, most);
}

/// Each copy on each storey: the counts of both by bounces, multiplied like polynomials.
Counts on_storeys(const Counts& flat, const Reach& reach, const place::PlacedRoom& room, const scene::CoverSpec& spec) {
  const auto storeys = storeys_of(room, spec.max_bounces);
  Counts counts;
  counts.complete = flat.complete;
  counts.by_bounces.resize(static_cast<std::size_t>(std::max(0, spec.max_bounces)) + 1);
  for (std::size_t b = 0; b < flat.by_bounces.size(); ++b) {
    for (const WeightedStorey& s : storeys) {
      const std::size_t bounces = b + static_cast<std::size_t>(std::abs(s.storey.number));
      const scene::Color weight = reach.weight[b] * s.weight;
      if (bounces >= counts.by_bounces.size() || std::max({weight.r, weight.g, weight.b}) < spec.min_weight) continue;
      counts.by_bounces[bounces] += flat.by_bounces[b];
      counts.total += flat.by_bounces[b];
    }
  }
  while (counts.by_bounces.size() > 1 && counts.by_bounces.back() == 0) counts.by_bounces.pop_back();
  return counts;
}

Counts count_seen(const std::vector<Copy>& copies) {
  Counts counts;
  for (const Copy& copy : copies) {
    counts.by_bounces.resize(std::max(counts.by_bounces.size(), static_cast<std::size_t>(copy.bounces) + 1));
    ++counts.by_bounces[static_cast<std::size_t>(copy.bounces)];
  }
  counts.total = copies.size();
  return counts;
}

Diagnostic too_much(const Counts& counts, int max_bounces, const Integer& most, const std::string& limit) {
  // The largest number of bounces whose copies all fit.
  Integer sum = 0;
  int fits = -1;
  for (const Integer& n : counts.by_bounces) {
    sum += n;
    if (sum > most) break;
    ++fits;
  }
  const std::string hint = fits < 0 ? std::string("not even the room itself fits: use coarser meshes or allow more memory")
                                    : fmt::format("max_bounces: {} fits", std::min(fits, max_bounces));
  return make_error("cover.too-much", fmt::format("max_bounces: {} unfolds more copies than {}", max_bounces, limit), hint);
}

Plan empty_plan(const place::PlacedRoom& room) {
  Plan plan;
  for (const auto& part : room.parts) {
    plan.room_triangles += part.triangles.size();
    plan.room_vertices += part.floor.size();
  }
  return plan;
}

std::uint64_t bytes_per_copy(const Plan& plan) {
  return static_cast<std::uint64_t>(kBytesPerVertex * static_cast<double>(plan.room_vertices) +
                                    kBytesPerTriangle * static_cast<double>(plan.room_triangles) + kBytesPerCopy);
}

void take(Counts counts, Plan& plan) {
  plan.copies = counts.total;
  plan.copies_per_bounces = std::move(counts.by_bounces);
  const auto copies = static_cast<std::uint64_t>(plan.copies);
  plan.triangles = copies * plan.room_triangles;
  plan.vertices = copies * plan.room_vertices;
  plan.bytes = copies * bytes_per_copy(plan);
}

}  // namespace

Result<Plan> plan(const place::PlacedRoom& room, const place::Eye& eye, const scene::CoverSpec& spec, const PlanOptions& options) {
  Plan plan = empty_plan(room);
  const auto each = static_cast<std::uint64_t>(kBytesPerCopy);
  const Integer most = options.max_bytes / each;
  Counts counts;
  if (needs_beams(room)) {
    const auto copies = unfold(room, eye, spec);
    if (!copies) return copies.error();
    counts = count_seen(*copies);
    for (const Copy& copy : *copies) plan.sheets = std::max(plan.sheets, copy.sheet + 1);
  } else {
    const auto reach = reach_of(room, spec);
    if (!reach) return reach.error();
    plan.sheets = reach->sheets;
    counts = count_copies(*reach, room, eye, most);
    if (has_storeys(room)) counts = on_storeys(counts, *reach, room, spec);
  }
  if (!counts.complete || counts.total > most)
    return too_much(counts, spec.max_bounces, most, fmt::format("{} MiB hold ({} bytes each)", options.max_bytes >> 20, each));
  take(std::move(counts), plan);
  return plan;
}

Plan plan_of(const std::vector<Copy>& copies, const place::PlacedRoom& room) {
  Plan plan = empty_plan(room);
  for (const Copy& copy : copies) plan.sheets = std::max(plan.sheets, copy.sheet + 1);
  take(count_seen(copies), plan);
  return plan;
}

Diagnostic too_many_copies(const place::PlacedRoom& room, const place::Eye& eye, const scene::CoverSpec& spec, std::uint64_t most) {
  const auto reach = reach_of(room, spec);
  return too_much(count_copies(*reach, room, eye, most), reach->max_bounces, most, fmt::format("{} copies allowed", most));
}

}  // namespace orbc::cover
