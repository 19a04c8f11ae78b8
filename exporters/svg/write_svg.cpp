// Copies are grouped by colour and by the width of their seams, which shrinks with the copy, so that far copies do not drown in lines.
// Groups carry the attributes (no style sheet: several pictures in one web page must not disturb each other).
#include "exporters/svg/write_svg.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "compiler/base/elementary.h"
#include "compiler/base/rational.h"
#include "compiler/geometry/chart.h"
#include "exporters/svg/page.h"
#include "exporters/svg/palette.h"
#include "exporters/text.h"

namespace orbc::svg {
namespace {

using Complex = std::complex<double>;
using driver::Tiling;
using geometry::Space;

constexpr double kTooltipFrom = 8;      // page units: narrower copies are hard to hit and share one path
constexpr double kCaption = 46;

/// Text for XML: marks escaped, control characters blank, bytes that are not UTF-8 as U+FFFD.
std::string escaped(std::string_view text) {
  std::string out;
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t length = exporters::utf8_length(text.substr(i));
    const char c = text[i];
    if (c == '&') out += "&amp;";
    else if (c == '<') out += "&lt;";
    else if (c == '>') out += "&gt;";
    else if (length == 0) out += "\ufffd";
    else if (static_cast<unsigned char>(c) < 32) out += ' ';
    else out += text.substr(i, length);
    i += length == 0 ? 1 : length;
  }
  return out;
}

std::string attribute(const char* name, double value) { return std::string(" ") + name + "=\"" + coordinate(value) + "\""; }

const char* chart_name(const Tiling& tiling) {
  if (tiling.room.space == Space::euclidean) return "Euclidean plane";
  const bool straight = tiling.model == Tiling::Model::klein;
  if (tiling.room.space == Space::hyperbolic) return straight ? "hyperbolic plane, Klein disk" : "hyperbolic plane, Poincaré disk";
  return straight ? "sphere, gnomonic projection" : "sphere, stereographic projection";
}

/// Everything that shares fill and seam.
struct Group {
  std::string single;   // paths with tooltips
  std::string joint;    // one `d` for all small copies
  std::size_t joint_count = 0;
};

/// The seam of a copy of this size, as a power of √2 so that copies can share it: 0.9 % of its width, never more than 1.2 units.
int seam_level(double diameter) { return std::min(0, static_cast<int>(std::floor(2 * math::log2(0.009 * diameter / 1.2)))); }
double seam_width(int level) { return 1.2 * math::exp2(level / 2.0); }

struct Tile {
  const cover::Copy* copy;
  TilePath path;
};

/// What of a copy the eye sees: a copy behind mirrors that differ, or of a room that is no orbifold, is cut to its wedge.
TilePath wedge_path(const Tiling& tiling, const Page& page, const std::vector<Piece>& pieces, const cover::Copy& copy) {
  const std::vector<Piece> seen = seen_pieces(tiling.room.space, pieces, copy, tiling.room_from_eye);
  if (seen.size() < 2) return {};
  return tile_path(page, seen, geometry::identity(tiling.room.space));
}

/// The copies that are large enough to be seen, in their order.
std::vector<Tile> visible_tiles(const Tiling& tiling, const Page& page, const std::vector<Piece>& pieces, double smallest) {
  std::vector<Tile> tiles;
  std::set<std::string> stacked;
  for (const cover::Copy& copy : tiling.copies) {
    if (copy.sheet != 0 || copy.storey.number != 0) continue;
    TilePath path = copy.wedge ? wedge_path(tiling, page, pieces, copy) : tile_path(page, pieces, copy.cover_from_room);
    if (path.d.empty() || path.diameter < smallest) continue;
    // Mirrors above each other show copies in the same wedge: from above there is one.
    if (!copy.sills.empty() && !stacked.insert(path.d).second) continue;
    tiles.push_back({&copy, std::move(path)});
  }
  return tiles;
}

std::map<std::pair<std::string, int>, Group> grouped(const std::vector<Tile>& tiles, const Tiling& tiling, bool tooltips) {
  int longest = 1;  // of the copies whose colour can be told, so that the ramp is used in full
  for (const Tile& tile : tiles)
    if (tile.path.diameter >= kTooltipFrom) longest = std::max(longest, static_cast<int>(tile.copy->word.size()));
  std::map<std::pair<std::string, int>, Group> groups;
  for (const Tile& tile : tiles) {
    Group& group = groups[{fill_of(*tile.copy, longest, tiling.colouring), seam_level(tile.path.diameter)}];
    if (tooltips && tile.path.diameter >= kTooltipFrom) {
      const std::string word = tile.copy->word.empty() ? "the room" : cover::to_string(tile.copy->word);
      group.single += "<path d=\"" + tile.path.d + "\"><title>" + word + "</title></path>\n";
    } else {
      // Copies never overlap, so sharing one path changes nothing, and a hole stays a hole (evenodd).
      group.joint += tile.path.d;
      if (++group.joint_count % 16 == 0) group.joint += '\n';
    }
  }
  return groups;
}

void write_groups(std::string& out, const std::map<std::pair<std::string, int>, Group>& groups) {
  for (const auto& [key, group] : groups) {
    out += "<g fill=\"" + key.first + "\"" + attribute("stroke-width", seam_width(key.second)) + ">\n" + group.single;
    if (!group.joint.empty()) out += "<path d=\"" + group.joint + "\"/>\n";
    out += "</g>\n";
  }
}

/// A text with a halo of paper around it.
std::string text_at(Complex at, double size, const char* attributes, const std::string& text) {
  return "<text" + attribute("x", at.real()) + attribute("y", at.imag() + 0.35 * size) + attribute("font-size", size) + attributes + ">" +
         text + "</text>\n";
}

void write_labels(std::string& out, const Tiling& tiling, const Page& page) {
  const room::Room& room = tiling.room;
  if (page.straight && room.space == Space::spherical && room.circumradius > 1.1) return;  // corners beyond the frame
  std::vector<Complex> corners;
  for (std::size_t i = 0; i < room.corners.size() && i < room.orbifold.corners.size(); ++i)
    corners.push_back(on_page(page, room.corners[i].at));
  // As large as the closest corners allow, and never larger than the room.
  double gap = 0.9 * page.width;
  for (std::size_t i = 0; i + 1 < corners.size(); ++i)
    for (std::size_t j = i + 1; j < corners.size(); ++j) gap = std::min(gap, math::abs(corners[i] - corners[j]));
  const double radius = std::clamp(0.16 * gap, std::min(0.3 * gap, 8.0), 15.0), size = 1.15 * radius;
  const Complex center = on_page(page, geometry::Point());

  out += "<g font-family=\"Georgia, 'Times New Roman', serif\" text-anchor=\"middle\">\n";
  out += "<g fill=\"" + std::string(kInk) + "\" stroke=\"" + kPaper + "\"" + attribute("stroke-width", 0.22 * size) +
         " stroke-linejoin=\"round\" paint-order=\"stroke\" font-style=\"italic\">\n";
  for (std::size_t i = 0; i < room.walls.size(); ++i) {
    const room::Wall& wall = room.walls[i];
    const Complex at = on_page(page, point_along(room.space, wall.start, wall.along, wall.length / 2));
    const double away = math::abs(center - at);
    // Inside the room where there is space for it, else in the mirror image behind the wall.
    const Complex inward = away > 0 ? (center - at) / away : 0;
    out += text_at(at + (away > 4 * size ? 0.95 : -0.8) * size * inward, 0.9 * size, "", std::to_string(i + 1));
  }
  out += "</g>\n<g fill=\"" + std::string(kPaper) + "\" stroke=\"" + kInk + "\"" + attribute("stroke-width", 0.09 * radius) + ">\n";
  for (const Complex& at : corners)
    out += "<circle" + attribute("cx", at.real()) + attribute("cy", at.imag()) + attribute("r", radius) + "/>\n";
  out += "</g>\n<g fill=\"" + std::string(kInk) + "\" font-weight=\"bold\">\n";
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const std::string order = to_string(room.orbifold.corners[i]);
    out += text_at(corners[i], size * (order.size() < 3 ? 1.0 : 2.3 / static_cast<double>(order.size())), "", order);
  }
  out += "</g>\n</g>\n";
}

