// Compiles the scene that its argument names with the installed libraries, and says how many triangles its POV-Ray file has.
#include <cstdio>

#include "compiler/driver/compile.h"
#include "compiler/driver/load.h"
#include "compiler/driver/threads.h"
#include "exporters/pov/write_pov.h"

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  const auto loaded = orbc::driver::load(argv[1]);
  if (!loaded) return std::fprintf(stderr, "%s\n", orbc::to_text(loaded.error()).c_str()), 1;
  const auto compiled = orbc::driver::compile(*loaded, {}, orbc::driver::parallel_executor());
  if (!compiled) return std::fprintf(stderr, "%s\n", orbc::to_text(compiled.error()).c_str()), 1;
  const auto files = orbc::pov::write_pov(compiled->product);
  std::printf("%llu triangles in %zu files\n", static_cast<unsigned long long>(compiled->report.triangles), files.size());
  return 0;
}
