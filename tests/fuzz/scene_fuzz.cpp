// Any bytes as a scene: a scene or diagnostics, never a crash. Start from the corpus:
//   bin/scene_fuzz -dict=tests/fuzz/scene.dict -max_len=4096 -timeout=10 new_corpus tests/scenes/good tests/scenes/bad/syntax
#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "compiler/scene/read.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto read = orbc::scene::read_scene(orbc::SourceText{"fuzz.yaml", std::string(reinterpret_cast<const char*>(data), size)});
  if (!read && !orbc::has_error(read.error())) std::abort();     // refused without a reason
  if (read && read->scene.room.walls.empty()) std::abort();      // every room has walls
  (void)orbc::to_text(read ? read->notes : read.error());
  return 0;
}
