// Commands that compare.
#include <CLI/CLI.hpp>

#include "compiler/cli/define.h"

namespace orbc::cli {

void define_verify(Program& program) {
  const auto arguments = std::make_shared<VerifyArguments>();
  VerifyArguments& a = *arguments;
  CLI::App* c =
      program.app.add_subcommand("verify", "Draw a scene by both roads, export and tracer, and compare the pictures pixel by pixel");
  add_scene(*c, a.compile.scene);
  c->add_option("--samples", a.samples, "Samples per pixel, a square number, at the same points for both")
      ->capture_default_str()
      ->check(CLI::IsMember({1, 4, 9, 16, 25, 36, 49, 64}))
      ->type_name("N");
  c->add_flag("--blender", a.blender, "Compare Blender's picture too");
  c->add_option("--within", a.within, "A pixel agrees when it differs by at most so many steps of 1/255: 1, 2, 4 or 8")
      ->capture_default_str()
      ->check(CLI::IsMember({1, 2, 4, 8}))
      ->type_name("N");
  c->add_option("--threshold", a.threshold, "Share of pixels that must agree")
      ->capture_default_str()
      ->check(CLI::Range(0.0, 1.0))
      ->type_name("SHARE");
  c->add_option("--off-edge", a.off_edge, "Share of pixels that may differ by more than 2/255 away from every edge")
      ->capture_default_str()
      ->check(CLI::Range(0.0, 1.0))
      ->type_name("SHARE");
  c->add_option("--difference", a.difference, "Write a picture of the differences: .png or .jpg")->type_name("FILE");
  c->add_option("--keep", a.keep, "Write both pictures as STEM-export.png and STEM-tracer.png; a STEM that ends in .jpg writes JPEG")
      ->type_name("STEM");
  a.compile.tolerance = 0.1;
  add_compile_options(*c, a.compile);
  c->get_option("--quality")
      ->description(
          "How finely light is baked: draft, normal or fine; when not given, fine in the export, and the tracer takes the scene's");
  c->footer(
      "Examples:\n  orbc verify s.yaml\n  orbc verify lit.yaml --samples 64 --within 4 --threshold 0.99\n"
      "  orbc verify s.yaml --blender --difference diff.png");
  add_common(*c, program.common);
  program.commands.push_back({c, [arguments](const Common& common) { return verify(*arguments, common); }});
}

}  // namespace orbc::cli
