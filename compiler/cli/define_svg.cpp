#include <CLI/CLI.hpp>

#include "compiler/cli/define.h"
#include "compiler/cli/expanded_star.h"

namespace orbc::cli {
namespace {

void add_shape(CLI::App& c, SvgArguments& a) {
  c.add_option("--shape", a.shape, "Shape of the room: tangential (all walls touch one circle) or paper (cuts of given length)")
      ->capture_default_str()
      ->check(CLI::IsMember({"tangential", "paper"}))
      ->type_name("NAME");
  c.add_option("--cut", a.cut, "Length of every cut of the paper's shape")
      ->capture_default_str()
      ->check(CLI::Range(1e-6, 100.0))
      ->type_name("LENGTH");
  c.add_option("--aspect", a.aspect, "*2222: side 1 divided by side 2")
      ->capture_default_str()
      ->check(CLI::Range(0.001, 1000.0))
      ->type_name("RATIO");
  c.add_option("--length", a.length, "** and *22∞: how long the strip is, in half widths")
      ->capture_default_str()
      ->check(CLI::Range(1e-3, 1000.0))
      ->type_name("LENGTH");
}

}  // namespace

void define_svg(Program& program) {
  const auto arguments = std::make_shared<SvgArguments>();
  SvgArguments& a = *arguments;
  CLI::App* c = program.app.add_subcommand("svg", "Draw the tiling by a room, as far as it can be seen, without a scene");
  c->add_option("notation", a.notation, "Orbifold notation; quote it, shells love the star")->required()->type_name("NOTATION");
  c->add_option("-o,--output", a.output, "Where to write; - for standard output")->capture_default_str()->type_name("FILE");
  c->add_option("--size", a.size, "Width, or width and height: pixels, or with mm, cm, in or pt")
      ->capture_default_str()
      ->type_name("N|WxH");
  c->add_option(
       "--model", a.model,
       "disk (Poincaré, stereographic, plane), klein (straight walls), half-plane or hyperboloid (hyperbolic rooms), or plane (flat "
       "rooms)")
      ->capture_default_str()
      ->check(CLI::IsMember({"disk", "klein", "half-plane", "hyperboloid", "plane"}))
      ->type_name("NAME");
  c->add_flag("!--no-labels", a.labels, "Neither orders of corners, numbers of walls nor caption; flat tilings reach the edge of the page");
  c->add_option("--colors,--colours", a.colors, "Two colors: of the room and its even images, and of mirror images")
      ->delimiter(',')
      ->type_name("A,B");
  c->add_option("--color-by,--colour-by", a.color_by, "What colors tell: parity, or length (mirrors on the way to a copy)")
      ->capture_default_str()
      ->check(CLI::IsMember({"parity", "length"}))
      ->type_name("RULE");
  c->add_option("--lines", a.lines, "Width of the lines between large copies on a page 1000 wide; 0 for none")
      ->capture_default_str()
      ->check(CLI::Range(0.0, 100.0))
      ->type_name("WIDTH");
  c->add_option("--line-color,--line-colour", a.line_color, "Color of these lines")->type_name("COLOR");
  c->add_option("--motif", a.motif, "What stands in every tile: a letter, SVG path data, or an SVG file")->type_name("MOTIF");
  c->add_flag("--cuts", a.cuts, "The cuts of the paper's decomposition, dashed");
  c->add_option("--geodesic", a.geodesics, "The whole geodesic through two points of the disk, in every model; may be said again")
      ->type_name("X1,Y1,X2,Y2");
  c->add_option("--smallest", a.smallest, "Leave out copies narrower than so many pixels")
      ->capture_default_str()
      ->check(CLI::Range(0.05, 1000.0))
      ->type_name("PX");
  c->add_option("--max-copies", a.max_copies, "Never draw more copies than this; a note tells what is left out")
      ->capture_default_str()
      ->check(CLI::Range(1, 10'000'000))
      ->type_name("N");
  add_shape(*c, a);
  c->footer(
      "Examples:\n  orbc svg '*237' -o t.svg\n  orbc svg '*22222' --motif F --colors white,black --lines 0 -o f.svg\n"
      "  orbc svg '*22222' --shape paper --cuts --size 200mm -o cuts.svg\n  orbc svg '*237' --model half-plane > h.svg");
  add_common(*c, program.common);
  program.commands.push_back({c, [arguments](const Common& common) { return draw_svg(*arguments, common); },
                              [](const std::vector<std::string>& words) { return expanded_star_message("svg", words); }});
}

}  // namespace orbc::cli
