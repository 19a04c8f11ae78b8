#include "exporters/svg/motif.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <numbers>

#include "compiler/base/elementary.h"
#include "compiler/geometry/chart.h"
#include "exporters/svg/letters.h"

namespace orbc::svg {
namespace {

using Complex = std::complex<double>;
using geometry::Space;

constexpr double kSpace = 0.12;      // of the room's smallest distance from its centre to a wall, kept free beside the motif
constexpr int kSplits = 24;          // segments of an edge as long as the motif
constexpr double kTolerance = 0.12;  // page units that a left-out point may lie off
constexpr double kFront = 0.3;       // w of what a gnomonic page shows at most: its frame lies at 0.45

double distance_to_walls(const room::Room& room, Complex z) {
  if (room.space == Space::hyperbolic && std::norm(z) >= 1) return -1;
  const geometry::Point p = geometry::point_from_disk(room.space, z);
  double least = std::numeric_limits<double>::infinity();
  for (const room::Wall& wall : room.walls) least = std::min(least, geometry::signed_distance(room.space, wall.line, p));
  return least;
}

double distance_to_chord(Complex p, Complex a, Complex b) {
  const double length = std::norm(b - a);
  if (length == 0) return math::abs(p - a);
  const double t = std::clamp((std::conj(b - a) * (p - a)).real() / length, 0.0, 1.0);
  return math::abs(p - a - t * (b - a));
}

/// Keeps the points that matter between `first` and `last` (Douglas and Peucker, 1973).
void mark(const Polyline& line, std::size_t first, std::size_t last, std::vector<bool>& kept) {
  std::size_t farthest = first;
  double most = kTolerance;
  for (std::size_t i = first + 1; i < last; ++i)
    if (const double d = distance_to_chord(line[i], line[first], line[last]); d > most) {
      most = d;
      farthest = i;
    }
  if (farthest == first) return;
  kept[farthest] = true;
  mark(line, first, farthest, kept);
  mark(line, farthest, last, kept);
}

/// The part of a closed line on the sphere that lies before the plane w = kFront (Sutherland and Hodgman, 1974). Where it leaves and comes
/// back it is closed along the plane, which lies outside the frame of a gnomonic page.
std::vector<geometry::Point> in_front(const std::vector<geometry::Point>& line) {
  std::vector<geometry::Point> kept;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const geometry::Point &p = line[i], &q = line[(i + 1) % line.size()];
    if (p.w >= kFront) kept.push_back(p);
    if ((p.w >= kFront) == (q.w >= kFront)) continue;
    const double t = (kFront - p.w) / (q.w - p.w);
    kept.push_back({kFront, p.x + t * (q.x - p.x), p.y + t * (q.y - p.y)});
  }
  return kept;
}

/// Adds a closed line as an outline of a path, without points that nobody could tell.
void append_outline(std::string& d, const Page& page, const std::vector<geometry::Point>& line) {
  if (line.size() < 3) return;
  Polyline mapped;
  for (const geometry::Point& p : line) mapped.push_back(on_page(page, p));
  mapped.push_back(mapped.front());
  std::vector<bool> kept(mapped.size(), false);
  const std::size_t half = mapped.size() / 2;  // a closed line has no chord from its end to its beginning
  kept.front() = kept[half] = true;
  mark(mapped, 0, half, kept);
  mark(mapped, half, mapped.size() - 1, kept);
  std::size_t count = 0;
  std::string outline;
  for (std::size_t i = 0; i + 1 < mapped.size(); ++i) {
    if (!kept[i]) continue;
    outline += (count++ == 0 ? 'M' : 'L') + coordinate(mapped[i].real()) + ' ' + coordinate(mapped[i].imag());
  }
  if (count > 2) d += outline + 'Z';
}

/// How often a motif in the room runs around the point whose image in the copy is the antipode of the page's middle, counter-clockwise.
int turns_around_antipode(const Motif& motif, const geometry::Isometry& cover_from_room) {
  const geometry::Point p = geometry::inverse(cover_from_room) * geometry::Point{-1, 0, 0};
  if (p.w < -1 + 1e-9) return 0;  // it is the antipode of the room's own middle, where no motif is
  const Complex at = geometry::disk_from_point(Space::spherical, p);
  double angle = 0;
  for (const Polyline& line : motif)
    for (std::size_t i = 0; i < line.size(); ++i) {
      const Complex step = (line[(i + 1) % line.size()] - at) * std::conj(line[i] - at);
      angle += math::atan2(step.imag(), step.real());
    }
  return static_cast<int>(std::lround(angle / (2 * std::numbers::pi)));
}

/// Squares around all of the page, run around `turns` times: where they are positive from the x axis to the y axis of the page.
std::string rings(const Page& page, int turns) {
  const std::string low = coordinate(-page.width), right = coordinate(2 * page.width), bottom = coordinate(page.width + page.height);
  const std::string ring = turns > 0 ? 'M' + low + ' ' + low + 'H' + right + 'V' + bottom + 'H' + low + 'Z'
                                     : 'M' + low + ' ' + low + 'V' + bottom + 'H' + right + 'V' + low + 'Z';
  std::string all;
  for (int i = 0; i < std::abs(turns); ++i) all += ring;
  return all;
}

/// The values of the attribute d of all path elements.
std::string paths_of_file(std::string_view text) {
  std::string data;
  for (std::size_t at = text.find("<path"); at != std::string_view::npos; at = text.find("<path", at + 1)) {
    const std::string_view element = text.substr(at, text.find('>', at) - at);
    for (const char quote : {'"', '\''}) {
      const std::size_t begin = element.find(std::string(" d=") + quote);
      if (begin == std::string_view::npos) continue;
      const std::size_t end = element.find(quote, begin + 4);
      if (end != std::string_view::npos) data += std::string(element.substr(begin + 4, end - begin - 4)) + " ";
    }
  }
  return data;
}

}  // namespace

