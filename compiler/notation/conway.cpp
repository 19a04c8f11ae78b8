#include "compiler/notation/conway.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

namespace orbc::notation {
namespace {

// "4*2", "22x", "∞∞": gyration points in ascending order, boundaries in their lexicographically smallest rotation.
std::string key_of(const ConwaySymbol& symbol) {
  const auto number = [](int order) {
    return order == 0 ? std::string("∞") : order < 10 ? std::to_string(order) : fmt::format("({})", order);
  };
  std::string key(static_cast<std::size_t>(symbol.handles), 'o');
  std::vector<int> gyrations = symbol.gyrations;
  std::sort(gyrations.begin(), gyrations.end());
  for (const int order : gyrations) key += number(order);
  for (const std::vector<int>& boundary : symbol.boundaries) {
    std::vector<int> corners = boundary, turned = boundary;
    for (std::size_t i = 0; i < turned.size(); ++i) {
      std::rotate(turned.begin(), turned.begin() + 1, turned.end());
      corners = std::min(corners, turned);
    }
    key += "*";
    for (const int order : corners) key += number(order);
  }
  return key + std::string(static_cast<std::size_t>(symbol.crosscaps), 'x');
}

const std::map<std::string, std::string>& fixed_names() {
  static const std::map<std::string, std::string> names = {
      {"o", "the wallpaper group p1"},         {"2222", "the wallpaper group p2"},      {"333", "the wallpaper group p3"},
      {"244", "the wallpaper group p4"},       {"236", "the wallpaper group p6"},       {"**", "the wallpaper group pm"},
      {"xx", "the wallpaper group pg"},        {"*x", "the wallpaper group cm"},        {"22*", "the wallpaper group pmg"},
      {"22x", "the wallpaper group pgg"},      {"2*22", "the wallpaper group cmm"},     {"3*3", "the wallpaper group p31m"},
      {"4*2", "the wallpaper group p4g"},      {"233", "the chiral tetrahedral group"}, {"234", "the chiral octahedral group"},
      {"235", "the chiral icosahedral group"}, {"3*2", "the pyritohedral group"},       {"x", "the group of the central inversion"},
      {"∞∞", "the frieze group p1"},           {"∞x", "the frieze group p11g"},         {"∞*", "the frieze group p11m"},
      {"*∞∞", "the frieze group p1m1"},        {"22∞", "the frieze group p2"},          {"2*∞", "the frieze group p2mg"},
      {"*22∞", "the frieze group p2mm"},
  };
  return names;
}

// The families of spherical groups with one rotation of any order k.
std::string family_name(const ConwaySymbol& symbol) {
  std::vector<int> gyrations = symbol.gyrations;
  std::sort(gyrations.begin(), gyrations.end());
  if (symbol.handles > 0 || (!gyrations.empty() && gyrations.front() == 0)) return "";
  const std::size_t turns = gyrations.size(), boundaries = symbol.boundaries.size();
  const bool plain = boundaries == 1 && symbol.boundaries[0].empty();
  if (boundaries == 0 && symbol.crosscaps == 0) {
    if (turns == 2 && gyrations[0] == gyrations[1]) return fmt::format("the cyclic group C{}", gyrations[0]);
    if (turns == 3 && gyrations[1] == 2) return fmt::format("the dihedral group D{}", gyrations[2]);
  }
  if (plain && turns == 1 && symbol.crosscaps == 0) return fmt::format("the spherical group C{}h", gyrations[0]);
  if (boundaries == 0 && turns == 1 && symbol.crosscaps == 1) return fmt::format("the spherical group S{}", 2 * gyrations[0]);
  if (boundaries == 1 && symbol.crosscaps == 0 && turns == 1 && gyrations[0] == 2 && symbol.boundaries[0].size() == 1)
    return fmt::format("the spherical group D{}d", symbol.boundaries[0][0]);
  return "";
}

}  // namespace

std::string usual_name(const ConwaySymbol& symbol) {
  const auto found = fixed_names().find(key_of(symbol));
  return found != fixed_names().end() ? found->second : family_name(symbol);
}

std::string features(const ConwaySymbol& symbol) {
  std::vector<std::string> parts;
  const auto counted = [&](std::size_t count, const char* one, const char* many) {
    if (count > 0) parts.push_back(count == 1 ? one : fmt::format("{} {}", count, many));
  };
  counted(static_cast<std::size_t>(symbol.handles), "a wonder-ring (o)", "wonder-rings (o)");
  if (!symbol.gyrations.empty()) {
    std::string orders;
    for (const int order : symbol.gyrations)
      orders += (orders.empty() ? "" : ", ") + (order == 0 ? std::string("∞") : std::to_string(order));
    parts.push_back((symbol.gyrations.size() == 1 ? "a gyration point of order " : "gyration points of orders ") + orders);
  }
  if (symbol.boundaries.size() > 1) counted(symbol.boundaries.size(), "", "mirror boundaries");
  counted(static_cast<std::size_t>(symbol.crosscaps), "a cross-cap (x)", "cross-caps (x)");
  for (const std::vector<int>& boundary : symbol.boundaries)
    if (std::count(boundary.begin(), boundary.end(), 0) > 0) {
      parts.push_back("mirrors that meet at infinity");
      break;
    }
  std::string text;
  for (std::size_t i = 0; i < parts.size(); ++i) text += (i == 0 ? "" : i + 1 == parts.size() ? " and " : ", ") + parts[i];
  return text;
}

}  // namespace orbc::notation
