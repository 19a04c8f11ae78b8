// Commands of films.
#include <CLI/CLI.hpp>

#include "compiler/cli/define.h"

namespace orbc::cli {

void define_at(Program& program) {
  const auto arguments = std::make_shared<AtArguments>();
  AtArguments& a = *arguments;
  CLI::App* c = program.app.add_subcommand("at", "Print the scene of one moment of a film, as YAML");
  add_scene(*c, a.scene);
  c->add_option("--time", a.time, "The moment: 0 is the first frame, 1 where the film begins again")
      ->required()
      ->check(CLI::Range(0.0, 1.0))
      ->type_name("T");
  c->footer("Examples:\n  orbc at film.yaml --time 0.25\n  orbc at film.yaml --time 0.25 | orbc render - -o quarter.png");
  add_common(*c, program.common);
  program.commands.push_back({c, [arguments](const Common& common) { return print_moment(*arguments, common); }});
}

void define_animate(Program& program) {
  const auto arguments = std::make_shared<AnimateArguments>();
  AnimateArguments& a = *arguments;
  CLI::App* c = program.app.add_subcommand("animate", "Draw the frames of a film; frames that are there and still true are kept");
  add_scene(*c, a.render.compile.scene);
  c->add_option("-o,--output", a.folder, "Folder of the frames and of manifest.json, which says what each was made of")
      ->required()
      ->type_name("FOLDER");
  c->add_option("--frames", a.frames, "Only these, counted from 0: 40-79")->type_name("FIRST-LAST");
  c->add_option("--engine", a.render.engine, "Who draws: povray, blender or tracer")
      ->capture_default_str()
      ->check(CLI::IsMember({"povray", "blender", "tracer"}))
      ->type_name("NAME");
  c->add_option("--samples", a.render.samples, "Samples per pixel (default: 4)")->check(CLI::Range(1, 65536))->type_name("N");
  c->add_option("--format", a.format, "Format of a frame: png, jpg or, with the tracer, exr")
      ->capture_default_str()
      ->check(CLI::IsMember({"png", "jpg", "exr"}))
      ->type_name("NAME");
  c->add_option("--video", a.video, "Have ffmpeg make a video of all frames: .webm (VP9) or .mp4 (H.264)")->type_name("FILE");
  add_compile_options(*c, a.render.compile);
  c->footer(
      "Run it again after Ctrl-C, a crash or a change of the scene: it draws what is missing or no longer true. Several may run at once, "
      "on several machines with one disk.\n\nExamples:\n  orbc animate film.yaml -o film/ --video film.webm\n  orbc animate film.yaml -o "
      "film/ --frames 0-39 --size 320x240 --samples 1");
  add_common(*c, program.common);
  program.commands.push_back({c, [arguments](const Common& common) { return animate(*arguments, common); }});
}

}  // namespace orbc::cli
