#include "compiler/cover/plan.h"

#include <fmt/core.h>

#include <algorithm>
#include <cstdlib>

#include "compiler/cover/beam.h"
#include "compiler/cover/enumeration_limits.h"
#include "compiler/cover/storeys.h"
#include "compiler/cover/unfold.h"
#include "compiler/notation/growth.h"

namespace orbc::cover {
namespace {

/// Copies by bounces. `complete`: false when counting stopped because the total exceeded its bound.
struct Counts {
  std::vector<Integer> by_bounces;
  Integer total = 0;
  bool complete = true;
};

bool is_whole_group(const EnumerationLimits& limits) {
  return limits.min_pixels <= 0 && std::find(limits.has_mirror.begin(), limits.has_mirror.end(), false) == limits.has_mirror.end();
}

Counts counts_up_to(const Integer& max_copies, const std::vector<Integer>& by_bounces) {
  Counts counts;
  for (const Integer& n : by_bounces) {
    counts.by_bounces.push_back(n);
    counts.total += n;
    if (counts.total > max_copies) {
      counts.complete = false;
      break;
    }
  }
  return counts;
}

Counts from_series(const EnumerationLimits& limits, const notation::Orbifold& orbifold, const Integer& max_copies) {
  if (limits.bounces_per_half_turn > 0) {
    const auto lengths = notation::copies_per_length(orbifold, limits.bounces_per_half_turn);
    std::vector<Integer> by_bounces(static_cast<std::size_t>(limits.max_bounces) + 1);
    for (int sheet = 0; sheet < limits.sheets; ++sheet) {
      for (std::size_t length = 0; length < lengths.size(); ++length) {
        const int bounces = bounces_on_sheet(limits, static_cast<int>(length), sheet);
        if (bounces <= limits.max_bounces) by_bounces[static_cast<std::size_t>(bounces)] += lengths[length];
      }
    }
    while (by_bounces.back() == 0) by_bounces.pop_back();
    return counts_up_to(max_copies, by_bounces);
  }
  // Growth may be exponential, so the series is computed only as far as it is needed.
  for (int length = 32;; length *= 2) {
    const bool last = length >= limits.max_bounces;
    Counts counts = counts_up_to(max_copies, notation::copies_per_length(orbifold, last ? limits.max_bounces : length));
    if (last || !counts.complete) return counts;
  }
}

Counts count_by_visiting(const EnumerationLimits& limits, const place::Interior& room, const place::Camera& eye,
                         const Integer& max_copies) {
  std::vector<std::uint64_t> by_bounces(static_cast<std::size_t>(limits.max_bounces) + 1);
  // A depth-first enumeration that stops early has counted no length completely. So an excess is counted again with fewer bounces.
  const std::uint64_t limit = max_copies > 100'000'000 ? 100'000'000 : static_cast<std::uint64_t>(max_copies);
  for (int bounces = limits.max_bounces;; bounces /= 2) {
    EnumerationLimits part = limits;
    part.max_bounces = bounces;
    std::fill(by_bounces.begin(), by_bounces.end(), 0);
    std::uint64_t total = 0;
    for (int sheet = 0; sheet < limits.sheets && total <= limit; ++sheet) {
      visit_copies(part, room, eye, [&](const Element& element, const geometry::Isometry&) {
        const int b = bounces_on_sheet(limits, static_cast<int>(element.word.size()), sheet);
        if (b > bounces) return Visit::descend;
        ++by_bounces[static_cast<std::size_t>(b)];
        return ++total > limit ? Visit::stop : Visit::descend;
      });
    }
    if (total > limit && bounces > 0) continue;
    Counts counts;
    for (const std::uint64_t n : by_bounces) {
      counts.by_bounces.emplace_back(n);
      counts.total += n;
    }
    while (counts.by_bounces.size() > 1 && counts.by_bounces.back() == 0) counts.by_bounces.pop_back();
    counts.complete = bounces == limits.max_bounces;
    return counts;
  }
}

Counts count_copies(const EnumerationLimits& limits, const place::Interior& room, const place::Camera& eye, const Integer& max_copies) {
  return is_whole_group(limits) ? from_series(limits, room.polygon.orbifold, max_copies) : count_by_visiting(limits, room, eye, max_copies);
}

/// Counts every copy on every storey: the counts of both, by bounces, are multiplied like polynomials.
Counts multiplied_by_storeys(const Counts& flat, const EnumerationLimits& limits, const place::Interior& room,
                             const scene::CoverSpec& spec) {
  const auto storeys = storeys_within(room, spec.max_bounces);
  Counts counts;
  counts.complete = flat.complete;
  counts.by_bounces.resize(static_cast<std::size_t>(std::max(0, spec.max_bounces)) + 1);
  for (std::size_t b = 0; b < flat.by_bounces.size(); ++b) {
    for (const WeightedStorey& s : storeys) {
      const std::size_t bounces = b + static_cast<std::size_t>(std::abs(s.storey.number));
      const scene::Color weight = limits.weight_by_bounces[b] * s.weight;
      if (bounces >= counts.by_bounces.size() || max_channel(weight) < spec.min_weight) continue;
      counts.by_bounces[bounces] += flat.by_bounces[b];
      counts.total += flat.by_bounces[b];
    }
  }
  while (counts.by_bounces.size() > 1 && counts.by_bounces.back() == 0) counts.by_bounces.pop_back();
  return counts;
}

Counts count_by_bounces(const std::vector<Copy>& copies) {
  Counts counts;
  for (const Copy& copy : copies) {
    counts.by_bounces.resize(std::max(counts.by_bounces.size(), static_cast<std::size_t>(copy.bounces) + 1));
    ++counts.by_bounces[static_cast<std::size_t>(copy.bounces)];
  }
  counts.total = copies.size();
  return counts;
}

Diagnostic too_much(const Counts& counts, int max_bounces, const Integer& max_copies, const std::string& limit) {
  // `fits` becomes the largest number of bounces whose copies all fit.
  Integer sum = 0;
  int fits = -1;
  for (const Integer& n : counts.by_bounces) {
    sum += n;
    if (sum > max_copies) break;
    ++fits;
  }
  const std::string hint = fits < 0 ? std::string("not even the room itself fits: use coarser meshes or allow more memory")
                                    : fmt::format("max_bounces: {} fits", std::min(fits, max_bounces));
  return make_error("cover.too-much", fmt::format("max_bounces: {} unfolds more copies than {}", max_bounces, limit), hint);
}

Plan empty_plan(const place::Interior& room) {
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

Plan with_counts(Plan plan, Counts counts) {
  plan.copies = counts.total;
  plan.copies_per_bounces = std::move(counts.by_bounces);
  const auto copies = static_cast<std::uint64_t>(plan.copies);
  plan.triangles = copies * plan.room_triangles;
  plan.vertices = copies * plan.room_vertices;
  plan.bytes = copies * bytes_per_copy(plan);
  return plan;
}

}  // namespace

Result<Plan> plan(const place::Interior& room, const place::Camera& eye, const scene::CoverSpec& spec, const PlanOptions& options) {
  Plan plan = empty_plan(room);
  const auto each = static_cast<std::uint64_t>(kBytesPerCopy);
  const Integer max_copies = options.max_bytes / each;
  Counts counts;
  if (needs_beams(room)) {
    const auto copies = unfold(room, eye, spec);
    if (!copies) return copies.error();
    counts = count_by_bounces(*copies);
    for (const Copy& copy : *copies) plan.sheets = std::max(plan.sheets, copy.sheet + 1);
  } else {
    const EnumerationLimits limits = enumeration_limits(room, spec);
    plan.sheets = limits.sheets;
    counts = count_copies(limits, room, eye, max_copies);
    if (has_storeys(room)) counts = multiplied_by_storeys(counts, limits, room, spec);
  }
  if (!counts.complete || counts.total > max_copies)
    return too_much(counts, spec.max_bounces, max_copies, fmt::format("{} MiB hold ({} bytes each)", options.max_bytes >> 20, each));
  return with_counts(std::move(plan), std::move(counts));
}

Plan plan_of(const std::vector<Copy>& copies, const place::Interior& room) {
  Plan plan = empty_plan(room);
  for (const Copy& copy : copies) plan.sheets = std::max(plan.sheets, copy.sheet + 1);
  return with_counts(std::move(plan), count_by_bounces(copies));
}

Diagnostic too_many_copies(const place::Interior& room, const place::Camera& eye, const scene::CoverSpec& spec, std::uint64_t max_copies) {
  const EnumerationLimits limits = enumeration_limits(room, spec);
  const Counts counts = count_copies(limits, room, eye, max_copies);
  return too_much(counts, limits.max_bounces, max_copies, fmt::format("{} copies allowed", max_copies));
}

}  // namespace orbc::cover
