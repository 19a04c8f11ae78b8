#include "exporters/svg/labels.h"

#include <algorithm>
#include <cmath>

#include "compiler/base/elementary.h"
#include "compiler/base/rational.h"
#include "compiler/room/cuts.h"
#include "exporters/svg/palette.h"
#include "exporters/text.h"

namespace orbc::svg {
namespace {

using Complex = std::complex<double>;
using geometry::Space;

/// A text with a halo of paper around it.
std::string text_at(Complex at, double size, const char* attributes, const std::string& text) {
  return "<text" + attribute("x", at.real()) + attribute("y", at.imag() + 0.35 * size) + attribute("font-size", size) + attributes + ">" +
         text + "</text>\n";
}

}  // namespace

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

std::string labels(const room::Room& room, const Page& page) {
  std::string out;
  if (page.straight && room.space == Space::spherical && room.circumradius > 1.1) return {};  // corners beyond the frame
  std::vector<Complex> corners;
  for (std::size_t i = 0; i < room.corners.size() && i < room.orbifold.corners.size(); ++i)
    corners.push_back(on_page(page, room.corners[i].at));
  // As large as the closest corners allow, and never larger than the room.
  double gap = 0.9 * page.width;
  for (std::size_t i = 0; i + 1 < corners.size(); ++i)
    for (std::size_t j = i + 1; j < corners.size(); ++j) gap = std::min(gap, math::abs(corners[i] - corners[j]));
  const double radius = std::clamp(0.16 * gap, std::min(0.3 * gap, 8 * page.unit), 15 * page.unit), size = 1.15 * radius;
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
  return out;
}

std::string cut_lines(const room::Room& room, const Page& page) {
  std::string out;
  for (const room::CutSegment& cut : room::cut_segments(room)) {
    const geometry::Point middle = midpoint(room.space, cut.from, cut.to);
    const Piece piece{cut.from, middle, cut.to, line_through(room.space, cut.from, cut.to)};
    out += "<path d=\"" + open_path(page, piece) + "\"><title>cut of walls " + std::to_string(cut.walls[0] + 1) + " and " +
           std::to_string(cut.walls[1] + 1) + "</title></path>\n";
  }
  if (out.empty()) return out;
  return "<g fill=\"none\" stroke=\"" + std::string(kInk) + "\"" + attribute("stroke-width", 2.2 * page.unit) + " stroke-dasharray=\"" +
         coordinate(9 * page.unit) + " " + coordinate(6 * page.unit) + "\" stroke-linecap=\"round\">\n" + out + "</g>\n";
}

}  // namespace orbc::svg
