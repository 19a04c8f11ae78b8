// The only place where OpenMesh reads a file. Its readers trust what they read (a PLY header without its end never ends, OBJ and PLY
// indices are passed on unchecked, ascii lists it does not know shift all that follows), so they get sieved text only, and an importer
// that takes down polygons without building a half-edge structure: non-manifold meshes lose no face.
// OpenMesh's readers are global objects with state; a mutex keeps them to one file at a time.
#include <fmt/core.h>

#include <mutex>
#include <sstream>

#include "compiler/mesh/sieve.h"

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-parameter"
#include <OpenMesh/Core/IO/IOManager.hh>
#include <OpenMesh/Core/IO/importer/BaseImporter.hh>
#include <OpenMesh/Core/IO/reader/BaseReader.hh>
#include <OpenMesh/Core/IO/reader/OBJReader.hh>
#include <OpenMesh/Core/IO/reader/OFFReader.hh>
#include <OpenMesh/Core/IO/reader/PLYReader.hh>
#include <OpenMesh/Core/IO/reader/STLReader.hh>
#include <OpenMesh/Core/System/omstream.hh>
#pragma GCC diagnostic pop

namespace orbc::mesh {
namespace {

using namespace OpenMesh;

/// Takes down vertices, polygons and their uv; everything else the readers offer is dropped.
class SoupImporter final : public IO::BaseImporter {
 public:
  explicit SoupImporter(Soup& soup) : soup_(soup) { soup_.face_begin.assign(1, 0); }
  using IO::BaseImporter::add_vertex;

  VertexHandle add_vertex(const Vec3f& p) override {
    soup_.positions.push_back({p[0], p[1], p[2]});
    return VertexHandle(static_cast<int>(soup_.positions.size()) - 1);
  }
  VertexHandle add_vertex() override { return add_vertex(Vec3f(0, 0, 0)); }
  void set_point(VertexHandle v, const Vec3f& p) override { soup_.positions.at(static_cast<std::size_t>(v.idx())) = {p[0], p[1], p[2]}; }
  FaceHandle add_face(const VHandles& corners) override {
    for (const auto corner : corners) {
      if (corner.idx() < 0 || static_cast<std::size_t>(corner.idx()) >= soup_.positions.size()) throw std::out_of_range("vertex index");
      soup_.corners.push_back(static_cast<std::uint32_t>(corner.idx()));
    }
    soup_.face_begin.push_back(static_cast<std::uint32_t>(soup_.corners.size()));
    return FaceHandle(static_cast<int>(soup_.face_begin.size()) - 2);
  }
  void add_face_texcoords(FaceHandle, VertexHandle, const std::vector<Vec2f>& uv) override {
    for (const auto& t : uv) soup_.uv.push_back({t[0], 1 - t[1]});
  }
  void set_texcoord(VertexHandle v, const Vec2f& t) override {
    vertex_uv.resize(soup_.positions.size());
    vertex_uv.at(static_cast<std::size_t>(v.idx())) = {t[0], 1 - t[1]};
  }
  std::size_t n_vertices() const override { return soup_.positions.size(); }
  std::size_t n_faces() const override { return soup_.face_begin.size() - 1; }
  std::size_t n_edges() const override { return 0; }

  HalfedgeHandle add_edge(VertexHandle, VertexHandle) override { return HalfedgeHandle(); }
  FaceHandle add_face(HalfedgeHandle) override { return FaceHandle(); }
  void add_face_texcoords(FaceHandle, VertexHandle, const std::vector<Vec3f>&) override {}
  void set_face_texindex(FaceHandle, int) override {}
  void set_halfedge(VertexHandle, HalfedgeHandle) override {}
  void set_normal(VertexHandle, const Vec3f&) override {}
  void set_normal(VertexHandle, const Vec3d&) override {}
  void set_color(VertexHandle, const Vec3uc&) override {}
  void set_color(VertexHandle, const Vec4uc&) override {}
  void set_color(VertexHandle, const Vec3f&) override {}
  void set_color(VertexHandle, const Vec4f&) override {}
  void set_status(VertexHandle, const Attributes::StatusInfo&) override {}
  void set_next(HalfedgeHandle, HalfedgeHandle) override {}
  void set_face(HalfedgeHandle, FaceHandle) override {}
  void request_face_texcoords2D() override {}
  void set_texcoord(HalfedgeHandle, const Vec2f&) override {}
  void set_texcoord(VertexHandle, const Vec3f&) override {}
  void set_texcoord(HalfedgeHandle, const Vec3f&) override {}
  void set_status(HalfedgeHandle, const Attributes::StatusInfo&) override {}
  void set_color(EdgeHandle, const Vec3uc&) override {}
  void set_color(EdgeHandle, const Vec4uc&) override {}
  void set_color(EdgeHandle, const Vec3f&) override {}
  void set_color(EdgeHandle, const Vec4f&) override {}
  void set_status(EdgeHandle, const Attributes::StatusInfo&) override {}
  void set_normal(FaceHandle, const Vec3f&) override {}
  void set_normal(FaceHandle, const Vec3d&) override {}
  void set_color(FaceHandle, const Vec3uc&) override {}
  void set_color(FaceHandle, const Vec4uc&) override {}
  void set_color(FaceHandle, const Vec3f&) override {}
  void set_color(FaceHandle, const Vec4f&) override {}
  void set_status(FaceHandle, const Attributes::StatusInfo&) override {}
  void add_texture_information(int, std::string) override {}

  std::vector<std::array<float, 2>> vertex_uv;

 private:
  Soup& soup_;
};

std::mutex readers_mutex;

}  // namespace

Result<Soup> read_by_openmesh(const Sieved& sieved, const std::string& format, const std::string& name) {
  Soup soup;
  SoupImporter importer(soup);
  bool done = false;
  std::string why = "its reader refused it";
  try {
    const std::lock_guard lock(readers_mutex);
    omlog().disable(), omout().disable(), omerr().disable();
    IO::Options options;
    if (sieved.binary) options += IO::Options::Binary;
    if (sieved.has_uv) options += format == "obj" ? IO::Options::FaceTexCoord : IO::Options::VertexTexCoord;
    std::istringstream in(sieved.text, std::ios::binary);
    IO::BaseReader* reader = nullptr;
    if (format == "obj") reader = &IO::OBJReader();
    if (format == "off") reader = &IO::OFFReader();
    if (format == "ply") reader = &IO::PLYReader();
    if (format == "stl") reader = &IO::STLReader();
    ORBC_CHECK(reader != nullptr, ==, true);
    done = reader->read(in, importer, options);
  } catch (const std::exception& thrown) {
    why = thrown.what();
  }
  if (!done) return make_error("mesh.bad-header", fmt::format("{}: OpenMesh cannot read it: {}", name, why));
  if (format == "ply" && sieved.has_uv && importer.vertex_uv.size() == soup.positions.size()) {
    for (const auto corner : soup.corners) soup.uv.push_back(importer.vertex_uv[corner]);
  }
  if (sieved.corner_uv.size() == soup.corners.size()) soup.uv = sieved.corner_uv;
  if (soup.uv.size() != soup.corners.size()) soup.uv.clear();
  if (sieved.look.size() == soup.face_begin.size() - 1) soup.look = sieved.look;
  return soup;
}

}  // namespace orbc::mesh
