#include "exporters/svg/path_data.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include "compiler/base/elementary.h"
#include "compiler/base/number_text.h"

namespace orbc::svg {
namespace {

using Complex = std::complex<double>;

constexpr std::size_t kMaxPoints = 20000;  // of a motif; every copy repeats them
constexpr double kLargest = 1e9;

/// From one direction to another, in (−π, π].
double turn_between(Complex from, Complex to) {
  const Complex turn = std::conj(from) * to;
  return math::atan2(turn.imag(), turn.real());
}

class PathReader {
 public:
  PathReader(std::string_view data, int fineness) : data_(data), fineness_(fineness) {}

  Result<std::vector<Polyline>> read() {
    skip();
    char command = 0;
    while (at_ < data_.size()) {
      if (std::isalpha(static_cast<unsigned char>(data_[at_]))) command = data_[at_++];
      else if (command == 'M') command = 'L';
      else if (command == 'm') command = 'l';
      if (!(lines_.empty() ? command == 'M' || command == 'm' : command != 0) || !step(command) || points_ > kMaxPoints) return wrong();
      skip();
    }
    lines_.erase(std::remove_if(lines_.begin(), lines_.end(), [](const Polyline& line) { return line.size() < 2; }), lines_.end());
    if (lines_.empty()) return wrong();
    for (Polyline& line : lines_)
      for (Complex& z : line) z = std::conj(z);
    return std::move(lines_);
  }

 private:
  Diagnostic wrong() const {
    if (points_ > kMaxPoints)
      return make_error("svg.bad-path", fmt::format("this path has more than {} points", kMaxPoints), "every tile repeats it: simplify it");
    const std::string around(data_.substr(std::min(at_, data_.size()), 12));
    return make_error("svg.bad-path",
                      around.empty() ? "this path ends too early" : fmt::format("this is no SVG path from \"{}\" on", around),
                      "path data begin with M and have numbers behind each letter: M0 0 L10 0 L5 8 Z");
  }

  void skip() {
    while (at_ < data_.size() && (data_[at_] == ' ' || data_[at_] == ',' || data_[at_] == '\t' || data_[at_] == '\n' || data_[at_] == '\r'))
      ++at_;
  }

  std::optional<double> number() {
    skip();
    std::size_t begin = at_;
    if (begin < data_.size() && data_[begin] == '+') ++begin;
    const LeadingNumber read = leading_number(std::string_view(data_).substr(begin));
    if (read.length == 0 || read.out_of_range || !(std::fabs(read.value) < kLargest)) return std::nullopt;
    at_ = begin + read.length;
    return read.value;
  }

  template <std::size_t kCount>
  std::optional<std::array<double, kCount>> numbers() {
    std::array<double, kCount> values;
    for (double& value : values) {
      const auto read = number();
      if (!read) return std::nullopt;
      value = *read;
    }
    return values;
  }

  // Flags of arcs may stand without blanks: "0 01 10 10".
  std::optional<bool> flag() {
    skip();
    if (at_ >= data_.size() || (data_[at_] != '0' && data_[at_] != '1')) return std::nullopt;
    return data_[at_++] == '1';
  }

  void line_to(Complex z) {
    lines_.back().push_back(z);
    here_ = z;
    ++points_;
  }

  void curve_to(Complex a, Complex b, Complex c) {
    const Complex from = here_;
    for (int i = 1; i <= fineness_; ++i) {
      const double t = static_cast<double>(i) / fineness_, s = 1 - t;
      line_to(s * s * s * from + 3 * s * s * t * a + 3 * s * t * t * b + t * t * t * c);
    }
    control_ = b;
  }

  bool step(char command) {
    const bool relative = command >= 'a';
    const char kind = static_cast<char>(command & ~0x20);
    const Complex origin = relative ? here_ : Complex();
    const char before = std::exchange(previous_, kind);
    if (kind != 'Z' && kind != 'M' && closed_) {  // drawing goes on from where the subpath began
      lines_.push_back({here_});
      closed_ = false;
    }
    switch (kind) {
      case 'M': {
        const auto z = numbers<2>();
        if (!z) return false;
        here_ = start_ = origin + Complex((*z)[0], (*z)[1]);
        lines_.push_back({here_});
        closed_ = false;
        return true;
      }
      case 'Z':
        here_ = start_;
        closed_ = true;
        return true;
      case 'L': {
        const auto z = numbers<2>();
        if (z) line_to(origin + Complex((*z)[0], (*z)[1]));
        return z.has_value();
      }
      case 'H':
      case 'V': {
        const auto v = number();
        if (v) line_to(kind == 'H' ? Complex(origin.real() + *v, here_.imag()) : Complex(here_.real(), origin.imag() + *v));
        return v.has_value();
      }
      default:
        return curve(kind, before, origin);
    }
  }

