// The command line: options in, exit code out. Every option stands here once; --help, the man page and the completions come from it.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <iostream>
#include <new>
#include <string>
#include <system_error>
#include <vector>

#include "compiler/base/diagnostic.h"
#include "compiler/base/progress.h"
#include "compiler/cli/commands.h"
#include "compiler/cli/manual.h"
#include "compiler/cli/output.h"
#include "compiler/cli/progress_bar.h"
#include "compiler/cli/support.h"

namespace orbc::cli {
namespace {

constexpr int kInterrupted = 130;

void add_common(CLI::App& command, Common& common) {
  command.add_flag("-q,--quiet", common.quiet, "Neither progress nor summary; errors only");
  command.add_flag("-v,--verbose", common.verbose, "Say more on the way");
  command.add_flag("--json", common.json, "Print the result as JSON on standard output");
  command.add_option("--threads", common.threads, "Threads to work with (0 = all cores); the result is the same for any number")
      ->check(CLI::Range(0, 1024))
      ->type_name("N");
}

void add_scene(CLI::App& command, SceneArguments& scene) {
  command.add_option("scene", scene.scene, "The scene file (YAML), or - for standard input")->required()->type_name("SCENE");
  command.add_option("--size", scene.size, "Picture size instead of the scene's")->type_name("WxH");
  command.add_option("--max-bounces", scene.max_bounces, "Mirrors a ray may meet, instead of the scene's")
      ->check(CLI::Range(0, 1000))
      ->type_name("N");
  command.add_option("--projection", scene.projection, "Camera instead of the scene's")
      ->check(CLI::IsMember({"perspective", "panorama", "cylinder"}))
      ->type_name("NAME");
  command.add_flag("--expected-background", scene.expected_background,
                   "Where mirrors are followed no further show the colour expected beyond, instead of the background");
  command
      .add_option("--integrator", scene.integrator,
                  "Light of lamps alone (direct), or also what surfaces pass on to each other (path), instead of the scene's")
      ->check(CLI::IsMember({"direct", "path"}))
      ->type_name("NAME");
}

void add_quality(CLI::App& command, SceneArguments& scene, const std::string& help) {
  command.add_option("--quality", scene.quality, help)->check(CLI::IsMember({"draft", "normal", "fine"}))->type_name("NAME");
}

void add_compile_options(CLI::App& command, CompileArguments& a) {
  add_quality(command, a.scene, "How finely light is baked, instead of the scene's: draft, normal or fine");
  command
      .add_option("--atlas", a.scene.atlas,
                  "How finely the atlas holds colours, instead of the scene's: 8 or 16 bits (PNG), or exr (half floats)")
      ->check(CLI::IsMember({"8", "16", "exr"}))
      ->type_name("DEPTH");
  command
      .add_option("--lights", a.scene.lights,
                  "Who lights exports, instead of the scene's: baked (orbc, along geodesics) or native (the renderer's own lamps; true in "
                  "flat rooms)")
      ->check(CLI::IsMember({"baked", "native"}))
      ->type_name("NAME");
  command.add_option("--tolerance", a.tolerance, "Largest error of a bent edge, in pixels of the picture")
      ->capture_default_str()
      ->check(CLI::Range(1e-4, 1e4))
      ->type_name("PX");
  command
      .add_option("--max-triangles", a.max_triangles,
                  "Never make more triangles than this: the picture's error is let grow until they suffice, the report says how far")
      ->type_name("N");
  command.add_flag("--no-lod", a.no_lod, "Draw far copies in all detail, too");
  command.add_option("--max-memory", a.max_memory, "Refuse what would take more memory than this")
      ->capture_default_str()
      ->type_name("SIZE");
  command.add_flag("!--no-highlights", a.highlights, "Leave out what glossy surfaces, metals, mirrors and glass show to this eye alone");
  command.add_option("--max-atlas", a.max_atlas, "Largest side of the atlas in pixels; some viewers hold no more than 8192")
      ->capture_default_str()
      ->check(CLI::Range(64, 16384))
      ->type_name("PX");
}

void define_info(CLI::App& app, InfoArguments& a, Common& common) {
  CLI::App* c = app.add_subcommand("info", "What is known of an orbifold: its space, area, group, number of copies, side lengths");
  c->add_option("notation", a.notation, "Orbifold notation; quote it, shells love the star")->required()->type_name("NOTATION");
  c->add_option("--max-length", a.max_length, "Count the copies up to this word length")
      ->capture_default_str()
      ->check(CLI::Range(0, 10000))
      ->type_name("N");
  c->add_option("--shape", a.shape, "Shape of the room: tangential (all walls touch one circle) or paper (cuts of given length)")
      ->capture_default_str()
      ->check(CLI::IsMember({"tangential", "paper"}))
      ->type_name("NAME");
  c->add_option("--cut", a.cut, "Length of every cut of the paper's shape")
      ->capture_default_str()
      ->check(CLI::Range(1e-6, 100.0))
      ->type_name("LENGTH");
  c->add_flag("--allow-non-orbifold", a.allow_non_orbifold, "Accept real-valued corners such as *(3/2)(12)(12)");
  c->footer("Examples:\n  orbc info '*237'\n  orbc info '*23456789(10)(11)' --json\n  orbc info '*22222' --shape paper --cut 1.4");
  add_common(*c, common);
}

void define_enumerate(CLI::App& app, EnumerateArguments& a, Common& common) {
  CLI::App* c = app.add_subcommand("enumerate", "List all orbifolds with a given number of corners, by space");
  c->add_option("--corners", a.corners, "Number of corners (and walls)")->capture_default_str()->check(CLI::Range(0, 40))->type_name("N");
  c->add_option("--max-order", a.max_order, "Largest corner order")->capture_default_str()->check(CLI::Range(2, 1000000))->type_name("K");
  c->add_option("--space", a.space, "Only these")->check(CLI::IsMember({"spherical", "euclidean", "hyperbolic"}))->type_name("NAME");
  c->footer("Examples:\n  orbc enumerate --corners 3 --max-order 8\n  orbc enumerate --corners 4 --max-order 3 --json");
  add_common(*c, common);
}

void define_scene_commands(CLI::App& app, NewArguments& fresh, CheckArguments& checked, Common& common) {
  CLI::App* n = app.add_subcommand("new", "Print a commented starter scene for an orbifold");
  n->add_option("notation", fresh.notation, "Orbifold notation")->capture_default_str()->type_name("NOTATION");
  n->footer("Examples:\n  orbc new '*2323' > s.yaml\n  orbc new '*235' > dodecahedral.yaml");
  add_common(*n, common);
  CLI::App* c = app.add_subcommand("check", "Check scenes and say everything that is wrong with them");
  c->add_option("scenes", checked.scenes, "Scene files, or - for standard input")->required()->type_name("SCENE");
  c->footer("Examples:\n  orbc check s.yaml\n  orbc check examples/*/scene.yaml --json");
  add_common(*c, common);
}

void define_compile(CLI::App& app, CompileArguments& a, Common& common) {
  CLI::App* c = app.add_subcommand("compile", "Unfold the mirrors, bend every copy for the eye, and write a file for a renderer");
  add_scene(*c, a.scene);
  c->add_option("-o,--output", a.output, "Where to write; - for standard output")->type_name("FILE");
  c->add_option("-f,--format", a.format, "pov, glb, gltf or svg (default: by the ending of the output)")
      ->check(CLI::IsMember({"pov", "glb", "gltf", "svg"}))
      ->type_name("FORMAT");
  c->add_option("--view", a.view, "eye (for straight rays from the camera) or disk (the conformal chart, seen from anywhere)")
      ->capture_default_str()
      ->check(CLI::IsMember({"eye", "disk"}))
      ->type_name("VIEW");
  add_compile_options(*c, a);
  c->add_option("--report", a.report, "Write copies, triangles and error bounds as JSON")->type_name("FILE");
  c->add_flag("--nodes-per-copy", a.nodes_per_copy, "glTF: one node for every copy, so that copies can be clicked");
  c->add_option("--model", a.model, "SVG: disk, klein or plane")
      ->capture_default_str()
      ->check(CLI::IsMember({"disk", "klein", "plane"}))
      ->type_name("MODEL");
  c->add_option("--colour", a.colour, "SVG: colour the copies by parity or length")
      ->capture_default_str()
      ->check(CLI::IsMember({"parity", "length"}))
      ->type_name("RULE");
  c->add_flag("--plan", a.plan, "Only say how many copies, triangles and bytes it would take");
  c->footer(
      "Examples:\n  orbc compile s.yaml -o s.glb\n  orbc compile s.yaml -o s.svg --model klein\n  orbc compile s.yaml -f pov -o - | "
      "scripts/povray-pipe -o s.png");
  add_common(*c, common);
}

void define_render(CLI::App& app, RenderArguments& a, Common& common) {
  CLI::App* c = app.add_subcommand("render", "Draw a scene in one go");
  add_scene(*c, a.compile.scene);
  c->add_option("-o,--output", a.compile.output, "The picture (PNG)")->required()->type_name("FILE");
  c->add_option("--engine", a.engine, "Who draws: povray, blender or tracer")
      ->capture_default_str()
      ->check(CLI::IsMember({"povray", "blender", "tracer"}))
      ->type_name("NAME");
  c->add_option("--samples", a.samples, "Samples per pixel")->capture_default_str()->check(CLI::Range(1, 65536))->type_name("N");
  c->add_option("--pass", a.pass, "Tracer: what to draw; an .exr holds all of them")->capture_default_str()
      ->check(CLI::IsMember({"color", "depth", "normal", "object", "bounces", "weight"}))->type_name("NAME");
  add_compile_options(*c, a.compile);
  c->footer(
      "Examples:\n  orbc render s.yaml -o s.png\n  orbc render s.yaml -o s.png --engine povray --samples 9\n  orbc render s.yaml -o "
      "pano.png --projection panorama --size 2048x1024");
  add_common(*c, common);
}

void define_trace(CLI::App& app, RenderArguments& a, Common& common) {
  CLI::App* c = app.add_subcommand("trace", "Draw the reference picture: geodesic rays and real mirrors, no copies");
  add_scene(*c, a.compile.scene);
  add_quality(*c, a.compile.scene,
              "Paths of each sample for light that surfaces pass on, instead of the scene's: draft (2), normal (8) or fine (32)");
  c->add_option("-o,--output", a.compile.output, "The picture: .png, or .exr with all passes in floating point")
      ->required()
      ->type_name("FILE");
  c->add_option("--samples", a.samples, "Samples per pixel")->capture_default_str()->check(CLI::Range(1, 65536))->type_name("N");
  c->add_option("--pass", a.pass, "What to draw; an .exr holds all of them")->capture_default_str()
      ->check(CLI::IsMember({"color", "depth", "normal", "object", "bounces", "weight"}))->type_name("NAME");
  c->footer(
      "Examples:\n  orbc trace s.yaml -o s.png --samples 16\n  orbc trace s.yaml -o s.exr\n  orbc trace s.yaml -o depth.png --pass depth");
  add_common(*c, common);
}

void define_verify(CLI::App& app, VerifyArguments& a, Common& common) {
  CLI::App* c = app.add_subcommand("verify", "Draw a scene by both roads, export and tracer, and compare the pictures pixel by pixel");
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
  c->add_option("--difference", a.difference, "Write a picture of the differences")->type_name("FILE");
  c->add_option("--keep", a.keep, "Write both pictures as STEM-export.png and STEM-tracer.png")->type_name("STEM");
  a.compile.tolerance = 0.05;
  add_compile_options(*c, a.compile);
  c->get_option("--quality")
      ->description(
          "How finely light is baked: draft, normal or fine; when not given, fine in the export, and the tracer takes the scene's");
  c->footer(
      "Examples:\n  orbc verify s.yaml\n  orbc verify lit.yaml --samples 64 --within 4 --threshold 0.99\n"
      "  orbc verify s.yaml --blender --difference diff.png");
  add_common(*c, common);
}

/// A misspelt command, said as such: CLI11 would call it and all words after it "not expected".
/// Makes: whether the first word was meant as a command and is none; then it has been told.
bool told_unknown_command(const CLI::App& app, int argc, char** argv) {
  if (argc < 2 || argv[1][0] == '-') return false;
  std::vector<std::string> commands;
  for (const CLI::App* command : app.get_subcommands(nullptr)) commands.push_back(command->get_name());
  if (std::find(commands.begin(), commands.end(), argv[1]) != commands.end()) return false;
  const std::string nearest = nearest_word(argv[1], commands);
  if (nearest.empty())
    fmt::print(stderr, "orbc: there is no command `{}`; the commands are {}\n", argv[1], fmt::join(commands, ", "));
  else
    fmt::print(stderr, "orbc: there is no command `{}`; did you mean `{}`?\n", argv[1], nearest);
  return true;
}

int dispatch(int argc, char** argv) {
  CLI::App app(
      "orbc compiles rooms with mirrors. It realises the room of an orbifold notation such as *22222 on the sphere, the plane or the\n"
      "hyperbolic plane, unfolds its mirrors, bends every copy for the eye and writes files that POV-Ray and Blender draw truly.",
      "orbc");
  app.set_version_flag("--version", std::string("orbc ") + ORBC_VERSION);
  app.require_subcommand(0, 1);
  app.footer(
      "Start here:\n  orbc new '*2323' > s.yaml\n  orbc render s.yaml -o s.png --engine povray\n\norbc COMMAND --help tells more of a "
      "command. Exit codes: 0 done, 1 the scene is wrong, 2 usage, 3 the machine.");
  Common common;
  InfoArguments info_arguments;
  EnumerateArguments enumerate_arguments;
  NewArguments new_arguments;
  CheckArguments check_arguments;
  CompileArguments compile_arguments;
  RenderArguments render_arguments, trace_arguments;
  VerifyArguments verify_arguments;
  define_info(app, info_arguments, common);
  define_enumerate(app, enumerate_arguments, common);
  define_scene_commands(app, new_arguments, check_arguments, common);
  define_compile(app, compile_arguments, common);
  define_render(app, render_arguments, common);
  define_trace(app, trace_arguments, common);
  define_verify(app, verify_arguments, common);
  std::string shell;
  CLI::App* complete = app.add_subcommand("completion", "Print the completion script of a shell");
  complete->add_option("shell", shell, "bash, zsh or fish")->required()->check(CLI::IsMember({"bash", "zsh", "fish"}))->type_name("SHELL");
  CLI::App* manual = app.add_subcommand("man", "Print the man page");

  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);
    if (told_unknown_command(app, argc, argv)) return kUsage;
    app.exit(error, std::cerr, std::cerr);
    return kUsage;
  }
  if (app.got_subcommand("info")) return info(info_arguments, common);
  if (app.got_subcommand("enumerate")) return enumerate(enumerate_arguments, common);
  if (app.got_subcommand("new")) return new_scene(new_arguments, common);
  if (app.got_subcommand("check")) return check(check_arguments, common);
  if (app.got_subcommand("compile")) return compile(compile_arguments, common);
  if (app.got_subcommand("render")) return render(render_arguments, common);
  if (app.got_subcommand("trace")) return render(trace_arguments, common);
  if (app.got_subcommand("verify")) return verify(verify_arguments, common);
  if (app.got_subcommand(complete)) return write_output("-", completion(app, shell)), 0;
  if (app.got_subcommand(manual)) return write_output("-", man_page(app)), 0;
  write_output("-", app.help());
  return 0;
}

}  // namespace

int run(int argc, char** argv) {
  install_interrupt_handler();
  try {
    return dispatch(argc, argv);
  } catch (const UsageError& error) {
    fmt::print(stderr, "orbc: {}\n", error.what());
    return kUsage;
  } catch (const Cancelled&) {
    fmt::print(stderr, "orbc: stopped; nothing was written\n");
    return kInterrupted;
  } catch (const std::bad_alloc&) {
    fmt::print(stderr, "orbc: out of memory; try fewer --max-bounces or a larger --tolerance\n");
  } catch (const std::system_error& error) {
    fmt::print(stderr, "orbc: {}\n", error.what());
  } catch (const std::exception& error) {
    fmt::print(stderr, "orbc: {}\n", error.what());
  }
  return kMachine;
}

}  // namespace orbc::cli
