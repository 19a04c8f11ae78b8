#include "compiler/cli/symbol_info.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <numbers>
#include <set>

#include "compiler/base/rational.h"
#include "compiler/room/count_elements.h"

namespace orbc::cli {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kShownLengths = 12;

const char* kind_name(room::SideKind kind) {
  switch (kind) {
    case room::SideKind::mirror:
      return "mirror";
    case room::SideKind::pair:
      return "pair";
    case room::SideKind::glide:
      return "glide";
  }
  return "";
}

/// Sides that are one letter of the group: the two of a half turn are.
int letters_of(const room::GluedPolygon& polygon) {
  int letters = static_cast<int>(polygon.sides.size());
  for (const std::vector<int>& word : polygon.relators)
    if (word.size() == 2 && word[0] == word[1] && polygon.sides[static_cast<std::size_t>(word[0])].kind == room::SideKind::pair) --letters;
  return letters;
}

/// The group's order 2/χ on the sphere.
std::string order_of(const notation::Symbol& symbol) { return to_string(Rational(2) / notation::euler_characteristic(symbol)); }

double area_of(const notation::Symbol& symbol, const room::GluedPolygon& polygon) {
  if (polygon.space != geometry::Space::euclidean)
    return 2 * std::numbers::pi * std::fabs(static_cast<double>(notation::euler_characteristic(symbol)));
  double perimeter = 0;
  for (const room::GluedSide& side : polygon.sides) perimeter += side.length;
  return perimeter * polygon.inradius / 2;
}

/// What each feature costs of the 2 that a sphere has: Conway's bill.
std::vector<std::pair<std::string, Rational>> bill_of(const notation::Symbol& symbol) {
  std::vector<std::pair<std::string, Rational>> bill;
  for (int i = 0; i < symbol.handles; ++i) bill.emplace_back("o", 2);
  for (const int m : symbol.cones) bill.emplace_back(std::to_string(m), Rational(m - 1, m));
  for (const std::vector<int>& corners : symbol.boundaries) {
    bill.emplace_back("*", 1);
    for (const int n : corners) bill.emplace_back(std::to_string(n), Rational(n - 1, 2 * n));
  }
  for (int i = 0; i < symbol.crosscaps; ++i) bill.emplace_back("x", 1);
  return bill;
}

std::string word_text(const std::vector<int>& word, const room::GluedPolygon& polygon) {
  std::string text;
  std::set<std::string> first;
  for (const int side : word) {
    const room::GluedSide& crossed = polygon.sides[static_cast<std::size_t>(side)];
    // Of the two sides of a pair the first is the letter, the second its inverse.
    text += (text.empty() ? "" : " ") + crossed.name + (crossed.partner < side ? "⁻¹" : "");
  }
  return text + " = 1";
}

Json polygon_json(const room::GluedPolygon& polygon, int max_length) {
  Json sides = Json::array(), lengths = Json::array(), partners = Json::array(), corners = Json::array(), counts = Json::array();
  for (const room::GluedSide& side : polygon.sides) {
    sides.push_back({side.name, kind_name(side.kind)});
    lengths.push_back(side.length);
    partners.push_back(side.partner);
  }
  for (const auto& corner : polygon.corners) corners.push_back({corner.real(), corner.imag()});
  for (const Integer& count : room::elements_per_length(polygon, max_length)) counts.push_back(Json::parse(to_string(count)));
  return {{"corners_2pi_over", polygon.corner_fraction},
          {"sides", sides},
          {"partner", partners},
          {"inradius", polygon.inradius},
          {"side_lengths", lengths},
          {"vertices_disk", corners},
          {"relators", polygon.relators},
          {"relator_residual", polygon.relator_residual},
          {"letters", letters_of(polygon)},
          {"counts", counts}};
}

}  // namespace

std::string polygon_lines(const room::GluedPolygon& polygon, int max_length) {
  std::string text = polygon_json(polygon, max_length).dump(2);
  return text.substr(2, text.size() - 4);  // without the braces
}

std::string symbol_json(const notation::Symbol& symbol, const room::GluedPolygon& polygon, int max_length) {
  Json bill = Json::array();
  for (const auto& [feature, cost] : bill_of(symbol)) bill.push_back({feature, to_string(cost)});
  const Rational chi = notation::euler_characteristic(symbol);
  Json all{{"symbol", notation::to_text(symbol)},
           {"notation", notation::to_text(symbol)},
           {"canonical", notation::to_text(notation::canonical(symbol))},
           {"space", geometry::name(polygon.space)},
           {"chi", to_string(chi)},
           {"bill", bill},
           {"orientable", notation::is_orientable(symbol)},
           {"area", area_of(symbol, polygon)},
           {"order", chi > 0 ? Json::parse(order_of(symbol)) : Json(nullptr)}};
  all.update(polygon_json(polygon, max_length));
  return all.dump(2) + "\n";
}

std::string symbol_text(const notation::Symbol& symbol, const room::GluedPolygon& polygon) {
  std::string text;
  const auto line = [&](const std::string& what, const std::string& value) { text += fmt::format("{:<18}{}\n", what, value); };
  line("orbifold", notation::to_text(symbol));
  line("canonical form", notation::to_text(notation::canonical(symbol)));
  line("space", geometry::name(polygon.space));
  const Rational chi = notation::euler_characteristic(symbol);
  std::string bill = "2";
  for (const auto& [feature, cost] : bill_of(symbol)) bill += fmt::format(" - {} ({})", to_string(cost), feature);
  line("chi", fmt::format("{} = {}", to_string(chi), bill));
  line("surface", notation::is_orientable(symbol) ? "orientable, without border"
                  : symbol.crosscaps > 0          ? "not orientable"
                                                  : "with mirrors as its border");
  if (chi > 0) line("group", fmt::format("{} elements", order_of(symbol)));
  std::string counts;
  for (const Integer& count : room::elements_per_length(polygon, kShownLengths)) counts += (counts.empty() ? "" : " ") + to_string(count);
  line("copies by steps", counts);
  line("inradius", fmt::format("{:.12g}", polygon.inradius));
  for (std::size_t i = 0; i < polygon.sides.size(); ++i) {
    const room::GluedSide& side = polygon.sides[i];
    const std::string glued = side.kind == room::SideKind::mirror ? "mirror"
                                                                  : fmt::format("{} glued to side {}{}", side.name, side.partner + 1,
                                                                                side.kind == room::SideKind::glide ? ", turned over" : "");
    line(fmt::format("corner {}", i + 1),
         fmt::format("{:>9.5f} deg    side {}: length {:.12g}, {}", 360.0 / polygon.corner_fraction[i], i + 1, side.length, glued));
  }
  for (const std::vector<int>& word : polygon.relators) line("relator", word_text(word, polygon));
  line("", "Rooms with such sides are not drawn yet; rooms closed by mirrors alone are.");
  return text;
}

}  // namespace orbc::cli
