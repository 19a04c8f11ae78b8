#include "exporters/html/core/page_assets.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <optional>
#include <string_view>

#include "compiler/image_io/decode.h"
#include "compiler/mesh_io/load.h"

namespace orbc::html {
namespace {

using Bytes = std::vector<std::uint8_t>;

template <class T>
void put(Bytes& out, const T& value) {
  const std::size_t at = out.size();
  out.resize(at + sizeof(T));
  std::memcpy(out.data() + at, &value, sizeof(T));
}

template <class T>
void put_list(Bytes& out, const std::vector<T>& list) {
  const std::size_t at = out.size();
  out.resize(at + list.size() * sizeof(T));
  if (!list.empty()) std::memcpy(out.data() + at, list.data(), list.size() * sizeof(T));
}

void put_mark(Bytes& out, std::string_view mark) {
  for (const char letter : mark) out.push_back(static_cast<std::uint8_t>(letter));
}

void put_picture(Bytes& out, const image::Image& picture) {
  put_mark(out, "OIMG");
  for (const int number : {picture.width, picture.height}) put(out, static_cast<std::uint32_t>(number));
  put_list(out, picture.rgba);
}

/// Reads a file from its beginning; what it gives after the end is zero, and `fine` is false then.
struct Reader {
  const Bytes& bytes;
  std::size_t at = 0;
  bool fine = true;

