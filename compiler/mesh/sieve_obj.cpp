// A sieve for Wavefront OBJ and its MTL (Wavefront "Advanced Visualizer" manual, appendix B): v, vt, f, usemtl, mtllib with Kd and map_Kd.
// Negative indices count back from the last vertex read so far; lines that end in '\' go on in the next.
#include <fmt/core.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "compiler/files/files.h"
#include "compiler/mesh/sieve.h"
#include "compiler/mesh/tokens.h"

namespace orbc::mesh {
namespace {

struct MtlEntry {
  std::array<double, 3> color{0.8, 0.8, 0.8};
  std::string texture;
  int look = -1;  // index into Sieved::looks once it is used
};

class ObjSieve {
 public:
  ObjSieve(std::string_view bytes, const std::string& name, const std::string& folder, const LoadOptions& options)
      : tokens_(bytes), name_(name), folder_(folder), options_(options) {}

  Result<Sieved> run() {
    while (!tokens_.at_end()) {
      const auto key = tokens_.next_in_line();
      Diagnostics wrong;
      if (key == "v") wrong = vertex();
      else if (key == "vt") wrong = texcoord();
      else if (key == "f" || key == "fo") wrong = face();
      else if (key == "usemtl") current_ = std::string(tokens_.rest_of_line()), line_done_ = true;
      else if (key == "mtllib") library(std::string(tokens_.rest_of_line())), line_done_ = true;
      if (!wrong.empty()) return wrong;
      if (!line_done_) skip_line();
      line_done_ = false;
    }
    // A mesh has uv everywhere or nowhere: corners without get (0, 1), which is vt 1 of the clean file.
    sieved_.has_uv = with_uv_;
    sieved_.text = std::move(vertices_);
    if (with_uv_) sieved_.text += "vt 0 0\n" + texcoords_;
    for (std::size_t f = 0; f + 1 < begin_.size(); ++f) {
      sieved_.text += 'f';
      for (auto c = begin_[f]; c < begin_[f + 1]; ++c) {
        if (with_uv_) {
          fmt::format_to(std::back_inserter(sieved_.text), " {}/{}", corners_[c] + 1, uv_[c] + 2);
        } else {
          fmt::format_to(std::back_inserter(sieved_.text), " {}", corners_[c] + 1);
        }
      }
      sieved_.text += '\n';
    }
    if (!materials_used_) sieved_.look.clear(), sieved_.looks.clear();
    if (skipped_ > 0) {
      sieved_.warnings.push_back(make_note(
          "mesh.skipped-faces", fmt::format("{}: {} faces with fewer than three different vertices are left out", name_, skipped_)));
    }
    return std::move(sieved_);
  }

 private:
  std::string where() const { return fmt::format("line {}", tokens_.line()); }

  /// The next word of the statement: a lone '\' at the end of a line continues it.
  std::string_view word() {
    while (true) {
      const auto found = tokens_.next_in_line();
      if (found != "\\" || tokens_.at_end()) return found.empty() || found.front() == '#' ? std::string_view{} : found;
      tokens_.rest_of_line();
    }
  }
  void skip_line() {
    std::string_view rest;
    do rest = tokens_.rest_of_line();
    while (!rest.empty() && rest.back() == '\\' && rest.front() != '#' && !tokens_.at_end());
  }

  Diagnostics numbers(int count, int required, double bound, double (&values)[3]) {
    for (int k = 0; k < count; ++k) {
      const auto text = word();
      if (text.empty() && k >= required) break;
      if (text.empty()) return {truncated(name_, fmt::format("{}: {} numbers are too few", where(), k))};
      const auto value = to_number(text);
      if (!value) return {bad_number(name_, where(), text)};
      if (!(std::abs(*value) <= bound)) return {not_finite(name_, where())};
      values[k] = *value;
    }
    return {};
  }
  Diagnostics vertex() {
    double values[3] = {};
    if (auto wrong = numbers(3, 3, kLargestCoordinate, values); !wrong.empty()) return wrong;
    fmt::format_to(std::back_inserter(vertices_), "v {:.9g} {:.9g} {:.9g}\n", values[0], values[1], values[2]);
    if (++vertex_count_ > static_cast<std::int64_t>(3 * options_.max_triangles)) {
      return {too_many(name_, "vertices or more", static_cast<std::uint64_t>(vertex_count_), 3 * options_.max_triangles)};
    }
    return {};
  }
  Diagnostics texcoord() {
    double values[3] = {};
    if (auto wrong = numbers(2, 1, 1e6, values); !wrong.empty()) return wrong;
    fmt::format_to(std::back_inserter(texcoords_), "vt {:.9g} {:.9g}\n", values[0], values[1]);
    ++texcoord_count_;
    return {};
  }

