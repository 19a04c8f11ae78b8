// Copies are grouped by colour and by the width of their seams, which shrinks with the copy, so that far copies do not drown in lines.
// Groups carry the attributes (no style sheet: several pictures in one web page must not disturb each other).
#include "exporters/svg/write_svg.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "compiler/base/elementary.h"
#include "exporters/svg/labels.h"
#include "exporters/svg/page.h"
#include "exporters/svg/palette.h"

namespace orbc::svg {
namespace {

using Complex = std::complex<double>;
using driver::Tiling;
using geometry::Space;

constexpr double kTooltipFrom = 8;  // page units: narrower copies are hard to hit and share one path
constexpr double kMotifFrom = 7;    // narrower copies show no motif
constexpr double kCaption = 34;

const char* chart_name(Space space, const Page& page) {
  if (page.half_plane) return "hyperbolic plane, upper half-plane";
  if (space == Space::euclidean) return "Euclidean plane";
  const bool straight = page.straight;
  if (space == Space::hyperbolic) return straight ? "hyperbolic plane, Klein disk" : "hyperbolic plane, Poincaré disk";
  return straight ? "sphere, gnomonic projection" : "sphere, stereographic projection";
}

/// Everything that shares fill and seam.
struct Group {
  std::string single;  // paths with tooltips
  std::string joint;   // one `d` for all small copies
  std::size_t joint_count = 0;
};

constexpr double kLine = 1.2;  // page units: between large copies

/// The seam of a copy of this size, as a power of √2 so that copies can share it: 0.9 % of its width, never more than `lines`, if these are
/// as wide as usual.
int seam_level(double diameter, const Page& page) {
  return std::min(0, static_cast<int>(std::floor(2 * math::log2(0.009 * diameter / (kLine * page.unit)))));
}
double seam_width(int level, const Page& page, double lines) { return lines * page.unit * math::exp2(level / 2.0); }

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
    if (!copy.height_bounds.empty() && !stacked.insert(path.d).second) continue;
    tiles.push_back({&copy, std::move(path)});
  }
  return tiles;
}

int longest_told(const std::vector<Tile>& tiles) {
  int longest = 1;  // of the copies whose colour can be told, so that the ramp is used in full
  for (const Tile& tile : tiles)
    if (tile.path.diameter >= kTooltipFrom) longest = std::max(longest, static_cast<int>(tile.copy->word.size()));
  return longest;
}

using Groups = std::map<std::pair<std::string, int>, Group>;

