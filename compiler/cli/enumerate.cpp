#include "compiler/notation/enumerate.h"

#include <fmt/format.h>

#include "compiler/cli/commands.h"
#include "compiler/cli/streams.h"
#include "compiler/cli/support.h"
#include "compiler/notation/euler.h"
#include "compiler/notation/print.h"

namespace orbc::cli {
namespace {

constexpr int kManyLines = 1'000'000;  // as many are listed without being asked twice
constexpr std::size_t kNotationWidth = 14, kBlock = 1 << 20;

std::string with_commas(const Integer& number) {
  std::string digits = to_string(number);
  for (std::size_t i = digits.size(); i > 3; i -= 3) digits.insert(i - 3, 1, ',');
  return digits;
}

std::string line_of(const notation::Orbifold& orbifold, const std::string& space, bool json, bool first) {
  const std::string text = notation::to_text(orbifold), chi = to_string(notation::euler_characteristic(orbifold));
  if (json) return fmt::format("{}\n  {{\"notation\": \"{}\", \"space\": \"{}\", \"chi\": \"{}\"}}", first ? "" : ",", text, space, chi);
  return fmt::format("{:<{}}  {:<10}  chi {}\n", text, kNotationWidth, space, chi);
}

std::optional<geometry::Space> space_named(const std::string& name) {
  for (const geometry::Space space : {geometry::Space::spherical, geometry::Space::euclidean, geometry::Space::hyperbolic})
    if (name == geometry::name(space)) return space;
  return std::nullopt;
}

}  // namespace

int enumerate(const EnumerateArguments& a, const Common& common) {
  const auto count = notation::count_orbifolds(a.corners, a.max_order, space_named(a.space));
  if (!count) {
    print(count.error(), common);
    return kSceneWrong;
  }
  const std::string summary =
      fmt::format("{} {}orbifold{} with {} corners of order at most {}", with_commas(*count), a.space.empty() ? "" : a.space + " ",
                  *count == 1 ? "" : "s", a.corners == 1 ? 0 : a.corners, a.max_order);
  if (*count > kManyLines && !a.all)
    throw UsageError(summary + ": more than a million lines; --all prints them, a smaller --max-order or --space makes them fewer");
  if (!common.quiet && !common.json) print_message(fmt::format("{}\n", summary));
  std::string text = common.json ? "[" : "";
  bool first = true;
  const auto done = notation::enumerate(a.corners, a.max_order, [&](const notation::Orbifold& orbifold, geometry::Space space) {
    const std::string name = geometry::name(space);
    // Spaces come one after the other, the hyperbolic one last: of it there may be more than anybody waits for.
    if (!a.space.empty() && a.space != name) return space != geometry::Space::hyperbolic;
    text += line_of(orbifold, name, common.json, first);
    first = false;
    if (text.size() > kBlock) {
      write_standard_output(text);
      text.clear();
    }
    return true;
  });
  if (!done) {
    print(done.error(), common);
    return kSceneWrong;
  }
  write_standard_output(text + (common.json ? "\n]\n" : ""));
  return kDone;
}

}  // namespace orbc::cli
