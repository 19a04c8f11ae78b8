#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace orbc::cli {

/// What every command understands.
struct Common {
  bool quiet = false;               ///< neither progress nor summary
  bool verbose = false;
  bool json = false;                ///< the result as JSON on standard output
  int threads = 0;                  ///< 0 = all cores
  std::string max_memory = "4GiB";  ///< of the program, without those that it starts
  std::vector<std::string> given;   ///< options on the command line, named without dashes
};

struct InfoArguments {
  std::string notation;
  int max_length = 12;
  std::string shape = "tangential";
  double cut = 1.4;
  bool allow_non_orbifold = false;
  int copies = 20;                  ///< with --json: how many of the first copies are told with their isometries
};
struct EnumerateArguments {
  int corners = 3;
  int max_order = 8;
  std::string space;                ///< only these; empty = all
  bool all = false;                 ///< also more than a million
};
struct SvgArguments {
  std::string notation;
  std::string output = "-";
  std::string size = "1000";        ///< pixels, or with a unit
  std::string model = "disk";
  bool labels = true;
  std::vector<std::string> colors;  ///< none or two
  std::string color_by = "parity";
  double lines = 1.2;
  std::string line_color;           ///< empty = paper
  std::string motif;                ///< empty = none
  bool cuts = false;
  std::vector<std::string> geodesics;  ///< "X1,Y1,X2,Y2" each
  double smallest = 1;              ///< pixels
  std::size_t max_copies = 100'000;
  std::string shape = "tangential";
  double cut = 1.4, aspect = 1, length = 4;
};
struct NewArguments {
  std::string notation = "*22222";
};
struct CheckArguments {
  std::vector<std::string> scenes;
  std::vector<std::string> set;     ///< KEY=VALUE
};

/// What changes a scene from the command line: shared by compile, render, trace and verify.
struct SceneArguments {
  std::string scene;
  std::vector<std::string> set;     ///< KEY=VALUE: any key of the scene
  std::string size;                 ///< "800x600"; empty = the scene's
  std::optional<int> max_bounces;
  std::string projection;           ///< empty = the scene's
  std::string rays;                 ///< curved, straight; empty = the scene's
  bool expected_background = false;
  std::string integrator;           ///< direct, path; empty = the scene's
  std::string atlas;                ///< 8, 16, exr; empty = the scene's
  std::string lights;               ///< baked, native; empty = the scene's
  std::string quality;              ///< draft, normal, fine; empty = the scene's
};
struct CompileArguments {
  SceneArguments scene;
  std::string output;
  std::string format;               ///< empty = by the ending of `output`
  std::string view = "eye";
  double tolerance = 0.5;           ///< pixels
  std::optional<std::uint64_t> max_triangles;
  bool no_lod = false;              ///< every copy in all detail
  std::string report;               ///< a file for the report as JSON; "-" = standard output
  bool nodes_per_copy = false;
  bool nodes_per_object = false;
  bool highlights = true;           ///< of glossy and metal surfaces, baked for the eye
  int max_atlas = 16384;            ///< pixels a side
  std::string model = "disk";       ///< svg: disk, klein, plane
  std::string color = "parity";    ///< svg: parity, length
  bool plan = false;                ///< only say what it would take
};
struct RenderArguments {
  CompileArguments compile;
  std::string engine = "tracer";
  int samples = 0;                  ///< per pixel; 0 = 4 for a picture to be looked at, 1 for other passes, which want the pixel's centre
  std::string pass = "color";       ///< tracer: what to draw
  bool exact = false;               ///< tracer: light every sample by itself
  std::string noise;                ///< tracer: "1/255", until which samples are added; empty = as many as `samples`
};

struct AtArguments {
  SceneArguments scene;
  double time = 0;                  ///< 0…1
};
struct AnimateArguments {
  RenderArguments render;           ///< `compile.output` is not used
  std::string folder;               ///< of the frames
  std::string format = "png";       ///< of a frame: png, jpg, exr
  std::string frames;               ///< "40-79"; empty = all
  std::string video;                ///< .webm or .mp4; empty = none
};

struct VerifyArguments {
  CompileArguments compile;
  int samples = 1;
  bool blender = false;
  int within = 2;                   ///< steps of 1/255: 1, 2, 4 or 8
  double threshold = 0.995;         ///< share of pixels that must agree so
  double off_edge = 1e-5;           ///< share of pixels that may differ by more than 2/255 off every edge
  std::string difference;           ///< a picture of the differences
  std::string keep;                 ///< stem for both pictures
};
struct DesignArguments {
  std::string scene;                ///< empty = the empty page
  std::string output;               ///< empty = a file in the folder for temporary files
  bool open = true;                 ///< in the browser
};
struct ExplainArguments {
  std::string code;                 ///< empty = all
};

struct DiffArguments {
  std::string left, right;
  double within = 0;                ///< of numbers: absolute up to 1, relative beyond
  int pixels = 0;                   ///< of pictures, in steps of 1/255
};

/// Each command returns the exit code: 0 done, 1 the scene is wrong, 2 usage, 3 the machine.
int info(const InfoArguments& arguments, const Common& common);
int enumerate(const EnumerateArguments& arguments, const Common& common);
int draw_svg(const SvgArguments& arguments, const Common& common);
int new_scene(const NewArguments& arguments, const Common& common);
int check(const CheckArguments& arguments, const Common& common);
int compile(const CompileArguments& arguments, const Common& common);
int design(const DesignArguments& arguments, const Common& common);
int render(const RenderArguments& arguments, const Common& common);
/// Straight rays on the left, curved ones on the right.
int compare(const RenderArguments& arguments, const Common& common);
int print_moment(const AtArguments& arguments, const Common& common);
int animate(const AnimateArguments& arguments, const Common& common);
int verify(const VerifyArguments& arguments, const Common& common);
/// 0 they agree, 1 they differ, 2 usage, 3 one of them cannot be read.
int diff(const DiffArguments& arguments, const Common& common);
int explain(const ExplainArguments& arguments, const Common& common);
int schema(const Common& common);

/// Parses the command line and runs the command.
int run(int argc, char** argv);

}  // namespace orbc::cli
