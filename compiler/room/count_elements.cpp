#include "compiler/room/count_elements.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <tuple>

#include "compiler/base/check.h"

namespace orbc::room {
namespace {

AmbientMap product(const AmbientMap& a, const AmbientMap& b) {
  AmbientMap c{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) c[i][j] = a[i][0] * b[0][j] + a[i][1] * b[1][j] + a[i][2] * b[2][j];
  return c;
}

AmbientMap identity() { return {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}; }

/// Elements of a group by number. Two maps are one element when their entries agree to about 1e-5; those of different elements of a group
/// with a polygon of ordinary size differ by far more.
class ElementIndex {
 public:
  /// The number of an element; nothing if it is not there.
  [[nodiscard]] std::optional<int> find(const AmbientMap& map) const {
    std::array<long long, 4> cell{}, other{};
    split(map, cell, other);
    for (unsigned corner = 0; corner < 16; ++corner) {
      Key key = cell;
      bool is_new = true;
      for (unsigned i = 0; i < 4; ++i)
        if (corner >> i & 1U) {
          is_new = is_new && other[i] != cell[i];
          key[i] = other[i];
        }
      if (!is_new) continue;
      if (const auto found = numbers_.find(key); found != numbers_.end()) return found->second;
    }
    return std::nullopt;
  }
  /// Adds an element. False if it is there.
  bool insert(const AmbientMap& map) {
    if (find(map)) return false;
    Key cell{}, other{};
    split(map, cell, other);
    numbers_.emplace(cell, static_cast<int>(numbers_.size()));
    return true;
  }
  [[nodiscard]] std::size_t size() const { return numbers_.size(); }

 private:
  using Key = std::array<long long, 4>;
  static constexpr double kCell = 1e-3, kNear = 0.01;  // of a cell

  /// The cell of a map; and for each coordinate that lies near the border of the cell the number beyond it.
  static void split(const AmbientMap& map, Key& cell, Key& other) {
    // Where the origin goes, and a mixture of where the axes go, tell an isometry.
    const std::array<double, 4> values{map[1][0], map[2][0], map[1][1] + 0.3719 * map[2][1], map[1][2] + 0.3719 * map[2][2]};
    for (std::size_t i = 0; i < 4; ++i) {
      const double at = values[i] / kCell + 0.2371;  // zero, which is common, lies inside a cell
      const double low = std::floor(at), part = at - low;
      cell[i] = static_cast<long long>(low);
      other[i] = part < kNear ? cell[i] - 1 : part > 1 - kNear ? cell[i] + 1 : cell[i];
    }
  }