Result<Motif> read_motif(std::string_view text) {
  if (text.size() == 1) {
    Motif letter = letter_outlines(text[0]);
    if (!letter.empty()) return letter;
    return make_error("svg.bad-motif", fmt::format("there is no motif \"{}\"", text),
                      "motifs are a letter A to Z, p, b, d or q, SVG path data, or an SVG file");
  }
  if (text.find("<svg") == std::string_view::npos) return read_path_data(text);
  const std::string data = paths_of_file(text);
  if (data.empty()) return make_error("svg.bad-motif", "this SVG file has no paths", "turn shapes and texts into paths first");
  return read_path_data(data);
}

Motif placed_motif(const Motif& motif, const room::Room& room) {
  Complex low(std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()), high = -low;
  for (const Polyline& line : motif)
    for (const Complex& z : line) {
      low = {std::min(low.real(), z.real()), std::min(low.imag(), z.imag())};
      high = {std::max(high.real(), z.real()), std::max(high.imag(), z.imag())};
    }
  const Complex middle = (low + high) / 2.0;
  const double size = std::max(math::abs(high - low), 1e-300), space = kSpace * distance_to_walls(room, 0);
  const auto fits = [&](double scale) {
    for (const Polyline& line : motif)
      for (const Complex& z : line)
        if (distance_to_walls(room, scale * (z - middle)) < space) return false;
    return true;
  };
  double scale = 0, step = 1 / size;
  while (fits(2 * step) && step * size < 1e6) step *= 2;
  for (int i = 0; i < 60 && scale + step != scale; ++i, step /= 2)
    if (fits(scale + step)) scale += step;
  Motif placed;
  for (const Polyline& line : motif) {
    Polyline split;
    for (std::size_t i = 0; i < line.size(); ++i) {
      const Complex from = line[i], to = line[(i + 1) % line.size()];
      const int pieces = std::max(1, static_cast<int>(std::ceil(kSplits * math::abs(to - from) / size)));
      for (int k = 0; k < pieces; ++k) split.push_back(scale * (from + (to - from) * (static_cast<double>(k) / pieces) - middle));
    }
    placed.push_back(std::move(split));
  }
  return placed;
}

MotifPath motif_path(const Page& page, const Motif& motif, const geometry::Isometry& cover_from_room) {
  MotifPath path;
  for (const Polyline& line : motif) {
    std::vector<geometry::Point> image;
    for (const Complex& z : line) image.push_back(cover_from_room * geometry::point_from_disk(page.space, z));
    if (page.space == Space::spherical && page.straight) image = in_front(image);
    append_outline(path.d, page, image);
  }
  if (page.space == Space::spherical && !page.straight) {
    const int turns = turns_around_antipode(motif, cover_from_room);
    path.d += rings(page, cover_from_room.reversing ? turns : -turns);  // y points down on the page, which reverses all turns once more
    path.is_alone = turns != 0;
  }
  return path;
}

}  // namespace orbc::svg
