#include "exporters/svg/fill.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "compiler/base/elementary.h"
#include "compiler/cover/enumerate.h"
#include "compiler/notation/growth.h"

namespace orbc::svg {
namespace {

using Complex = std::complex<double>;
using geometry::Isometry;
using geometry::Line;
using geometry::Space;

constexpr int kLongestWord = 1024;
constexpr double kSlack = 1e-6;  // of a length: far more than rounding
constexpr std::size_t kVisitsPerCopy = 40;  // many copies are visited for each that is seen, where many walls meet

/// Whether nothing behind the line, to its left, can be seen on the page: all of it is too small or outside the window.
class Behind {
 public:
  Behind(const Page& page, double smallest) : page_(page), smallest_(smallest) {}

  [[nodiscard]] bool is_unseen(const Line& line) const {
    if (page_.space == Space::spherical) return false;
    if (page_.space == Space::hyperbolic && !page_.half_plane) return 2 * page_.scale / std::sqrt(1 + line.w * line.w) < smallest_;
    return page_.half_plane ? is_unseen_in_half_plane(line) : is_outside_window(line);
  }

 private:
  [[nodiscard]] std::array<Complex, 4> window_corners() const {
    const Box& w = *page_.window;
    std::array<Complex, 4> corners = {Complex{w.left, w.top}, {w.right, w.top}, {w.left, w.bottom}, {w.right, w.bottom}};
    for (Complex& z : corners) z = std::conj((z - page_.middle) / page_.scale) / page_.turn;
    return corners;
  }

  [[nodiscard]] bool is_outside_window(const Line& line) const {
    for (const Complex& z : window_corners())
      if (line.w + line.x * z.real() + line.y * z.imag() > 0) return false;
    return true;
  }

  // Positive behind the line: (w + x)(X² + Y²)/2 − yX + (w − x)/2, so the sign of w + x says on which side of its circle that is.
  [[nodiscard]] bool is_unseen_in_half_plane(const Line& line) const {
    const double leading = line.w + line.x;
    const std::array<Complex, 4> corners = window_corners();
    // Copies that touch the window's border count as seen, whatever rounding says of the line that they share with it.
    const double slack = kSlack * std::fabs(corners[1].real() - corners[0].real());
    const double left = corners[0].real() - slack, right = corners[1].real() + slack;
    if (std::fabs(leading) < 1e-9) return is_left_of(line, left, right);
    const double middle = line.y / leading, radius = 1 / std::fabs(leading);
    if (leading < 0)  // inside
      return 2 * radius * page_.scale < (1 - kSlack) * smallest_ || middle + radius < left || middle - radius > right;
    return std::all_of(corners.begin(), corners.end(), [&](const Complex& z) { return math::abs(z - middle) < (1 - kSlack) * radius; });
  }

  // An upright line: −yX + (w − x)/2 = 0.
  [[nodiscard]] static bool is_left_of(const Line& line, double left, double right) {
    const double constant = (line.w - line.x) / 2;
    return constant - line.y * left < 0 && constant - line.y * right < 0;
  }

  const Page& page_;
  double smallest_;
};

enum class Outcome { whole, too_many_copies, too_many_visits };

class Filler {
 public:
  Filler(const room::Room& room, const Page& page, const FillOptions& options)
      : room_(room), page_(page), options_(options), pieces_(outline_pieces(room)) {
    for (std::size_t i = 0; i < room.walls.size(); ++i) {
      if (!room.walls[i].reflects) continue;
      wall_.push_back(static_cast<std::uint8_t>(i));
      mirrors_.push_back(room::reflection_in_wall(room, static_cast<int>(i)));
    }
  }

  std::vector<cover::Copy> copies;

  Outcome run(double smallest, int longest) {
    copies.clear();
    std::size_t visits = 0;
    const Behind behind(page_, smallest);
    const cover::Automaton automaton(room_.orbifold, std::max(longest, 1));
    const bool done = cover::enumerate(automaton, mirrors_, longest, [&](const cover::Element& element, const Isometry& cover_from_room) {
      if (++visits > kVisitsPerCopy * options_.max_copies) return cover::Visit::stop;
      if (!element.word.empty()) {
        const Line& wall = room_.walls[wall_[element.word.back()]].line;
        if (behind.is_unseen(cover_from_room * wall)) return cover::Visit::prune;
      }
      if (is_seen(cover_from_room, smallest)) {
        if (copies.size() == options_.max_copies) return cover::Visit::stop;
        take(element, cover_from_room);
      }
      return cover::Visit::descend;
    });
    if (done) return Outcome::whole;
    return copies.size() == options_.max_copies ? Outcome::too_many_copies : Outcome::too_many_visits;
  }

 private:
  [[nodiscard]] bool is_seen(const Isometry& cover_from_room, double smallest) const {
    const Box box = box_on_page(page_, pieces_, cover_from_room);
    if (page_.space == Space::spherical) return true;  // the exporter cuts it to the frame
    return std::max(box.right - box.left, box.bottom - box.top) >= smallest && !is_outside(page_, box);
  }

  void take(const cover::Element& element, const Isometry& cover_from_room) {
    cover::Copy copy;
    copy.cover_from_room = cover_from_room;
    copy.bounces = static_cast<int>(element.word.size());
    for (const std::uint8_t letter : element.word) copy.word.push_back(wall_[letter]);
    copies.push_back(std::move(copy));
  }

  const room::Room& room_;
  const Page& page_;
  const FillOptions& options_;
  std::vector<Piece> pieces_;
  std::vector<std::uint8_t> wall_;  // letter → wall
  std::vector<Isometry> mirrors_;
};

}  // namespace

Filled fill(const room::Room& room, const Page& page, const FillOptions& options) {
  Filler filler(room, page, options);
  Filled filled;
  double smallest = options.smallest;
  int longest = room.space == Space::spherical ? notation::longest_length(room.orbifold).value() : kLongestWord;
  for (Outcome outcome; (outcome = filler.run(smallest, longest)) != Outcome::whole;) {
    if (outcome == Outcome::too_many_copies && room.space == Space::hyperbolic) smallest *= 1.5;
    else longest /= 2;
  }
  filled.copies = std::move(filler.copies);
  std::stable_sort(filled.copies.begin(), filled.copies.end(),
                   [](const cover::Copy& a, const cover::Copy& b) { return a.word.size() < b.word.size(); });
  const bool shortened = longest < (room.space == Space::spherical ? *notation::longest_length(room.orbifold) : kLongestWord);
  if (smallest > options.smallest || shortened)
    filled.notes.push_back(make_note("svg.copies-left-out",
                                     shortened ? fmt::format("copies behind more than {} mirrors are left out", longest)
                                               : fmt::format("copies smaller than {:.2g} pixels are left out", smallest),
                                     fmt::format("--max-copies {} draws more of them", 4 * options.max_copies)));
  return filled;
}

}  // namespace orbc::svg
