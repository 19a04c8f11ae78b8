#include "exporters/html/write_html.h"

#include <zlib.h>

#include <algorithm>

#include "compiler/base/check.h"
#include "compiler/place/furnish.h"
#include "exporters/html/core/page_assets.h"
#include "exporters/html/core/reply.h"

namespace orbc::html {
namespace {

constexpr std::string_view kScenePlace = "\"ORBC-SCENE\"", kFilesPlace = "[\"ORBC-ASSETS\"]";

/// The bytes as a raw deflate stream (RFC 1951).
std::vector<std::uint8_t> deflated(const std::vector<std::uint8_t>& bytes) {
  z_stream stream{};
  ORBC_CHECK(deflateInit2(&stream, 9, Z_DEFLATED, -15, 9, Z_DEFAULT_STRATEGY), ==, Z_OK);
  std::vector<std::uint8_t> out(deflateBound(&stream, static_cast<uLong>(bytes.size())));
  stream.next_in = const_cast<Bytef*>(bytes.data());
  stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = out.data();
  stream.avail_out = static_cast<uInt>(out.size());
  ORBC_CHECK(deflate(&stream, Z_FINISH), ==, Z_STREAM_END);
  out.resize(stream.total_out);
  deflateEnd(&stream);
  return out;
}

std::string base64(const std::vector<std::uint8_t>& bytes) {
  static constexpr char kLetters[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  out.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t left = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t word = 0;
    for (std::size_t k = 0; k < 3; ++k) word = word << 8 | (k < left ? bytes[i + k] : 0u);
    for (std::size_t k = 0; k < 4; ++k) out += k <= left ? kLetters[word >> (18 - 6 * k) & 63] : '=';
  }
  return out;
}

/// The name of a file as the scene has it: without the folder that place::furnish puts before it.
std::string name_in_scene(const std::string& path, const std::string& folder) {
  return !folder.empty() && path.rfind(folder + "/", 0) == 0 ? path.substr(folder.size() + 1) : path;
}

}  // namespace

Result<PageScene> page_scene(std::string text, const scene::Scene& scene, const room::Room& room, const mesh::AssetSource& assets) {
  PageScene page{std::move(text), {}};
  const auto keep = [&](const std::string& path, std::vector<std::uint8_t> bytes) {
    const std::string name = name_in_scene(path, scene.folder);
    for (const auto& file : page.files)
      if (file.first == name) return;
    page.files.emplace_back(name, std::move(bytes));
  };
  mesh::AssetSource recording;
  recording.load_mesh = [&](const std::string& path) {
    auto loaded = assets.load_mesh(path);
    if (loaded) keep(path, page_file(loaded->mesh));
    return loaded;
  };
  recording.load_image = [&](const std::string& path) {
    auto loaded = assets.load_image(path);
    if (loaded) keep(path, page_file(*loaded));
    return loaded;
  };
  const auto furnished = place::furnish(scene, room, recording);
  if (!furnished) return furnished.error();
  return page;
}

std::optional<driver::File> write_html(std::string_view page, const PageScene& scene) {
  const std::size_t at_scene = page.find(kScenePlace), at_files = page.find(kFilesPlace);
  if (at_scene == std::string_view::npos || at_files == std::string_view::npos || at_files < at_scene) return std::nullopt;
  std::string files = "[";
  for (const auto& [name, bytes] : scene.files) {
    if (files.size() > 1) files += ',';
    files += '[' + quoted(name) + ",\"" + base64(deflated(bytes)) + "\"]";
  }
  files += ']';
  std::string bytes(page.substr(0, at_scene));
  bytes += quoted(scene.text);
  bytes += page.substr(at_scene + kScenePlace.size(), at_files - at_scene - kScenePlace.size());
  bytes += files;
  bytes += page.substr(at_files + kFilesPlace.size());
  return driver::File{"", std::move(bytes)};
}

}  // namespace orbc::html