std::string circle(const Page& page, double chart_radius, const std::string& attributes) {
  return "<circle" + attribute("cx", page.middle.real()) + attribute("cy", page.middle.imag()) + attribute("r", page.scale * chart_radius) +
         attributes + "/>\n";
}

}  // namespace

std::vector<driver::File> write_svg(const Tiling& tiling, const SvgOptions& options) {
  const std::vector<Piece> pieces = outline_pieces(tiling.room);
  const Page page = make_page(tiling, pieces, options.width);
  const std::vector<Tile> tiles = visible_tiles(tiling, page, pieces, options.smallest);
  const bool framed = page.frame > 0;
  const std::string clip = "orbc-frame-" + coordinate(options.width);
  const double height = page.height + (options.labels ? kCaption - 12 : 0);

  std::string out = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<svg xmlns=\"http://www.w3.org/2000/svg\"";
  out += attribute("width", page.width) + attribute("height", height) + " viewBox=\"0 0 " + coordinate(page.width) + " " +
         coordinate(height) + "\" role=\"img\">\n";
  out += "<title>" + escaped(tiling.title) + "</title>\n<desc>The mirror room " + escaped(tiling.title) + " and its " +
         std::to_string(tiles.size()) + " drawn copies; " + chart_name(tiling) + ". The room itself is orange" +
         (tiling.colouring == Tiling::Colouring::parity ? ", mirror images are dark, their mirror images light"
                                                        : ", copies are coloured by the number of mirrors on the way to them") +
         (std::any_of(tiles.begin(), tiles.end(), [](const Tile& tile) { return tile.copy->wedge.has_value(); })
              ? ", copies are cut to what the eye sees of them"
              : "") +
         (options.labels ? ". Circles hold the orders of the corners, italic numbers count the walls" : "") + ".</desc>\n";
  out += "<rect width=\"100%\" height=\"100%\" fill=\"" + std::string(kPaper) + "\"/>\n";
  if (framed) {
    out += "<clipPath id=\"" + clip + "\">" + circle(page, page.frame, "") + "</clipPath>\n";
    out += circle(page, page.frame, " fill=\"" + haze(tiling.colouring) + "\"");
  }
  out += "<g stroke=\"" + std::string(kPaper) + "\" stroke-linejoin=\"round\" fill-rule=\"evenodd\"" +
         (framed ? " clip-path=\"url(#" + clip + ")\"" : "") + ">\n";
  write_groups(out, grouped(tiles, tiling, options.tooltips));
  for (const Tile& tile : tiles)
    if (tile.copy->word.empty())
      out += "<path d=\"" + tile.path.d + "\" fill=\"none\" stroke=\"" + kInk + "\"" +
             attribute("stroke-width", std::clamp(0.012 * tile.path.diameter, 0.8, 2.4)) + "/>\n";
  out += "</g>\n";
  if (framed) out += circle(page, page.frame, " fill=\"none\" stroke=\"" + std::string(kInk) + "\" stroke-width=\"1.6\"");
  if (tiling.room.space == Space::spherical && !page.straight)
    out += circle(
        page, 1,
        " fill=\"none\" stroke=\"" + std::string(kInk) + "\" stroke-width=\"1.1\" stroke-dasharray=\"2 5\" stroke-linecap=\"round\"");
  if (options.labels) {
    write_labels(out, tiling, page);
    out += "<text" + attribute("x", page.width / 2) + attribute("y", height - 12) +
           " text-anchor=\"middle\" font-family=\"Georgia, 'Times New Roman', serif\" font-size=\"19\" fill=\"" + kInk +
           "\"><tspan font-weight=\"bold\">" + escaped(tiling.title) + "</tspan><tspan dx=\"8\" fill-opacity=\"0.7\">— " +
           chart_name(tiling) + "</tspan></text>\n";
  }
  out += "</svg>\n";
  std::vector<driver::File> files;
  files.push_back({"", std::move(out)});
  return files;
}

}  // namespace orbc::svg