  bool curve(char kind, char before, Complex origin) {
    const auto at = [&](double x, double y) { return origin + Complex(x, y); };
    if (kind == 'C') {
      const auto v = numbers<6>();
      if (v) curve_to(at((*v)[0], (*v)[1]), at((*v)[2], (*v)[3]), at((*v)[4], (*v)[5]));
      return v.has_value();
    }
    if (kind == 'S') {
      const auto v = numbers<4>();
      if (v) curve_to(before == 'C' || before == 'S' ? 2.0 * here_ - control_ : here_, at((*v)[0], (*v)[1]), at((*v)[2], (*v)[3]));
      return v.has_value();
    }
    if (kind == 'Q') {
      const auto v = numbers<4>();
      if (v) quadratic_to(at((*v)[0], (*v)[1]), at((*v)[2], (*v)[3]));
      return v.has_value();
    }
    if (kind == 'T') {
      const auto v = numbers<2>();
      if (v) quadratic_to(before == 'Q' || before == 'T' ? 2.0 * here_ - control_ : here_, at((*v)[0], (*v)[1]));
      return v.has_value();
    }
    return kind == 'A' && arc(origin);
  }

  void quadratic_to(Complex a, Complex to) {
    const Complex from = here_;
    curve_to(from + 2.0 / 3 * (a - from), to + 2.0 / 3 * (a - to), to);
    control_ = a;
  }

  bool arc(Complex origin) {
    const auto shape = numbers<3>();
    const auto large = shape ? flag() : std::nullopt, sweep = large ? flag() : std::nullopt;
    const auto end = sweep ? numbers<2>() : std::nullopt;
    if (!end) return false;
    arc_to({std::fabs((*shape)[0]), std::fabs((*shape)[1])}, (*shape)[2] * std::numbers::pi / 180, *large, *sweep,
           origin + Complex((*end)[0], (*end)[1]));
    return true;
  }

  // In the coordinates in which the ellipse is the unit circle.
  void arc_to(Complex radii, double turn, bool large, bool sweep, Complex to) {
    if (radii.real() == 0 || radii.imag() == 0 || to == here_) return line_to(to);
    const Complex axis = math::polar(1.0, turn);
    const auto inward = [&](Complex z) {
      z *= std::conj(axis);
      return Complex(z.real() / radii.real(), z.imag() / radii.imag());
    };
    const auto outward = [&](Complex z) { return axis * Complex(z.real() * radii.real(), z.imag() * radii.imag()); };
    const Complex p = inward(here_), q = inward(to), half = (q - p) / 2.0;
    const double grow = std::max(1.0, math::abs(half));  // radii that are too small are enlarged
    const double height = std::sqrt(std::max(0.0, grow * grow - std::norm(half)));
    const Complex centre = p + half + (large != sweep ? 1.0 : -1.0) * Complex(0, 1) * height * half / math::abs(half);
    double angle = turn_between(p - centre, q - centre);
    if (sweep && angle < 0) angle += 2 * std::numbers::pi;
    if (!sweep && angle > 0) angle -= 2 * std::numbers::pi;
    const int steps = std::max(1, static_cast<int>(std::ceil(std::fabs(angle) / (std::numbers::pi / 2) * fineness_)));
    for (int i = 1; i <= steps; ++i) line_to(i == steps ? to : outward(centre + (p - centre) * math::polar(1.0, angle * i / steps)));
  }

  std::string_view data_;
  int fineness_;
  std::size_t at_ = 0, points_ = 0;
  std::vector<Polyline> lines_;
  Complex here_, start_, control_;
  char previous_ = 0;
  bool closed_ = false;
};

}  // namespace

Result<std::vector<Polyline>> read_path_data(std::string_view data, int fineness) { return PathReader(data, fineness).read(); }

}  // namespace orbc::svg
