// libFuzzer: any bytes are a file that agrees with itself, or a diagnostic. The first byte chooses the form, so that one corpus serves all.
#include <cstdint>
#include <cstdlib>
#include <string>

#include "compiler/diff/compare.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace orbc::diff;
  if (size < 1) return 0;
  const std::string bytes(reinterpret_cast<const char*>(data + 1), size - 1);
  const Source a{"a", "/nowhere", "a", bytes}, b{"b", "/nowhere", "b", bytes};
  const auto found = compare(static_cast<Form>(data[0] % 6), a, b, {1e-6, 1});
  if (!found) {
    if (found.error().empty() || found.error().front().code.rfind("diff.", 0) != 0) std::abort();
  } else if (found->differs) {
    std::abort();
  }
  // And against half of itself: no promise but an answer.
  const Source half{"b", "/nowhere", "b", bytes.substr(0, bytes.size() / 2)};
  (void)compare(static_cast<Form>(data[0] % 6), a, half, {});
  return 0;
}
