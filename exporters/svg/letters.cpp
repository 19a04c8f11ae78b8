// Letters are strokes of one width along a skeleton, as a sign painter draws them: no font is needed, and the outline is a polyline that
// isometries can map point by point.
#include "exporters/svg/letters.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "compiler/base/elementary.h"

namespace orbc::svg {
namespace {

using Complex = std::complex<double>;

constexpr double kStroke = 0.17;

/// Skeletons as path data in a box 1 high, y down.
const std::map<char, const char*>& skeletons() {
  static const std::map<char, const char*> letters = {
      {'A', "M0 1L.36 0L.72 1M.12 .66H.6"},
      {'B', "M0 0V1M0 0H.3A.24 .24 0 0 1 .3 .48H0M.3 .48A.26 .26 0 0 1 .3 1H0"},
      {'C', "M.66 .2A.4 .5 0 1 0 .66 .8"},
      {'D', "M0 0V1M0 0H.2A.5 .5 0 0 1 .2 1H0"},
      {'E', "M.56 0H0V1H.56M0 .48H.46"},
      {'F', "M0 1V0H.6M0 .48H.48"},
      {'G', "M.68 .2A.42 .5 0 1 0 .72 .55H.42"},
      {'H', "M0 0V1M.64 0V1M0 .48H.64"},
      {'I', "M.1 0V1"},
      {'J', "M.5 0V.74A.25 .26 0 0 1 0 .74"},
      {'K', "M0 0V1M.62 0L0 .56M.22 .38L.64 1"},
      {'L', "M0 0V1H.54"},
      {'M', "M0 1V0L.4 .62L.8 0V1"},
      {'N', "M0 1V0L.64 1V0"},
      {'O', "M.4 0A.4 .5 0 1 0 .401 0"},
      {'P', "M0 1V0H.3A.27 .27 0 0 1 .3 .54H0"},
      {'Q', "M.4 0A.4 .5 0 1 0 .401 0M.48 .68L.82 1.06"},
      {'R', "M0 1V0H.3A.26 .26 0 0 1 .3 .52H0M.26 .52L.6 1"},
      {'S', "M.56 .16A.28 .25 0 1 0 .3 .5A.28 .25 0 1 1 .02 .84"},
      {'T', "M0 0H.68M.34 0V1"},
      {'U', "M0 0V.68A.31 .32 0 0 0 .62 .68V0"},
      {'V', "M0 0L.36 1L.72 0"},
      {'W', "M0 0L.26 1L.5 .25L.74 1L1 0"},
      {'X', "M0 0L.66 1M.66 0L0 1"},
      {'Y', "M0 0L.34 .5L.68 0M.34 .5V1"},
      {'Z', "M0 0H.62L0 1H.64"},
      {'p', "M0 .3V1.28M0 .62A.3 .32 0 1 1 0 .66"},
      {'q', "M.6 .3V1.28M.6 .62A.3 .32 0 1 0 .6 .66"},
      {'b', "M0 0V.96M0 .62A.3 .32 0 1 1 0 .66"},
      {'d', "M.6 0V.96M.6 .62A.3 .32 0 1 0 .6 .66"},
  };
  return letters;
}

/// The line that runs beside a stroke at half its width to the left; mitred at bends, square at both ends.
Polyline left_side(const Polyline& line) {
  const double half = kStroke / 2;
  Polyline side;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const Complex before = i > 0 ? (line[i] - line[i - 1]) / math::abs(line[i] - line[i - 1]) : 0;
    const Complex after = i + 1 < line.size() ? (line[i + 1] - line[i]) / math::abs(line[i + 1] - line[i]) : 0;
    if (i == 0) side.push_back(line[i] + half * (Complex(0, 1) * after - after));
    else if (i + 1 == line.size()) side.push_back(line[i] + half * (Complex(0, 1) * before + before));
    else {
      const Complex sum = before + after;  // along the bisector, 2 cos(turn/2) long
      const double stretch = std::min(2 / std::norm(sum), 1.6);
      side.push_back(line[i] + half * Complex(0, 1) * sum * stretch);
    }
  }
  return side;
}

}  // namespace

std::vector<Polyline> letter_outlines(char letter) {
  const auto found = skeletons().find(letter);
  if (found == skeletons().end()) return {};
  std::vector<Polyline> outlines;
  const Result<std::vector<Polyline>> strokes = read_path_data(found->second, 8);
  for (Polyline line : *strokes) {
    line.erase(std::unique(line.begin(), line.end()), line.end());
    Polyline outline = left_side(line);
    std::reverse(line.begin(), line.end());
    const Polyline back = left_side(line);
    outline.insert(outline.end(), back.begin(), back.end());
    outlines.push_back(std::move(outline));
  }
  return outlines;
}

}  // namespace orbc::svg
