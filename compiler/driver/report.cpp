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

std::string plan_json(const cover::Plan& p) {
  std::string per_bounces;
  for (const Integer& n : p.copies_per_bounces) per_bounces += (per_bounces.empty() ? "" : ", ") + to_string(n);
  return "{\n  \"copies\": " + to_string(p.copies) + ",\n  \"copies_per_bounces\": [" + per_bounces +
         "],\n  \"sheets\": " + std::to_string(p.sheets) + ",\n  \"triangles\": " + std::to_string(p.triangles) +
         ",\n  \"vertices\": " + std::to_string(p.vertices) + ",\n  \"bytes\": " + std::to_string(p.bytes) + "\n}\n";
}

std::string report_json(const Compiled& compiled) {
  const Report& r = compiled.report;
  nlohmann::ordered_json json{
      {"orbifold", compiled.product.title},
      {"copies", r.copies},
      {"vertices", r.vertices},
      {"triangles", r.triangles},
      {"triangles_without_levels", r.triangles_whole},
      {"beams", r.beams},
      {"words", r.words},
      {"longest_word", r.longest_word},
      {"error_bound_px", r.error_bound_px},
      {"tolerance_px", r.tolerance_px},
      {"copies_left_out", r.left_out},
      {"left_out_px", r.left_out_px},
      {"weight_lost", r.weight_lost},
      {"weight_merged", r.weight_merged},
      {"curtains", r.curtains},
      {"curtains_dropped", r.curtains_dropped},
      {"atlas", {compiled.product.atlas.width, compiled.product.atlas.height}},
      {"lamps", compiled.product.native ? compiled.product.native->lamps.size() : 0},
      {"highlights", {{"copies", r.highlights.copies}, {"copies_without", r.highlights.copies_left_out}, {"texels", r.highlights.texels}}}};
  if (!r.levels.empty()) {
    nlohmann::ordered_json& levels = json["levels"] = nlohmann::ordered_json::array();
    for (const ToldLevels& of : r.levels) levels.push_back({{"part", of.part}, {"triangles", of.triangles}, {"error", of.error}});
  }
  nlohmann::ordered_json& list = json["list"] = nlohmann::ordered_json::array();
  const std::vector<DrawnCopy>& copies = compiled.product.copies;
  std::vector<std::size_t> triangles(copies.size());
  for (std::size_t i = 0; i < copies.size(); ++i) triangles[copies[i].again_of.value_or(i)] += copies[i].index_count / 3;
  for (std::size_t i = 0; i < copies.size(); ++i) {
    const DrawnCopy& c = copies[i];
    if (!is_listed(c)) continue;
    list.push_back({{"word", cover::to_string(c.word)},
                    {"bounces", c.bounces},
                    {"sheet", c.sheet},
                    {"mirrored", c.reversing},
                    {"weight", {c.tint.r, c.tint.g, c.tint.b}},
                    {"distance", c.distance},
                    {"triangles", triangles[i]},
                    {"level", c.level}});
    if (c.storey != 0) list.back()["storey"] = c.storey;
    if (c.wedge) list.back()["wedge_deg"] = {degrees_of(c.wedge->from), degrees_of(c.wedge->to)};
  }
  return json.dump(1) + "\n";
}

}  // namespace orbc::driver
