#include "compiler/notation/enumerate.h"

#include <catch2/catch.hpp>
#include <set>

#include "compiler/notation/classify.h"
#include "compiler/notation/print.h"

namespace orbc::notation {
namespace {

using geometry::Space;

struct Table {
  std::vector<std::string> spherical, euclidean, hyperbolic;
};

Table table(int corners, int max_order) {
  Table t;
  Space before = Space::spherical;
  CHECK(enumerate(corners, max_order, [&](const Orbifold& o, Space space) {
          CHECK(*classify(o) == space);
          CHECK(canonical(o) == o);
          CHECK(geometry::curvature(space) <= geometry::curvature(before));
          before = space;
          (space == Space::spherical ? t.spherical : space == Space::euclidean ? t.euclidean : t.hyperbolic).push_back(to_text(o));
          return true;
        }).value());
  return t;
}

using List = std::vector<std::string>;

TEST_CASE("the list reproduces the paper's Table 1", "[notation]") {
  CHECK(table(1, 9).spherical == List{"*"});
  CHECK(table(1, 9).euclidean.empty());
  CHECK(table(2, 4).spherical == List{"*22", "*33", "*44"});
  CHECK(table(2, 4).hyperbolic.empty());
  const Table three = table(3, 8);
  CHECK(three.spherical == List{"*222", "*223", "*224", "*225", "*226", "*227", "*228", "*233", "*234", "*235"});
  CHECK(three.euclidean == List{"*236", "*244", "*333"});
  CHECK(List(three.hyperbolic.begin(), three.hyperbolic.begin() + 9) ==
        List{"*237", "*238", "*245", "*246", "*247", "*248", "*255", "*256", "*257"});
  // *kₐk_bk_c with 2 ≤ kₐ ≤ k_b ≤ k_c ≤ 8: 84 in all.
  CHECK(three.hyperbolic.size() == 84 - 10 - 3);
  CHECK(three.hyperbolic.back() == "*888");
  const Table four = table(4, 3);
  CHECK(four.spherical.empty());
  CHECK(four.euclidean == List{"*2222"});
  CHECK(four.hyperbolic == List{"*2223", "*2233", "*2323", "*2333", "*3333"});
  const Table five = table(5, 3);
  CHECK(five.spherical.empty());
  CHECK(five.euclidean.empty());
  CHECK(five.hyperbolic == List{"*22222", "*22223", "*22233", "*22323", "*22333", "*23233", "*23333", "*33333"});
}

TEST_CASE("small bounds leave out what exceeds them", "[notation]") {
  CHECK(table(3, 2).spherical == List{"*222"});
  CHECK(table(3, 2).euclidean.empty());
  CHECK(table(3, 3).spherical == List{"*222", "*223", "*233"});
  CHECK(table(3, 3).euclidean == List{"*333"});
}

TEST_CASE("each class of corner lists is there exactly once", "[notation]") {
  for (const auto& [corners, max_order] : {std::pair{3, 6}, {4, 5}, {5, 4}, {6, 4}, {7, 3}, {8, 3}, {9, 3}}) {
    CAPTURE(corners, max_order);
    std::set<std::string> all;
    std::vector<int> list(static_cast<std::size_t>(corners), 2);
    for (bool more = true; more;) {
      Orbifold o;
      o.corners.assign(list.begin(), list.end());
      all.insert(to_text(canonical(o)));
      std::size_t i = 0;
      while (i < list.size() && list[i] == max_order) list[i++] = 2;
      more = i < list.size();
      if (more) ++list[i];
    }
    std::set<std::string> listed;
    std::size_t count = 0;
    CHECK(enumerate(corners, max_order, [&](const Orbifold& o, Space) { return listed.insert(to_text(o)), ++count, true; }).value());
    CHECK(listed == all);
    CHECK(count == all.size());
    CHECK(count_orbifolds(corners, max_order).value() == count);
  }
}

TEST_CASE("hyperbolic ones come in lexicographic order", "[notation]") {
  std::vector<Rational> before;
  CHECK(enumerate(5, 5, [&](const Orbifold& o, Space) {
          CHECK(std::lexicographical_compare(before.begin(), before.end(), o.corners.begin(), o.corners.end()));
          before = o.corners;
          return true;
        }).value());
}

TEST_CASE("a list too long for any memory is a stream that can be ended", "[notation]") {
  std::size_t count = 0;
  CHECK_FALSE(enumerate(256, 1000000, [&](const Orbifold& o, Space) { return o.corners.size() == 256 && ++count < 1000; }).value());
  CHECK(count == 1000);
  CHECK(count_orbifolds(256, 1000000).value() > pow(Integer(10), 1500));
  count = 0;
  CHECK_FALSE(enumerate(3, 1000000, [&](const Orbifold&, Space space) { return ++count, space == Space::spherical; }).value());
  CHECK(count == 999999 + 3 + 1);
}

TEST_CASE("bounds out of range are refused", "[notation]") {
  const auto code = [](int corners, int max_order) {
    const Result<Integer> count = count_orbifolds(corners, max_order);
    REQUIRE_FALSE(count.has_value());
    CHECK_FALSE(enumerate(corners, max_order, [](const Orbifold&, Space) { return true; }).has_value());
    return count.error().front().code;
  };
  CHECK(code(0, 8) == "notation.enumerate-out-of-range");
  CHECK(code(-1, 8) == "notation.enumerate-out-of-range");
  CHECK(code(257, 8) == "notation.enumerate-out-of-range");
  CHECK(code(3, 1) == "notation.enumerate-out-of-range");
  CHECK(code(3, 1000001) == "notation.enumerate-out-of-range");
}

TEST_CASE("the count of each space is that of its list", "[notation]") {
  for (const auto& [corners, order] : {std::pair{1, 5}, {2, 7}, {3, 2}, {3, 4}, {3, 9}, {4, 2}, {4, 5}, {5, 3}}) {
    CAPTURE(corners, order);
    const Table t = table(corners, order);
    CHECK(*count_orbifolds(corners, order, Space::spherical) == t.spherical.size());
    CHECK(*count_orbifolds(corners, order, Space::euclidean) == t.euclidean.size());
    CHECK(*count_orbifolds(corners, order, Space::hyperbolic) == t.hyperbolic.size());
    CHECK(*count_orbifolds(corners, order) == t.spherical.size() + t.euclidean.size() + t.hyperbolic.size());
  }
  CHECK_FALSE(count_orbifolds(0, 5, Space::spherical).has_value());
}

}  // namespace
}  // namespace orbc::notation
