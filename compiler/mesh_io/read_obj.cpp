// Wavefront OBJ (Wavefront "Advanced Visualizer" manual, appendix B): v, vt, f, usemtl, mtllib. Negative indices count back from the last
// vertex read so far; positive ones may name vertices that come later. Lines that end in '\' go on in the next.
#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>

#include "compiler/files/files.h"
#include "compiler/mesh_io/colors.h"
#include "compiler/mesh_io/errors.h"
#include "compiler/mesh_io/read_mtl.h"
#include "compiler/mesh_io/readers.h"
#include "compiler/mesh_io/texture_loader.h"
#include "compiler/mesh_io/tokens.h"
#include "compiler/mesh_io/transparency.h"

namespace orbc::mesh_io {
namespace {

constexpr std::uint32_t kNoUv = 0xffffffff;
/// Of vertices without a colour in a file where others have one: the plain colour, as sRGB encodes it.
constexpr mesh::LinearColor kNoColor{0.906f, 0.906f, 0.906f};
constexpr std::uint64_t kMaxMtlBytes = std::uint64_t{16} << 20;

/// A corner whose vertex or uv was not there yet when it was read.
struct ForwardReference {
  std::int64_t index;  ///< from 0
  std::size_t line;
  std::string_view word;  ///< in the text that is read
};

/// What has been read of the file.
struct ObjData {
  PolygonSoup soup;
  std::vector<std::array<float, 2>> uv;
  std::vector<std::uint32_t> corner_uv;  ///< of each corner, index into `uv` or kNoUv
  std::vector<ForwardReference> forward_vertices, forward_uv;
  std::vector<std::string> material_names{""};  ///< in the order of their first usemtl; the first stands for none
  std::map<std::string, std::uint32_t> index_of_name{{"", 0}};
  std::vector<std::uint32_t> face_name;  ///< of each face, index into `material_names`
  std::uint32_t current_name = 0;
  std::vector<std::string> libraries;
  std::vector<mesh::LinearColor> zbrush_colors;
  std::uint64_t skipped = 0;
};

std::string line_text(const Tokens& tokens) { return fmt::format("line {}", tokens.line()); }

/// The next word of the statement: a lone '\' at the end of a line continues it.
std::string_view next_word(Tokens& tokens) {
  while (true) {
    const auto found = tokens.next_in_line();
    if (found != "\\" || tokens.at_end()) return found.empty() || found.front() == '#' ? std::string_view{} : found;
    tokens.rest_of_line();
  }
}

void skip_statement(Tokens& tokens) {
  std::string_view rest;
  do rest = tokens.rest_of_line();
  while (!rest.empty() && rest.back() == '\\' && rest.front() != '#' && !tokens.at_end());
}

/// Up to `values.size()` numbers, at least `required`. Makes: how many there were.
Result<std::size_t> read_numbers(Tokens& tokens, std::size_t required, double bound, std::array<double, 3>& values,
                                 const ReadContext& context) {
  for (std::size_t k = 0; k < values.size(); ++k) {
    const auto text = next_word(tokens);
    if (text.empty() && k >= required) return k;
    if (text.empty()) return truncated(context.name, fmt::format("{}: {} numbers are too few", line_text(tokens), k));
    const auto value = to_number(text);
    if (!value) return bad_number(context.name, line_text(tokens), text);
    if (!(std::abs(*value) <= bound)) return not_finite(context.name, line_text(tokens));
    values[k] = *value;
  }
  return values.size();
}

/// The colour of a vertex: three numbers behind its coordinates, or behind those and a weight.
void read_vertex_color(Tokens& tokens, ObjData& data) {
  std::vector<float> numbers;
  for (auto word = next_word(tokens); !word.empty() && numbers.size() < 5; word = next_word(tokens)) {
    const auto value = to_number(word);
    if (!value || !(std::abs(*value) <= kMaxUv)) return;
    numbers.push_back(static_cast<float>(*value));
  }
  if (numbers.size() != 3 && numbers.size() != 4) return;
  const std::size_t first = numbers.size() - 3;
  data.soup.vertex_color.resize(data.soup.positions.size() - 1, kNoColor);
  data.soup.vertex_color.push_back({numbers[first], numbers[first + 1], numbers[first + 2]});
}

/// ZBrush's colours of vertices, eight hexadecimal digits each (mask, red, green, blue), in comments "#MRGB".
void read_zbrush_colors(std::string_view digits, ObjData& data) {
  for (; digits.size() >= 8; digits.remove_prefix(8)) {
    unsigned value = 0;
    const auto end = digits.data() + 8;
    if (std::from_chars(digits.data(), end, value, 16).ptr != end) return;
    data.zbrush_colors.push_back(
        {static_cast<float>(value >> 16 & 255), static_cast<float>(value >> 8 & 255), static_cast<float>(value & 255)});
  }
}

Diagnostics read_vertex(Tokens& tokens, ObjData& data, const ReadContext& context) {
  std::array<double, 3> p{};
  if (auto count = read_numbers(tokens, 3, kMaxCoordinate, p, context); !count) return std::move(count).error();
  data.soup.positions.push_back({p[0], p[1], p[2]});
  read_vertex_color(tokens, data);
  if (data.soup.positions.size() > 3 * context.options.max_triangles)
    return {too_many(context.name, "vertices or more", data.soup.positions.size(), 3 * context.options.max_triangles)};
  return {};
}

Diagnostics read_uv(Tokens& tokens, ObjData& data, const ReadContext& context) {
  std::array<double, 3> t{};
  if (auto count = read_numbers(tokens, 1, kMaxUv, t, context); !count) return std::move(count).error();
  data.uv.push_back({static_cast<float>(t[0]), static_cast<float>(1 - t[1])});
  return {};
}

Diagnostic bad_index(const ReadContext& context, const ForwardReference& at, const std::string& what, std::size_t count) {
  return make_error("mesh.bad-index",
                    fmt::format("{}: line {}: \"{}\" names no {} (there are {})", context.name, at.line, quotable(at.word), what, count));
}

/// From the 1-based or negative index of a corner to a 0-based one. Takes down indices that point ahead.
Result<std::uint32_t> resolve(std::string_view text, std::size_t count, std::vector<ForwardReference>& forward, const ForwardReference& at,
                              const std::string& what, const ReadContext& context) {
  const auto value = to_integer(text);
  const auto signed_count = static_cast<std::int64_t>(count);
  const auto index = !value ? -1 : *value > 0 ? *value - 1 : *value < 0 ? signed_count + *value : -1;
  if (index < 0 || index >= static_cast<std::int64_t>(3 * context.options.max_triangles)) return bad_index(context, at, what, count);
  if (index >= signed_count) forward.push_back({index, at.line, at.word});
  return static_cast<std::uint32_t>(index);
}

/// Leaves out corners that repeat the one before; a face with fewer than three vertices is taken back.
void tidy_face(ObjData& data, std::size_t first) {
  auto& corners = data.soup.corners;
  auto end = first;
  for (auto c = first; c < corners.size(); ++c) {
    if (end > first && corners[c] == corners[end - 1]) continue;
    corners[end] = corners[c];
    data.corner_uv[end] = data.corner_uv[c];
    ++end;
  }
  if (end > first + 1 && corners[end - 1] == corners[first]) --end;
  std::vector<std::uint32_t> different(corners.begin() + static_cast<std::ptrdiff_t>(first),
                                       corners.begin() + static_cast<std::ptrdiff_t>(end));
  std::sort(different.begin(), different.end());
  if (std::unique(different.begin(), different.end()) - different.begin() < 3) {
    end = first;
    ++data.skipped;
  }
  corners.resize(end);
  data.corner_uv.resize(end);
  if (end == first) return;
  data.soup.end_face();
  data.face_name.push_back(data.current_name);
}

Diagnostics read_face(Tokens& tokens, ObjData& data, const ReadContext& context) {
  const auto first = data.soup.corners.size();
  while (true) {
    const auto text = next_word(tokens);
    if (text.empty()) break;
    const ForwardReference at{0, tokens.line(), text};
    const auto slash = text.find('/');
    auto vertex = resolve(text.substr(0, slash), data.soup.positions.size(), data.forward_vertices, at, "vertex", context);
    if (!vertex) return std::move(vertex).error();
    data.soup.corners.push_back(*vertex);
    data.corner_uv.push_back(kNoUv);
    if (slash == text.npos || slash + 1 == text.size() || text[slash + 1] == '/') continue;
    const auto rest = text.substr(slash + 1);
    auto uv = resolve(rest.substr(0, rest.find('/')), data.uv.size(), data.forward_uv, at, "texture vertex", context);
    if (!uv) return std::move(uv).error();
    data.corner_uv.back() = *uv;
  }
  tidy_face(data, first);
  if (data.soup.corners.size() > 6 * context.options.max_triangles)
    return {too_many(context.name, "corners", data.soup.corners.size(), 6 * context.options.max_triangles)};
  return {};
}

void use_material(ObjData& data, const std::string& name) {
  const auto [known, is_new] = data.index_of_name.insert({name, static_cast<std::uint32_t>(data.material_names.size())});
  if (is_new) data.material_names.push_back(name);
  data.current_name = known->second;
}

Result<ObjData> read_statements(std::string_view text, const ReadContext& context) {
  ObjData data;
  Tokens tokens(text);
  while (!tokens.at_end()) {
    const auto key = tokens.next_in_line();
    if (key == "usemtl" || key == "mtllib") {
      const std::string rest(tokens.rest_of_line());
      if (key == "usemtl") use_material(data, rest);
      else data.libraries.push_back(rest);
      continue;
    }
    if (key == "#MRGB") read_zbrush_colors(tokens.next_in_line(), data);
    Diagnostics wrong;
    if (key == "v") wrong = read_vertex(tokens, data, context);
    else if (key == "vt") wrong = read_uv(tokens, data, context);
    else if (key == "f" || key == "fo") wrong = read_face(tokens, data, context);
    if (!wrong.empty()) return wrong;
    skip_statement(tokens);
  }
  for (const auto& forward : data.forward_vertices) {
    if (forward.index >= static_cast<std::int64_t>(data.soup.positions.size()))
      return bad_index(context, forward, "vertex", data.soup.positions.size());
  }
  for (const auto& forward : data.forward_uv) {
    if (forward.index >= static_cast<std::int64_t>(data.uv.size())) return bad_index(context, forward, "texture vertex", data.uv.size());
  }
  return data;
}

Result<std::string> read_library(const std::string& reference, const ReadContext& context) {
  auto path = find_referred_file(reference, context);
  if (!path) return path.error();
  report_read(context.options, *path);
  return files::read_file(*path, kMaxMtlBytes);
}

/// Reads the libraries that the file names. A statement is one name with blanks, or else several names.
MtlLibrary read_libraries(ObjData& data, const ReadContext& context) {
  MtlLibrary library;
  for (const auto& statement : data.libraries) {
    const auto whole = read_library(statement, context);
    if (whole) read_mtl(*whole, library);
    bool found = whole.has_value();
    Tokens names(statement);
    for (auto name = names.next_in_line(); !whole && !name.empty(); name = names.next_in_line()) {
      const auto bytes = read_library(std::string(name), context);
      if (bytes) read_mtl(*bytes, library);
      found = found || bytes.has_value();
    }
    if (found) continue;
    const auto& reason = whole.error().front();
    data.soup.warnings.push_back(
        make_warning("mesh.bad-reference", fmt::format("{}: materials are left out: {}", context.name, reason.message), reason.hint));
  }
  return library;
}

/// Changes the uv of a face as the options of its picture say; OBJ counts v from the bottom.
void transform_uv(PolygonSoup& soup, std::size_t face, const MtlMap& map) {
  const bool is_identity = map.scale == std::array<double, 2>{1, 1} && map.offset == std::array<double, 2>{0, 0};
  if (soup.corner_uv.empty() || is_identity) return;
  for (auto c = soup.face_begin[face]; c < soup.face_begin[face + 1]; ++c) {
    auto& uv = soup.corner_uv[c];
    const double u = map.scale[0] * static_cast<double>(uv[0]) + map.offset[0];
    const double v = map.scale[1] * (1 - static_cast<double>(uv[1])) + map.offset[1];
    uv = {static_cast<float>(std::clamp(u, -kMaxUv, kMaxUv)), static_cast<float>(1 - std::clamp(v, -kMaxUv, kMaxUv))};
  }
}

void warn_of_ignored(const MtlLibrary& library, PolygonSoup& soup, const ReadContext& context) {
  if (library.ignored.empty()) return;
  std::string keys;
  for (const auto& key : library.ignored) keys += (keys.empty() ? "" : ", ") + key;
  soup.warnings.push_back(make_warning("mesh.ignored", fmt::format("{}: its materials have {}, which is left out", context.name, keys)));
}

/// The materials of the faces, in the order of their first use. Faces without a known one share a plain material.
void add_materials(ObjData& data, const ReadContext& context) {
  const MtlLibrary library = read_libraries(data, context);
  constexpr std::uint32_t kUnused = 0xffffffff;
  std::vector<std::uint32_t> index_of_name(data.material_names.size(), kUnused);
  std::uint32_t plain = kUnused;
  bool any = false, is_exact = true;
  TextureLoader textures(context);
  PolygonSoup& soup = data.soup;
  for (std::size_t f = 0; f < soup.faces(); ++f) {
    const auto found = data.face_name[f] == 0 ? library.materials.end() : library.materials.find(data.material_names[data.face_name[f]]);
    const bool known = found != library.materials.end();
    auto& index = known ? index_of_name[data.face_name[f]] : plain;
    if (index == kUnused) {
      index = static_cast<std::uint32_t>(soup.materials.size());
      const ConvertedMaterial made = known ? convert(found->second, textures) : ConvertedMaterial{};
      soup.materials.push_back(made.material);
      soup.wrap_modes.push_back(made.wrap);
      is_exact = is_exact && made.is_exact;
    }
    if (known) transform_uv(soup, f, found->second.texture);
    any = any || known;
    soup.face_material.push_back(index);
  }
  if (!any) {
    soup.materials.clear();
    soup.face_material.clear();
  }
  soup.textures = std::move(textures.textures);
  soup.warnings.insert(soup.warnings.end(), textures.warnings.begin(), textures.warnings.end());
  if (!is_exact) soup.warnings.push_back(blending_warning(context.name));
  if (any) warn_of_ignored(library, soup, context);
}

void settle_colors(ObjData& data) {
  auto& colors = data.soup.vertex_color;
  if (!colors.empty()) {
    const float white = white_of(colors);
    for (auto& color : colors) {
      if (color == kNoColor) color = {kNoColor[0] * white, kNoColor[1] * white, kNoColor[2] * white};
    }
    colors.resize(data.soup.positions.size(), {kNoColor[0] * white, kNoColor[1] * white, kNoColor[2] * white});
    colors = decode_colors(std::move(colors), white);
  } else if (!data.zbrush_colors.empty() && data.zbrush_colors.size() == data.soup.positions.size()) {
    colors = decode_colors(std::move(data.zbrush_colors), 255);
  }
}

/// A mesh has uv everywhere or nowhere: corners without get those of `vt 0 0`.
void add_uv(ObjData& data) {
  if (std::all_of(data.corner_uv.begin(), data.corner_uv.end(), [](std::uint32_t uv) { return uv == kNoUv; })) return;
  data.soup.corner_uv.reserve(data.corner_uv.size());
  for (const auto uv : data.corner_uv) data.soup.corner_uv.push_back(uv == kNoUv ? std::array<float, 2>{0, 1} : data.uv[uv]);
}

/// The program that wrote the file, by the comments at its beginning, if it is one that turns y up; else "".
std::string y_up_exporter(std::string_view text) {
  constexpr std::size_t kMaxHeadBytes = 2000;
  Tokens head(text.substr(0, kMaxHeadBytes));
  while (!head.at_end()) {
    const auto line = head.rest_of_line();
    if (!line.empty() && line.front() != '#') break;
    for (const char* program : {"Blender", "ZBrush", "CINEMA 4D", "Maya", "Wings3D"})
      if (line.find(program) != line.npos) return program;
  }
  return "";
}

}  // namespace

Result<PolygonSoup> read_obj(std::string_view bytes, const ReadContext& context) {
  const DecodedText decoded = decode_text(bytes);
  auto data = read_statements(decoded.text(), context);
  if (!data) return std::move(data).error();
  settle_colors(*data);
  add_uv(*data);
  add_materials(*data, context);
  if (const auto program = y_up_exporter(decoded.text()); !program.empty()) {
    data->soup.warnings.push_back(
        make_note("mesh.y-up", fmt::format("{}: {} writes OBJ files with y up unless it is told otherwise", context.name, program),
                  "if it lies on its back, say `up: y`"));
  }
  if (data->skipped > 0) {
    data->soup.warnings.push_back(
        make_note("mesh.skipped-faces",
                  fmt::format("{}: {} faces with fewer than three different vertices are left out", context.name, data->skipped)));
  }
  return std::move(data->soup);
}

}  // namespace orbc::mesh_io
