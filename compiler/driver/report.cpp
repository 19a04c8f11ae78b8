// What was made, or would be, as JSON.
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "compiler/base/elementary.h"
#include "compiler/driver/compile.h"

namespace orbc::driver {
namespace {

/// Of a bearing, counter-clockwise from the x direction of the eye.
double degrees_of(const cover::Bearing& b) { return math::atan2(b.y, b.x) * 180 / std::numbers::pi; }

}  // namespace

std::string plan_json(const cover::Plan& plan) {
  std::vector<std::uint64_t> copies_per_bounces;
  for (const Integer& copies : plan.copies_per_bounces) copies_per_bounces.push_back(static_cast<std::uint64_t>(copies));
  const nlohmann::ordered_json json{{"copies", static_cast<std::uint64_t>(plan.copies)},
                                    {"copies_per_bounces", copies_per_bounces},
                                    {"sheets", plan.sheets},
                                    {"triangles", plan.triangles},
                                    {"vertices", plan.vertices},
                                    {"bytes", plan.bytes}};
  return json.dump(2) + "\n";
}

std::string report_json(const Compiled& compiled) {
  const Report& r = compiled.report;
  nlohmann::ordered_json json{
      {"orbifold", compiled.product.title},
      {"copies", r.copies},
      {"vertices", r.vertices},
      {"triangles", r.triangles},
      {"triangles_without_levels", r.triangles_at_full_detail},
      {"beams", r.beams},
      {"words", r.words},
      {"longest_word", r.longest_word},
      {"error_bound_px", r.error_bound_px},
      {"tolerance_px", r.tolerance_px},
      {"copies_left_out", r.culled},
      {"left_out_px", r.cull_px},
      {"weight_lost", r.weight_lost},
      {"weight_merged", r.weight_culled},
      {"curtains", r.impostors},
      {"curtains_dropped", r.impostors_dropped},
      {"atlas", {compiled.product.atlas.width, compiled.product.atlas.height}},
      {"lamps", compiled.product.native ? compiled.product.native->lamps.size() : 0},
      {"highlights", {{"copies", r.highlights.copies}, {"copies_without", r.highlights.copies_left_out}, {"texels", r.highlights.texels}}}};
  if (!r.lods.empty()) {
    nlohmann::ordered_json& levels = json["levels"] = nlohmann::ordered_json::array();
    for (const LodSummary& of : r.lods) levels.push_back({{"part", of.part}, {"triangles", of.triangles}, {"error", of.surface_offset}});
  }
  nlohmann::ordered_json& list = json["list"] = nlohmann::ordered_json::array();
  const std::vector<ProductCopy>& copies = compiled.product.copies;
  std::vector<std::size_t> triangles(copies.size());
  for (std::size_t i = 0; i < copies.size(); ++i) triangles[copies[i].duplicate_of.value_or(i)] += copies[i].index_count / 3;
  for (std::size_t i = 0; i < copies.size(); ++i) {
    const ProductCopy& c = copies[i];
    if (!is_listed(c)) continue;
    list.push_back({{"word", cover::to_string(c.word)},
                    {"bounces", c.bounces},
                    {"sheet", c.sheet},
                    {"mirrored", c.reversing},
                    {"weight", {c.weight.r, c.weight.g, c.weight.b}},
                    {"distance", c.distance},
                    {"triangles", triangles[i]},
                    {"level", c.level}});
    if (c.storey != 0) list.back()["storey"] = c.storey;
    if (c.wedge) list.back()["wedge_deg"] = {degrees_of(c.wedge->from), degrees_of(c.wedge->to)};
  }
  return json.dump(1) + "\n";
}

}  // namespace orbc::driver