Groups grouped(const std::vector<Tile>& tiles, const Tiling& tiling, const Page& page, const SvgOptions& options) {
  const int longest = longest_told(tiles);
  Groups groups;
  for (const Tile& tile : tiles) {
    Group& group = groups[{fill_of(*tile.copy, longest, tiling.coloring, options.colors), seam_level(tile.path.diameter, page)}];
    if (options.tooltips && tile.path.diameter >= kTooltipFrom) {
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

void write_groups(std::string& out, const Groups& groups, const Page& page, double lines) {
  for (const auto& [key, group] : groups) {
    // Without lines neighbours would leave hairs of paper between them: each is as much larger as closes them.
    const std::string seam = lines > 0 ? attribute("stroke-width", seam_width(key.second, page, lines))
                                       : " stroke=\"" + key.first + "\"" + attribute("stroke-width", 0.4 * page.unit);
    out += "<g fill=\"" + key.first + "\"" + seam + ">\n" + group.single;
    if (!group.joint.empty()) out += "<path d=\"" + group.joint + "\"/>\n";
    out += "</g>\n";
  }
}

/// The motif of every copy that is large enough to show one, dark on light and light on dark.
void write_motifs(std::string& out, const std::vector<Tile>& tiles, const Tiling& tiling, const Page& page, const SvgOptions& options) {
  if (options.motif.empty()) return;
  const int longest = longest_told(tiles);
  const auto element = [](const std::string& color, const std::string& d) {
    return "<path fill=\"" + color + "\" fill-rule=\"nonzero\" stroke=\"none\" d=\"" + d + "\"/>\n";
  };
  std::map<std::string, std::string> by_color;
  for (const Tile& tile : tiles) {
    if (tile.path.diameter < kMotifFrom * page.unit) continue;
    const std::string color = ink_on(fill_of(*tile.copy, longest, tiling.coloring, options.colors));
    const MotifPath path = motif_path(page, options.motif, tile.copy->cover_from_room);
    if (path.is_alone) out += element(color, path.d);
    else if (!path.d.empty()) by_color[color] += path.d + '\n';
  }
  for (const auto& [color, d] : by_color) out += element(color, d);
}

/// Plain walls that close a strip, in all its copies.
void write_end_walls(std::string& out, const std::vector<Tile>& tiles, const Tiling& tiling, const Page& page,
                     const std::vector<Piece>& pieces) {
  std::string d;
  for (const Tile& tile : tiles)
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      if (tiling.room.walls[static_cast<std::size_t>(tiling.room.outline_wall[i])].reflects) continue;
      const geometry::Isometry& map = tile.copy->cover_from_room;
      d += open_path(page, {map * pieces[i].from, map * pieces[i].middle, map * pieces[i].to, map * pieces[i].line});
    }
  if (!d.empty())
    out += "<path fill=\"none\" stroke=\"" + std::string(kInk) + "\"" + attribute("stroke-width", 5 * page.unit) + " d=\"" + d + "\"/>\n";
}

std::string circle(const Page& page, double chart_radius, const std::string& attributes) {
  return "<circle" + attribute("cx", page.middle.real()) + attribute("cy", page.middle.imag()) + attribute("r", page.scale * chart_radius) +
         attributes + "/>\n";
}

}  // namespace

namespace {

std::string head(const Tiling& tiling, const Page& page, const std::vector<Tile>& tiles, const SvgOptions& options) {
  std::string out = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"";
  out +=
      coordinate(page.width / options.per_unit) + options.unit + "\" height=\"" + coordinate(page.height / options.per_unit) + options.unit;
  out += "\" viewBox=\"0 0 " + coordinate(page.width) + " " + coordinate(page.height) + "\" role=\"img\">\n";
  out += "<title>" + escaped(tiling.title) + "</title>\n<desc>The mirror room " + escaped(tiling.title) + " and its " +
         std::to_string(tiles.size()) + " drawn copies; " + chart_name(tiling.room.space, page) + ". ";
  out += options.colors ? "Mirror images" : "The room itself is orange, mirror images";
  out += tiling.coloring == Tiling::Coloring::parity ? options.colors ? " have the second colour" : " are dark, their mirror images light"
                                                       : " and copies are coloured by the number of mirrors on the way to them";
  if (std::any_of(tiles.begin(), tiles.end(), [](const Tile& tile) { return tile.copy->wedge.has_value(); }))
    out += ", copies are cut to what the eye sees of them";
  if (options.labels) out += ". Circles hold the orders of the corners, italic numbers count the walls";
  return out + ".</desc>\n";
}

/// What is left of a page where copies are too small to be drawn, and the border to which everything is cut.
struct Border {
  std::string shape;  // without attributes and end
  std::string clip;   // its name
};

Border border_of(const Page& page) {
  Border border;
  if (page.frame > 0) {
    border.shape =
        "<circle" + attribute("cx", page.middle.real()) + attribute("cy", page.middle.imag()) + attribute("r", page.scale * page.frame);
  } else if (page.window) {
    const Box& w = *page.window;
    border.shape = "<rect" + attribute("x", w.left) + attribute("y", w.top) + attribute("width", w.right - w.left) +
                   attribute("height", w.bottom - w.top);
  }
  if (!border.shape.empty()) border.clip = "orbc-frame-" + coordinate(page.width) + "-" + coordinate(page.height);
  return border;
}

}  // namespace

std::string caption_line(const std::string& title, const Page& page, Space space) {
  return "<text" + attribute("x", page.width / 2) + attribute("y", page.height - 12 * page.unit) +
         " text-anchor=\"middle\" font-family=\"Georgia, 'Times New Roman', serif\"" + attribute("font-size", 19 * page.unit) + " fill=\"" +
         kInk + "\"><tspan font-weight=\"bold\">" + escaped(title) + "</tspan><tspan" + attribute("dx", 8 * page.unit) +
         " fill-opacity=\"0.7\">— " + chart_name(space, page) + "</tspan></text>\n";
}

double caption_height(double width) { return kCaption * width / 1000; }

std::string draw_tiling(const Tiling& tiling, const Page& page, double caption, const SvgOptions& options) {
  const std::vector<Piece> pieces = outline_pieces(tiling.room);
  const std::vector<Tile> tiles = visible_tiles(tiling, page, pieces, options.smallest);
  const Border border = border_of(page);
  const std::string ink = " stroke=\"" + std::string(kInk) + "\"", line_color = options.line_color.empty() ? kPaper : options.line_color;

  std::string out = head(tiling, page, tiles, options);
  out += "<rect width=\"100%\" height=\"100%\" fill=\"" + std::string(kPaper) + "\"/>\n";
  if (!border.clip.empty()) {
    out += "<clipPath id=\"" + border.clip + "\">" + border.shape + "/>\n</clipPath>\n";
    if (!tiling.room.orbifold.strip) out += border.shape + " fill=\"" + haze(tiling.coloring, options.colors) + "\"/>\n";
  }
  out += "<g stroke=\"" + line_color + "\" stroke-linejoin=\"round\" fill-rule=\"evenodd\"" +
         (border.clip.empty() ? "" : " clip-path=\"url(#" + border.clip + ")\"") + ">\n";
  write_groups(out, grouped(tiles, tiling, page, options), page, options.lines);
  write_motifs(out, tiles, tiling, page, options);
  if (page.window) write_end_walls(out, tiles, tiling, page, pieces);
  for (const Tile& tile : tiles)
    if (tile.copy->word.empty() && (options.labels || !options.colors))
      out += "<path d=\"" + tile.path.d + "\" fill=\"none\"" + ink +
             attribute("stroke-width", std::clamp(0.012 * tile.path.diameter, 0.8 * page.unit, 2.4 * page.unit)) + "/>\n";
  if (options.cuts) out += cut_lines(tiling.room, page);
  out += geodesic_lines(page, options.geodesics);
  out += "</g>\n";
  if (page.frame > 0) out += border.shape + " fill=\"none\"" + ink + attribute("stroke-width", 1.6 * page.unit) + "/>\n";
  if (tiling.room.space == Space::spherical && !page.straight)
    out += circle(page, 1,
                  " fill=\"none\"" + ink + attribute("stroke-width", 1.1 * page.unit) + " stroke-dasharray=\"" + coordinate(2 * page.unit) +
                      " " + coordinate(5 * page.unit) + "\" stroke-linecap=\"round\"");
  if (page.half_plane)
    out += "<path d=\"M" + coordinate(page.window->left) + " " + coordinate(page.window->bottom) + "H" + coordinate(page.window->right) +
           "\" fill=\"none\"" + ink + attribute("stroke-width", 1.6 * page.unit) + "/>\n";
  if (options.labels) out += labels(tiling.room, page);
  if (options.labels && caption > 0) out += caption_line(tiling.title, page, tiling.room.space);
  return out + "</svg>\n";
}

std::vector<driver::File> write_svg(const Tiling& tiling, const SvgOptions& options) {
  Page page = make_page(tiling, outline_pieces(tiling.room), options.width);
  const double caption = options.labels ? kCaption * page.unit : 0;
  page.height += caption;
  std::vector<driver::File> files;
  files.push_back({"", draw_tiling(tiling, page, caption, options)});
  return files;
}

}  // namespace orbc::svg
