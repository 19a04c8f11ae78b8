// What several commands understand.
#include <CLI/CLI.hpp>

#include "compiler/cli/define.h"

namespace orbc::cli {

void add_common(CLI::App& command, Common& common) {
  command.add_flag("-q,--quiet", common.quiet, "Neither progress nor summary; errors only");
  command.add_flag("-v,--verbose", common.verbose, "Say more on the way");
  command.add_flag("--json", common.json, "Print the result as JSON on standard output");
  command.add_option("--threads", common.threads, "Threads to work with (0 = all cores); the result is the same for any number")
      ->check(CLI::Range(0, 1024))
      ->type_name("N");
  command
      .add_option("--max-memory", common.max_memory, "Stop rather than take more memory than this; renderers that are started take theirs")
      ->capture_default_str()
      ->type_name("SIZE");
}

void add_set(CLI::App& command, std::vector<std::string>& set) {
  command
      .add_option("--set", set,
                  "Say any key of the scene by its path, as often as wanted: camera.fov=60deg, 'objects.ball.at.polar=[0.2,30deg]', "
                  "room.walls.2.color=brown, lights.1.power=9; objects go by name or number; nothing behind = removes the key")
      ->allow_extra_args(false)
      ->type_name("KEY=VALUE");
}

void add_scene(CLI::App& command, SceneArguments& scene) {
  command.add_option("scene", scene.scene, "The scene file (YAML), or - for standard input")->required()->type_name("SCENE");
  add_set(command, scene.set);
  command.add_option("--size", scene.size, "Picture size instead of the scene's")->type_name("WxH");
  command.add_option("--max-bounces", scene.max_bounces, "Mirrors a ray may meet, instead of the scene's")
      ->check(CLI::Range(0, 1000))
      ->type_name("N");
  command
      .add_option("--projection", scene.projection,
                  "Camera instead of the scene's; stereo: two panoramas, that of the left eye on top (tracer)")
      ->check(CLI::IsMember({"perspective", "panorama", "cylinder", "stereo"}))
      ->type_name("NAME");
  command
      .add_option("--rays", scene.rays,
                  "Light along geodesics (curved), or for comparison the disk chart as straight rays show it, instead of the scene's")
      ->check(CLI::IsMember({"curved", "straight"}))
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
  command
      .add_option("--tolerance", a.tolerance,
                  "Nothing in the picture is displaced by more, in pixels: half of it is for bent edges, half for coarser meshes of far "
                  "things")
      ->capture_default_str()
      ->check(CLI::Range(1e-4, 1e4))
      ->type_name("PX");
  command
      .add_option("--max-triangles", a.max_triangles,
                  "Never make more triangles than this: the picture's error is let grow until they suffice, the report says how far")
      ->type_name("N");
  command.add_flag("--no-lod", a.no_lod, "Draw far copies in all detail, too");
  command.add_flag("!--no-highlights", a.highlights, "Leave out what glossy surfaces, metals, mirrors and glass show to this eye alone");
  command.add_option("--max-atlas", a.max_atlas, "Largest side of the atlas in pixels; some viewers hold no more than 8192")
      ->capture_default_str()
      ->check(CLI::Range(64, 16384))
      ->type_name("PX");
}

}  // namespace orbc::cli