  std::map<Key, int> numbers_;
};

/// The letters of words: crossings, each element once, and the inverses of them, which are letters too.
std::vector<AmbientMap> letters_of(const GluedPolygon& polygon) {
  std::vector<AmbientMap> letters;
  ElementIndex known;
  for (const AmbientMap& map : crossing_maps(polygon))
    if (known.insert(map)) letters.push_back(map);
  return letters;
}

struct Enumerated {
  std::vector<std::size_t> counts;
  bool is_whole_group = false;
};

/// Counts by listing the elements, as far as the limits and double precision allow.
Enumerated enumerated(const std::vector<AmbientMap>& letters, int max_length, std::size_t max_elements) {
  constexpr double kLargestEntry = 1e7;  // rounding errors are below 1e-7 there
  Enumerated result{{1}, false};
  ElementIndex known;
  std::vector<AmbientMap> last{identity()};
  known.insert(last[0]);
  while (static_cast<int>(result.counts.size()) <= max_length) {
    std::vector<AmbientMap> next;
    for (const AmbientMap& map : last)
      for (const AmbientMap& letter : letters) {
        const AmbientMap beyond = product(map, letter);
        if (std::fabs(beyond[0][0]) > kLargestEntry || known.size() > max_elements) return result;
        if (known.insert(beyond)) next.push_back(beyond);
      }
    if (next.empty()) {
      result.is_whole_group = true;
      return result;
    }
    result.counts.push_back(next.size());
    last = std::move(next);
  }
  return result;
}

/// The elements whose polygons share a corner with the first one, the first one as number 0; `rings` times over.
struct Differences {
  ElementIndex index;
  std::vector<AmbientMap> maps;
  void add(const AmbientMap& map) {
    if (index.insert(map)) maps.push_back(map);
  }
};

Differences differences_of(const GluedPolygon& polygon, int rings) {
  const std::vector<AmbientMap> crossings = crossing_maps(polygon);
  Differences around;
  around.add(identity());
  // Every word that walks around a corner is a rotation of a relator or of its inverse: all of their parts are tiles at that corner.
  for (const std::vector<int>& relator : polygon.relators)
    for (std::size_t begin = 0; begin < relator.size(); ++begin) {
      AmbientMap at = identity();
      for (std::size_t i = 0; i < relator.size(); ++i) {
        at = product(at, crossings[static_cast<std::size_t>(relator[(begin + i) % relator.size()])]);
        around.add(at);
      }
    }
  Differences all = around;
  for (int ring = 1; ring < rings; ++ring) {
    const std::vector<AmbientMap> inner = all.maps;
    for (const AmbientMap& a : inner)
      for (const AmbientMap& b : around.maps) all.add(product(a, b));
  }
  return all;
}

/// The inverse of a letter among the letters.
AmbientMap inverse_of(const AmbientMap& letter, const std::vector<AmbientMap>& letters) {
  ElementIndex one;
  one.insert(identity());
  for (const AmbientMap& other : letters)
    if (one.find(product(letter, other))) return other;
  ORBC_CHECK(false, ==, true);  // the inverse of a crossing is that of its partner
  return identity();
}

/// What is known of the words that run beside a ShortLex word: by which differences those of the same length lie off it, and whether they
/// come before it (2d) or behind (2d + 1); and by which those that are shorter by one letter do.
struct Beside {
  std::vector<int> same, shorter;
  // Not <=>: the library of the page's compiler has none for lists.
  friend bool operator<(const Beside& a, const Beside& b) { return std::tie(a.same, a.shorter) < std::tie(b.same, b.shorter); }
};

/// Removes double entries. A difference that is there before and behind counts as before.
void tidy(std::vector<int>& list, bool has_order) {
  std::sort(list.begin(), list.end());
  list.erase(std::unique(list.begin(), list.end(), [&](int a, int b) { return has_order ? a / 2 == b / 2 : a == b; }), list.end());
}

/// The automaton that accepts ShortLex words, built state by state from word differences.
class Automaton {
 public:
  Automaton(const std::vector<AmbientMap>& letters, const Differences& differences) : letters_(letters.size()) {
    const std::size_t n = differences.maps.size();
    moves_.assign(letters_ * n * letters_, -1);
    for (std::size_t a = 0; a < letters_; ++a) {
      const AmbientMap back = inverse_of(letters[a], letters);
      number_.push_back(differences.index.find(letters[a]).value_or(-1));
      inverse_number_.push_back(differences.index.find(back).value_or(-1));
      for (std::size_t d = 0; d < n; ++d)
        for (std::size_t b = 0; b < letters_; ++b)
          moves_[(a * n + d) * letters_ + b] = differences.index.find(product(product(back, differences.maps[d]), letters[b])).value_or(-1);
    }
    count_ = n;
  }