  /// From a 1-based or negative index to a 0-based one; -1 when it is out of range or no number.
  static std::int64_t resolve(std::string_view text, std::int64_t count) {
    const auto value = to_integer(text);
    if (!value || *value == 0) return -1;
    const auto index = *value > 0 ? *value - 1 : count + *value;
    return index >= 0 && index < count ? index : -1;
  }
  Diagnostics face() {
    const auto first = corners_.size();
    std::vector<std::int64_t> seen;
    while (true) {
      const auto text = word();
      if (text.empty()) break;
      const auto slash = text.find('/');
      const auto index = resolve(text.substr(0, slash), vertex_count_);
      if (index < 0) return {bad_index(text, "vertex", vertex_count_)};
      std::int64_t uv = -1;
      if (slash != text.npos && slash + 1 < text.size() && text[slash + 1] != '/') {
        const auto rest = text.substr(slash + 1);
        uv = resolve(rest.substr(0, rest.find('/')), texcoord_count_);
        if (uv < 0) return {bad_index(text, "texture vertex", texcoord_count_)};
        with_uv_ = true;
      }
      corners_.push_back(static_cast<std::uint32_t>(index));
      uv_.push_back(uv);
    }
    // A corner that occurs twice in a row is written once; other repetitions make no polygon.
    auto end = first;
    for (auto c = first; c < corners_.size(); ++c) {
      if (end > first && corners_[c] == corners_[end - 1]) continue;
      corners_[end] = corners_[c], uv_[end] = uv_[c], ++end;
    }
    if (end > first + 1 && corners_[end - 1] == corners_[first]) --end;
    corners_.resize(end), uv_.resize(end);
    seen.assign(corners_.begin() + static_cast<std::ptrdiff_t>(first), corners_.end());
    std::sort(seen.begin(), seen.end());
    if (seen.size() < 3 || std::adjacent_find(seen.begin(), seen.end()) != seen.end()) {
      corners_.resize(first), uv_.resize(first);
      ++skipped_;
      return {};
    }
    begin_.push_back(corners_.size());
    if (corners_.size() > 6 * options_.max_triangles) return {too_many(name_, "corners", corners_.size(), 6 * options_.max_triangles)};
    sieved_.look.push_back(look());
    return {};
  }
  Diagnostic bad_index(std::string_view text, const std::string& what, std::int64_t count) {
    std::string shown;
    for (const char c : text.substr(0, 40)) shown += c >= 32 && c < 127 ? c : '?';
    return make_error("mesh.bad-index",
                      fmt::format("{}: {}: \"{}\" names no {} (there are {} so far)", name_, where(), shown, what, count));
  }

  void library(const std::string& reference) {
    auto path = files::referred_path(reference, name_, folder_);
    auto bytes = path ? files::read_file(*path, std::uint64_t{16} << 20) : Result<std::string>(path.error());
    if (!bytes) {
      const auto& reason = bytes.error().front();
      sieved_.warnings.push_back(
          make_warning("mesh.bad-reference", fmt::format("{}: materials are left out: {}", name_, reason.message), reason.hint));
      return;
    }
    Tokens tokens(*bytes);
    MtlEntry* entry = nullptr;
    while (!tokens.at_end()) {
      const auto key = tokens.next_in_line();
      if (key == "newmtl") {
        entry = &materials_[std::string(tokens.rest_of_line())];
        continue;
      }
      if (key == "Kd" && entry) {
        for (auto& channel : entry->color) {
          const auto value = to_number(tokens.next_in_line());
          if (value && *value >= 0 && *value <= 1) channel = *value;
        }
      } else if (key == "map_Kd" && entry) {
        // Options ("-s 1 1 1 name.png") come before the name; the name may have blanks only if there are none.
        const auto rest = tokens.rest_of_line();
        entry->texture = rest.empty() || rest.front() != '-' ? rest : rest.substr(rest.find_last_of(" \t") + 1);
        continue;
      }
      tokens.rest_of_line();
    }
  }
  std::uint8_t look() {
    if (current_.empty()) return plain_look();
    const auto found = materials_.find(current_);
    if (found == materials_.end()) return plain_look();
    auto& entry = found->second;
    materials_used_ = true;
    if (entry.look < 0) {
      if (sieved_.looks.size() >= 255) return warn_too_many();
      entry.look = static_cast<int>(sieved_.looks.size());
      if (entry.texture.empty()) sieved_.looks.push_back({entry.color, -1});
      else add_texture(entry.texture, name_, folder_, options_, entry.color, sieved_);
    }
    return static_cast<std::uint8_t>(entry.look);
  }
  std::uint8_t plain_look() {
    if (plain_ < 0) {
      if (sieved_.looks.size() >= 256) return warn_too_many();
      plain_ = static_cast<int>(sieved_.looks.size());
      sieved_.looks.push_back({});
    }
    return static_cast<std::uint8_t>(plain_);
  }
  std::uint8_t warn_too_many() {
    if (!warned_) {
      sieved_.warnings.push_back(
          make_warning("mesh.too-many-looks", fmt::format("{}: more than 255 materials; the others look like the last one", name_)));
    }
    warned_ = true;
    return 254;
  }

  Tokens tokens_;
  const std::string& name_;
  const std::string& folder_;
  const LoadOptions& options_;
  Sieved sieved_;
  std::string vertices_, texcoords_, current_;
  std::int64_t vertex_count_ = 0, texcoord_count_ = 0;
  std::vector<std::uint32_t> corners_;
  std::vector<std::int64_t> uv_;
  std::vector<std::size_t> begin_{0};
  std::map<std::string, MtlEntry> materials_;
  std::uint64_t skipped_ = 0;
  int plain_ = -1;
  bool with_uv_ = false, materials_used_ = false, warned_ = false, line_done_ = false;
};

}  // namespace

Result<Sieved> sieve_obj(std::string_view bytes, const std::string& name, const std::string& folder, const LoadOptions& options) {
  return ObjSieve(bytes, name, folder, options).run();
}

}  // namespace orbc::mesh
