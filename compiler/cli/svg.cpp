#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <complex>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>

#include "compiler/cli/commands.h"
#include "compiler/cli/expanded_star.h"
#include "compiler/cli/output.h"
#include "compiler/cli/streams.h"
#include "compiler/cli/support.h"
#include "compiler/geometry/chart.h"
#include "compiler/image/srgb.h"
#include "compiler/notation/euler.h"
#include "compiler/notation/parse.h"
#include "compiler/notation/print.h"
#include "compiler/notation/symbol.h"
#include "compiler/room/glued_polygon.h"
#include "compiler/room/realise.h"
#include "compiler/scene/color.h"
#include "exporters/svg/draw_glued.h"
#include "exporters/svg/draw_room.h"

namespace orbc::cli {
namespace {

constexpr double kSmallest = 16, kLargest = 20000;  // pixels a side
constexpr std::size_t kLargestMotif = 1 << 20;      // bytes of its file

/// A picture's size as it is written into the file.
struct PrintSize {
  double width = 0, height = 0;  ///< pixels of 1/96 inch; height 0: what suits the room
  std::string unit;
  double per_unit = 1;
};

/// "800", "800x600", "200mm", "8x6in".
PrintSize parse_print_size(const std::string& text) {
  static constexpr std::pair<const char*, double> kUnits[] = {
      {"mm", 96 / 25.4}, {"cm", 96 / 2.54}, {"in", 96}, {"pt", 96.0 / 72}, {"px", 1}};
  PrintSize size;
  std::string numbers = text;
  for (const auto& [unit, pixels] : kUnits) {
    if (numbers.size() < 3 || numbers.compare(numbers.size() - 2, 2, unit) != 0) continue;
    numbers.resize(numbers.size() - 2);
    size.unit = unit;
    size.per_unit = pixels;
    break;
  }
  double values[2] = {0, 0};
  int count = 0, wanted = 1;
  const char *at = numbers.data(), *end = at + numbers.size();
  while (count < 2) {
    const auto [next, error] = std::from_chars(at, end, values[count], std::chars_format::fixed);
    if (error != std::errc()) break;
    ++count;
    at = next;
    if (at == end || (*at != 'x' && *at != 'X')) break;
    wanted = 2;
    ++at;
  }
  for (double& value : values) value *= size.per_unit;
  size.width = values[0];
  size.height = values[1];
  const auto fits = [](double side) { return side >= kSmallest && side <= kLargest; };
  if (count != wanted || at != end || !fits(size.width) || (count == 2 && !fits(size.height)))
    throw UsageError(fmt::format(
        "--size wants WIDTH or WIDTHxHEIGHT, in pixels or with mm, cm, in or pt, such as 800, 800x600, 200mm, and {} to {} pixels; got {}",
        kSmallest, kLargest, text));
  return size;
}

std::string hex_of(const std::string& color, const char* option) {
  const auto parsed = scene::parse_color(color);
  if (!parsed) throw UsageError(fmt::format("{} does not know the color {}; colors are names such as coral, or #ff7f50", option, color));
  return fmt::format("#{:02x}{:02x}{:02x}", image::encode_srgb8(parsed->r), image::encode_srgb8(parsed->g), image::encode_srgb8(parsed->b));
}

Result<svg::Motif> motif_of(const std::string& text) {
  std::error_code error;
  if (text.size() < 2 || !std::filesystem::is_regular_file(text, error)) return svg::read_motif(text);
  if (std::filesystem::file_size(text, error) > kLargestMotif || error)
    return make_error("svg.bad-motif", text + " is larger than a motif may be (1 MiB)", "every tile repeats it: simplify it");
  std::ifstream file(text, std::ios::binary);
  const std::string bytes((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  return svg::read_motif(bytes);
}

svg::Chart chart_of(const std::string& model) {
  if (model == "klein") return svg::Chart::klein;
  if (model == "half-plane") return svg::Chart::half_plane;
  return model == "hyperboloid" ? svg::Chart::hyperboloid : svg::Chart::disk;
}

/// The geodesic through two points of the disk chart; of the plane in flat rooms.
svg::Geodesic geodesic_of(const std::string& text, geometry::Space space) {
  double values[4] = {};
  const char *at = text.data(), *end = at + text.size();
  int count = 0;
  while (count < 4) {
    const auto [next, error] = std::from_chars(at, end, values[count]);
    if (error != std::errc() || !std::isfinite(values[count])) break;
    ++count;
    at = next;
    if (at == end || *at != ',') break;
    ++at;
  }
  if (count != 4 || at != end)
    throw UsageError("--geodesic wants two points of the disk, X1,Y1,X2,Y2, such as 0.1,0.35,-0.4,0.1; got " + text);
  const std::complex<double> p(values[0], values[1]), q(values[2], values[3]);
  if (space == geometry::Space::hyperbolic && !(std::norm(p) < 0.999 * 0.999 && std::norm(q) < 0.999 * 0.999))
    throw UsageError("--geodesic wants points inside the disk, nearer to its centre than 0.999; got " + text);
  const svg::Geodesic geodesic{geometry::point_from_disk(space, p), geometry::point_from_disk(space, q)};
  const double apart = geometry::distance(space, geodesic.from, geodesic.to);
  if (!(apart > 1e-6) || (space == geometry::Space::spherical && apart > 3.14159))
    throw UsageError("--geodesic wants two points that fix a geodesic, neither the same nor opposite ones; got " + text);
  return geodesic;
}

Result<svg::RoomPicture> picture_of(const SvgArguments& a) {
  svg::RoomPicture picture;
  const PrintSize size = parse_print_size(a.size);
  picture.width = size.width;
  picture.height = size.height;
  picture.look.unit = size.unit;
  picture.look.per_unit = size.per_unit;
  picture.chart = chart_of(a.model);
  picture.coloring = a.color_by == "length" ? driver::Tiling::Coloring::length : driver::Tiling::Coloring::parity;
  picture.look.labels = a.labels;
  picture.look.tooltips = a.labels;
  picture.look.cuts = a.cuts;
  picture.look.lines = a.lines;
  if (!a.line_color.empty()) picture.look.line_color = hex_of(a.line_color, "--line-color");
  if (!a.colors.empty()) {
    if (a.colors.size() != 2) throw UsageError("--colors wants two colors, such as white,black");
    picture.look.colors = {hex_of(a.colors[0], "--colors"), hex_of(a.colors[1], "--colors")};
  }
  picture.fill.smallest = a.smallest;
  picture.fill.max_copies = a.max_copies;
  if (a.motif.empty()) return picture;
  auto motif = motif_of(a.motif);
  if (!motif) return std::move(motif).error();
  picture.look.motif = *std::move(motif);
  return picture;
}

Result<room::Room> room_of(const SvgArguments& a, Diagnostics& notes) {
  notation::ParseOptions options;
  options.span = {std::make_shared<SourceText>(SourceText{"notation", a.notation}), 1, 1, a.notation.size()};
  auto parsed = notation::parse_with_notes(a.notation, options);
  if (!parsed) return with_star_hint(parsed.error(), a.notation);
  notes = parsed->notes;
  scene::Shape shape;
  shape.kind = a.shape == "paper" ? scene::ShapeKind::paper : scene::ShapeKind::tangential;
  shape.cut = a.cut;
  shape.aspect = a.aspect;
  shape.strip_length = a.length;
  auto room = room::realise(parsed->orbifold, shape);
  if (!room) return located(room.error(), options.span);
  return room;
}

void check_model(const SvgArguments& a, const room::Room& room) {
  const std::string text = notation::to_text(room.orbifold);
  if ((a.model == "half-plane" || a.model == "hyperboloid") && room.space != geometry::Space::hyperbolic)
    throw UsageError(fmt::format("--model {} shows the hyperbolic plane, and {} is {}", a.model, text, geometry::name(room.space)));
  if (a.model == "plane" && room.space != geometry::Space::euclidean)
    throw UsageError(
        fmt::format("--model plane shows the Euclidean plane, and {} is {}; use disk or klein", text, geometry::name(room.space)));
}

}  // namespace

namespace {

/// Writes a drawing, and says so.
void write_drawing(const SvgArguments& a, const Common& common, const std::string& notation, const svg::RoomDrawing& drawing,
                   const Diagnostics& notes) {
  if (!common.quiet) print_message(to_text(notes));
  write_output(a.output, drawing.svg);
  if (common.json)
    write_standard_output(
        nlohmann::ordered_json{
            {"output", a.output}, {"notation", notation}, {"copies", drawing.copies}, {"width", drawing.width}, {"height", drawing.height}}
            .dump(2) +
        "\n");
  else if (!common.quiet && a.output != "-") print_message(fmt::format("{}: {} copies of {}\n", a.output, drawing.copies, notation));
}

/// Draws an orbifold that is not closed by mirrors alone. Nothing if the text is no such symbol.
std::optional<int> draw_symbol(const SvgArguments& a, const Common& common) {
  const auto symbol = notation::parse_symbol(a.notation);
  if (!symbol || notation::is_kaleidoscopic(*symbol) || notation::to_text(*symbol) == "1") return std::nullopt;
  const SourceSpan span{std::make_shared<SourceText>(SourceText{"notation", a.notation}), 1, 1, a.notation.size()};
  const auto polygon = room::glued_polygon(*symbol);
  if (!polygon) return print(located(polygon.error(), span), common), kSceneWrong;
  if (a.model == "hyperboloid" || (a.model == "half-plane" && polygon->space != geometry::Space::hyperbolic) ||
      (a.model == "plane" && polygon->space != geometry::Space::euclidean))
    throw UsageError(
        fmt::format("--model {} does not show {}, which is {}; use disk or klein", a.model, a.notation, geometry::name(polygon->space)));
  if (a.cuts || a.shape != "tangential") throw UsageError("cuts and shapes belong to rooms closed by mirrors alone");
  auto picture = picture_of(a);
  if (!picture) return print(picture.error(), common), kSceneWrong;
  for (const std::string& text : a.geodesics) picture->look.geodesics.push_back(geodesic_of(text, polygon->space));
  check_outputs({a.output});
  refuse_inputs({a.output}, {a.motif});
  write_drawing(a, common, notation::to_text(*symbol), svg::draw_glued(notation::to_text(*symbol), *polygon, *picture), {});
  return kDone;
}

}  // namespace

int draw_svg(const SvgArguments& a, const Common& common) {
  if (common.json && a.output == "-")
    throw UsageError("only one thing can go to standard output: the picture or --json; write it with -o FILE");
  Diagnostics notes;
  const auto room = room_of(a, notes);
  if (!room) {
    if (const auto done = draw_symbol(a, common)) return *done;
    print(room.error(), common);
    return kSceneWrong;
  }
  check_model(a, *room);
  auto picture = picture_of(a);
  if (!picture) {
    print(picture.error(), common);
    return kSceneWrong;
  }
  for (const std::string& text : a.geodesics) picture->look.geodesics.push_back(geodesic_of(text, room->space));
  check_outputs({a.output});
  refuse_inputs({a.output}, {a.motif});
  const svg::RoomDrawing drawing = svg::draw_room(*room, *picture);
  notes.insert(notes.end(), drawing.notes.begin(), drawing.notes.end());
  write_drawing(a, common, notation::to_text(room->orbifold), drawing, notes);
  return kDone;
}

}  // namespace orbc::cli