  template <class T>
  T get() {
    T value{};
    if (bytes.size() - at < sizeof(T)) return fine = false, value;
    std::memcpy(&value, bytes.data() + at, sizeof(T));
    at += sizeof(T);
    return value;
  }
  template <class T>
  std::vector<T> list(std::size_t count) {
    std::vector<T> values;
    if (!fine || (bytes.size() - at) / sizeof(T) < count) return fine = false, values;
    values.resize(count);
    if (count > 0) std::memcpy(values.data(), bytes.data() + at, count * sizeof(T));
    at += count * sizeof(T);
    return values;
  }
  bool mark(std::string_view name) {
    const auto found = list<char>(name.size());
    return fine = fine && std::string_view(found.data(), found.size()) == name;
  }
};

image::Image read_picture(Reader& reader) {
  image::Image picture;
  if (!reader.mark("OIMG")) return picture;
  const auto width = reader.get<std::uint32_t>(), height = reader.get<std::uint32_t>();
  if (width == 0 || height == 0 || width > 65536 || height > 65536) return reader.fine = false, picture;
  picture.width = static_cast<int>(width);
  picture.height = static_cast<int>(height);
  picture.rgba = reader.list<std::uint8_t>(std::size_t{width} * height * 4);
  return picture;
}

mesh::Material read_material(Reader& reader) {
  mesh::Material m;
  const auto number = [&] { return reader.get<double>(); };
  const double kind = number();
  if (!(kind >= 0 && kind <= 4)) reader.fine = false;
  else m.kind = static_cast<mesh::MaterialKind>(static_cast<int>(kind));
  for (double& c : m.color) c = number();
  m.texture = static_cast<int>(number());
  m.alpha_cutoff = number();
  m.roughness = number();
  m.index = number();
  m.emission = number();
  return m;
}

bool is_sound(const mesh::Mesh& mesh) {
  for (const mesh::Triangle& t : mesh.triangles)
    for (const std::uint32_t v : t)
      if (v >= mesh.positions.size()) return false;
  for (const std::uint16_t m : mesh.triangle_material)
    if (m >= mesh.materials.size()) return false;
  for (const mesh::Material& m : mesh.materials)
    if (m.texture < -1 || m.texture >= static_cast<int>(mesh.textures.size())) return false;
  return (mesh.uv.empty() || mesh.uv.size() == mesh.positions.size()) &&
         (mesh.colors.empty() || mesh.colors.size() == mesh.positions.size()) &&
         (mesh.triangle_material.empty() || mesh.triangle_material.size() == mesh.triangles.size());
}

std::optional<mesh::Mesh> read_mesh(const Bytes& bytes) {
  Reader reader{bytes};
  if (!reader.mark("OMSH")) return std::nullopt;
  const auto counts = reader.list<std::uint32_t>(8);
  if (!reader.fine) return std::nullopt;
  mesh::Mesh mesh;
  mesh.positions = reader.list<geometry::Vector3>(counts[0]);
  mesh.uv = reader.list<std::array<float, 2>>(counts[1]);
  mesh.colors = reader.list<mesh::LinearColor>(counts[2]);
  mesh.triangles = reader.list<mesh::Triangle>(counts[3]);
  for (const std::uint32_t material : reader.list<std::uint32_t>(counts[4]))
    mesh.triangle_material.push_back(static_cast<std::uint16_t>(material));
  for (std::uint32_t i = 0; i < counts[5] && reader.fine; ++i) mesh.materials.push_back(read_material(reader));
  for (std::uint32_t i = 0; i < counts[6] && reader.fine; ++i) mesh.textures.push_back(read_picture(reader));
  if (!reader.fine || !is_sound(mesh)) return std::nullopt;
  return mesh;
}

Diagnostic missing(const std::string& path) {
  return make_error("mesh.missing-file", fmt::format("the page does not hold the file \"{}\"", path), "drop the file on the page");
}
#ifdef __EMSCRIPTEN__
const char* const kFolder = ".";  // of the page's own files in memory, where the core has put them
#else
const char* const kFolder = "";  // nothing of the disk
#endif
const mesh_io::LoadOptions kBounds = mesh_io::bounds_within(std::uint64_t{1} << 30);

std::string_view text_of(const Bytes& bytes) { return {reinterpret_cast<const char*>(bytes.data()), bytes.size()}; }

const Bytes* find(const PageFiles& files, const std::string& path) {
  auto file = files.find(path);
  if (file == files.end()) file = files.find(path.substr(path.find_last_of('/') + 1));
  return file == files.end() ? nullptr : &file->second;
}

Result<mesh::LoadedMesh> load_raw_mesh(const std::string& path, const Bytes& bytes) {
  const auto format = mesh_io::format_of(path);
  if (!format) return mesh_io::load_mesh(path);  // it says what is known
  return mesh_io::load_mesh_bytes(text_of(bytes), *format, path, kFolder, kBounds);
}

Diagnostic broken(const std::string& path) {
  return make_error("page.bad-asset", fmt::format("the page's copy of \"{}\" is damaged", path),
                    "write the page again, or drop the file on it");
}

}  // namespace

Bytes page_file(const mesh::Mesh& mesh) {
  Bytes out;
  put_mark(out, "OMSH");
  for (const std::size_t count : {mesh.positions.size(), mesh.uv.size(), mesh.colors.size(), mesh.triangles.size(),
                                  mesh.triangle_material.size(), mesh.materials.size(), mesh.textures.size(), std::size_t{0}})
    put(out, static_cast<std::uint32_t>(count));
  put_list(out, mesh.positions);
  put_list(out, mesh.uv);
  put_list(out, mesh.colors);
  put_list(out, mesh.triangles);
  for (const std::uint16_t material : mesh.triangle_material) put(out, static_cast<std::uint32_t>(material));
  for (const mesh::Material& m : mesh.materials)
    for (const double number : {static_cast<double>(static_cast<int>(m.kind)), m.color[0], m.color[1], m.color[2],
                                static_cast<double>(m.texture), m.alpha_cutoff, m.roughness, m.index, m.emission})
      put(out, number);
  for (const image::Image& picture : mesh.textures) put_picture(out, picture);
  return out;
}

Bytes page_file(const image::Image& picture) {
  Bytes out;
  put_picture(out, picture);
  return out;
}

bool is_page_file(const Bytes& bytes) {
  const std::string_view mark(reinterpret_cast<const char*>(bytes.data()), std::min<std::size_t>(4, bytes.size()));
  return mark == "OMSH" || mark == "OIMG";
}

mesh::AssetSource assets_of_page(const PageFiles& files) {
  mesh::AssetSource source;
  source.load_mesh = [&files](const std::string& path) -> Result<mesh::LoadedMesh> {
    const Bytes* bytes = find(files, path);
    if (!bytes) return missing(path);
    if (!is_page_file(*bytes)) return load_raw_mesh(path, *bytes);
    std::optional<mesh::Mesh> mesh = read_mesh(*bytes);
    if (!mesh) return broken(path);
    return mesh::LoadedMesh{std::move(*mesh), {}};
  };
  source.load_image = [&files](const std::string& path) -> Result<image::Image> {
    const Bytes* bytes = find(files, path);
    if (!bytes) return missing(path);
    if (!is_page_file(*bytes)) return image_io::decode_image(text_of(*bytes), path, kBounds.images);
    Reader reader{*bytes};
    image::Image picture = read_picture(reader);
    if (!reader.fine) return broken(path);
    return picture;
  };
  return source;
}

}  // namespace orbc::html
