// Commands that draw.
#include <CLI/CLI.hpp>

#include "compiler/cli/define.h"

namespace orbc::cli {
namespace {

void add_samples(CLI::App& command, RenderArguments& a) {
  command.add_option("--samples", a.samples, "Samples per pixel (default: 4, or 1 for a --pass other than color)")
      ->check(CLI::Range(1, 65536))
      ->type_name("N");
}

void add_exact(CLI::App& command, RenderArguments& a) {
  command.add_flag("--exact", a.exact,
                   "Tracer: light every sample by itself, as verify does; else matte light is interpolated between points of the surfaces "
                   "wherever it is smooth");
}

void add_noise(CLI::App& command, RenderArguments& a) {
  command
      .add_option("--noise", a.noise,
                  "Tracer: add samples where they are needed, until no pixel is off by more than this share of white; at most --samples "
                  "(default: 1024) each. The picture is written after every pass, so that it can be stopped at any time")
      ->type_name("1/255");
}

}  // namespace

void define_render(Program& program) {
  const auto arguments = std::make_shared<RenderArguments>();
  RenderArguments& a = *arguments;
  CLI::App* c = program.app.add_subcommand("render", "Draw a scene in one go");
  add_scene(*c, a.compile.scene);
  c->add_option("-o,--output", a.compile.output, "The picture: .png, .jpg, with the tracer also .exr; - for PNG on standard output")
      ->required()
      ->type_name("FILE");
  c->add_option("--engine", a.engine, "Who draws: povray, blender or tracer")
      ->capture_default_str()
      ->check(CLI::IsMember({"povray", "blender", "tracer"}))
      ->type_name("NAME");
  add_samples(*c, a);
  c->add_option("--pass", a.pass, "Tracer: what to draw; an .exr holds all of them")->capture_default_str()
      ->check(CLI::IsMember({"color", "depth", "normal", "object", "bounces", "weight"}))->type_name("NAME");
  add_exact(*c, a);
  add_noise(*c, a);
  add_compile_options(*c, a.compile);
  c->footer(
      "Examples:\n  orbc render s.yaml -o s.png\n  orbc render s.yaml -o s.png --engine povray --samples 9\n  orbc render s.yaml -o "
      "pano.png --projection panorama --size 2048x1024");
  add_common(*c, program.common);
  program.commands.push_back({c, [arguments](const Common& common) { return render(*arguments, common); }});
}

void define_trace(Program& program) {
  const auto arguments = std::make_shared<RenderArguments>();
  RenderArguments& a = *arguments;
  CLI::App* c = program.app.add_subcommand("trace", "Draw the reference picture: geodesic rays and real mirrors, no copies");
  add_scene(*c, a.compile.scene);
  add_quality(*c, a.compile.scene,
              "Paths of each sample for light that surfaces pass on, instead of the scene's: draft (2), normal (8) or fine (32)");
  c->add_option("-o,--output", a.compile.output,
                "The picture: .png, .jpg, or .exr with all passes in floating point; - for PNG on standard output")
      ->required()
      ->type_name("FILE");
  add_samples(*c, a);
  c->add_option("--pass", a.pass, "What to draw; an .exr holds all of them")->capture_default_str()
      ->check(CLI::IsMember({"color", "depth", "normal", "object", "bounces", "weight"}))->type_name("NAME");
  add_exact(*c, a);
  add_noise(*c, a);
  c->footer(
      "Examples:\n  orbc trace s.yaml -o s.png --samples 16\n  orbc trace s.yaml -o s.png --noise 1/255\n  orbc trace s.yaml -o s.exr\n  "
      "orbc trace s.yaml -o depth.png --pass depth");
  add_common(*c, program.common);
  program.commands.push_back({c, [arguments](const Common& common) { return render(*arguments, common); }});
}

void define_compare(Program& program) {
  const auto arguments = std::make_shared<RenderArguments>();
  RenderArguments& a = *arguments;
  CLI::App* c = program.app.add_subcommand("compare", "Draw a scene by straight rays (left) and by curved ones (right), side by side");
  add_scene(*c, a.compile.scene);
  c->remove_option(c->get_option("--rays"));
  c->get_option("--size")->description("Size of each of the two pictures instead of the scene's");
  c->add_option("-o,--output", a.compile.output, "The picture, twice as wide as the scene's: .png or .jpg; - for PNG on standard output")
      ->required()
      ->type_name("FILE");
  c->add_option("--engine", a.engine, "Who draws: povray, blender or tracer")
      ->capture_default_str()
      ->check(CLI::IsMember({"povray", "blender", "tracer"}))
      ->type_name("NAME");
  c->add_option("--samples", a.samples, "Samples per pixel (default: 4)")->check(CLI::Range(1, 65536))->type_name("N");
  add_exact(*c, a);
  add_compile_options(*c, a.compile);
  c->footer("Examples:\n  orbc compare s.yaml -o both.png\n  orbc compare s.yaml -o both.jpg --engine povray --size 800x600");
  add_common(*c, program.common);
  program.commands.push_back({c, [arguments](const Common& common) { return compare(*arguments, common); }});
}

}  // namespace orbc::cli