  /// How many words of each length are accepted; nothing if there are more states than allowed.
  [[nodiscard]] std::optional<std::vector<Integer>> counts(int max_length, std::size_t max_states) const {
    std::map<Beside, std::size_t> known;
    std::vector<Beside> states;
    std::vector<std::vector<std::size_t>> next;
    const auto state_of = [&](const Beside& state) {
      const auto [at, is_new] = known.emplace(state, states.size());
      if (is_new) states.push_back(state);
      return at->second;
    };
    // The empty word is a state of its own: only behind it the word that is shorter by one letter begins.
    std::vector<std::size_t> first;
    for (std::size_t a = 0; a < letters_; ++a) {
      auto state = step({}, a);
      state->shorter.push_back(inverse_number_[a]);
      first.push_back(state_of(*state));
    }
    for (std::size_t i = 0; i < states.size(); ++i) {
      if (states.size() > max_states) return std::nullopt;
      next.emplace_back();
      const Beside here = states[i];
      for (std::size_t a = 0; a < letters_; ++a)
        if (const auto there = step(here, a)) next[i].push_back(state_of(*there));
    }
    std::vector<Integer> counts{1}, words(states.size());
    for (const std::size_t state : first) words[state] += 1;
    for (int length = 1; length <= max_length; ++length) {
      Integer sum = 0;
      std::vector<Integer> longer(states.size());
      for (std::size_t i = 0; i < states.size(); ++i) {
        if (words[i] == 0) continue;
        sum += words[i];
        for (const std::size_t there : next[i]) longer[there] += words[i];
      }
      counts.push_back(sum);
      words = std::move(longer);
    }
    return counts;
  }

 private:
  /// The number of a⁻¹·d·b, or −1.
  [[nodiscard]] int move(std::size_t a, int d, std::size_t b) const {
    return moves_[(a * count_ + static_cast<std::size_t>(d)) * letters_ + b];
  }

  /// The state after one more letter; nothing if that word is no ShortLex word.
  [[nodiscard]] std::optional<Beside> step(const Beside& here, std::size_t a) const {
    const int letter = number_[a];
    const auto is_letter = [&](int entry) { return entry / 2 == letter; };
    if (std::any_of(here.same.begin(), here.same.end(), is_letter)) return std::nullopt;
    if (std::binary_search(here.shorter.begin(), here.shorter.end(), letter)) return std::nullopt;
    Beside there;
    for (const int entry : here.same)
      for (std::size_t b = 0; b < letters_; ++b) {
        const int d = move(a, entry / 2, b);
        if (d == 0 && entry % 2 == 0) return std::nullopt;
        if (d > 0) there.same.push_back(2 * d + entry % 2);
      }
    for (std::size_t b = 0; b < letters_; ++b)
      if (const int d = b == a ? -1 : move(a, 0, b); d > 0) there.same.push_back(2 * d + (b < a ? 0 : 1));
    for (const int entry : here.shorter)
      for (std::size_t b = 0; b < letters_; ++b)
        if (const int d = move(a, entry, b); d >= 0) there.shorter.push_back(d);
    tidy(there.same, true);
    tidy(there.shorter, false);
    return there;
  }

  std::size_t letters_, count_ = 0;
  std::vector<int> number_, inverse_number_;  ///< of each letter, and of its inverse, among the differences
  std::vector<int> moves_;                    ///< [letter a][difference d][letter b]: the number of a⁻¹·d·b, or −1
};

bool agree(const std::vector<Integer>& counts, const std::vector<std::size_t>& listed) {
  for (std::size_t i = 0; i < listed.size(); ++i)
    if (counts[i] != Integer(listed[i])) return false;
  return true;
}

}  // namespace

std::vector<Integer> elements_per_length(const GluedPolygon& polygon, int max_length, const CountLimits& limits) {
  const std::vector<AmbientMap> letters = letters_of(polygon);
  const Enumerated listed = enumerated(letters, max_length, limits.elements);
  std::vector<Integer> counts(listed.counts.begin(), listed.counts.end());
  if (listed.is_whole_group || static_cast<int>(counts.size()) > max_length) return counts;
  std::size_t longest = 0;
  for (const std::vector<int>& word : polygon.relators) longest = std::max(longest, word.size());
  if (2 * (listed.counts.size() - 1) < longest) return counts;
  constexpr std::size_t kMostDifferences = 3000;
  for (int rings = 1; rings <= 3; ++rings) {
    const Differences differences = differences_of(polygon, rings);
    if (differences.maps.size() > kMostDifferences) break;
    const auto accepted = Automaton(letters, differences).counts(max_length, limits.states);
    if (accepted && agree(*accepted, listed.counts)) return *accepted;
  }
  return counts;
}

}  // namespace orbc::room
