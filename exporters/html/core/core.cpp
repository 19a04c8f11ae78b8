// The C interface. A core serves one page or worker, from one thread, so what is open is kept here and nowhere else.
#include "exporters/html/core/core.h"

#ifdef __EMSCRIPTEN__
#include <emscripten.h>
#endif

#include <exception>
#include <fstream>
#include <string>

#include "compiler/cover/automaton.h"
#include "compiler/cover/enumerate.h"
#include "compiler/notation/euler.h"
#include "compiler/notation/parse.h"
#include "compiler/scene/document.h"
#include "exporters/html/core/describe.h"
#include "exporters/html/core/export.h"
#include "exporters/html/core/session.h"

namespace orbc::html {
namespace {

struct Session {
  PageFiles files;
  std::unique_ptr<OpenScene> open;
  RefinedPicture picture;
  Reply reply;
  OrbcReply told{};
};

Session& session() {
  static Session only;
  return only;
}

// Nothing may leave an extern "C" function by an exception: JavaScript could not read it.
template <class Work>
const OrbcReply* answer(Work&& work) {
  Session& s = session();
  s.reply = {};
  try {
    work(s, s.reply);
  } catch (const std::exception& error) {
    s.reply = {};
    s.reply.object().key("failure").value(error.what()).end_object();
  }
  s.told = {s.reply.json.data(), s.reply.json.size(), s.reply.bytes.data(), s.reply.bytes.size()};
  return &s.told;
}

void add_grid(const char* name, const LightGrid& grid, Reply& reply) {
  reply.key(name).object().key("columns").value(grid.columns).key("rows").value(grid.rows).key("reach").value(grid.reach);
  reply.key("first").value(grid.first).end_object();
}

void describe_light(OpenScene& open, Reply& reply) {
  const bool lit = !open.scene.lamps.empty() || max_channel(open.scene.ambient) > 0 || open.scene.integrator == scene::Integrator::path;
  reply.key("light").object().key("lit").value(lit).key("exposure").value(open.scene.exposure);
  const scene::Color& ambient = open.scene.ambient;
  reply.key("ambient").numbers(std::array{ambient.r, ambient.g, ambient.b}).end_object();
}

void describe_cover(const scene::CoverSpec& cover, Reply& reply) {
  reply.key("cover").object().key("max_bounces").value(cover.max_bounces).key("min_weight").value(cover.min_weight);
  reply.key("background").numbers(std::array{cover.background.r, cover.background.g, cover.background.b});
  reply.key("expected").value(cover.background_expected).end_object();
}

void describe_scene(OpenScene& open, Reply& reply) {
  reply.key("orbifold");
  describe_orbifold(open.scene.orbifold, reply);
  reply.key("room");
  describe_room(open.interior, reply);
  reply.key("shell");
  describe_shell(open.scene, open.interior, reply);
  describe_styles(open.interior, reply);
  describe_meshes(open.interior, open.drawn, reply);
  describe_things(open.scene, open.interior, open.lamps->lamps, reply);
  describe_eye(open.eye, reply);
  describe_cover(open.scene.cover, reply);
  describe_light(open, reply);
}

#ifdef __EMSCRIPTEN__
EM_JS(void, tell_page, (const char* stage, double done, double total), {
  if (Module.told) Module.told(UTF8ToString(stage), done, total);
});
#else
void tell_page(const char*, double, double) {}
#endif

const Progress tell{[](std::string_view stage, std::uint64_t done, std::uint64_t total, std::string_view) {
                      tell_page(std::string(stage).c_str(), static_cast<double>(done), static_cast<double>(total));
                    },
                    nullptr};

}  // namespace
}  // namespace orbc::html

using namespace orbc;
using namespace orbc::html;

void orbc_asset(const char* name, size_t name_size, const uint8_t* bytes, size_t size) {
  const std::string own(name, name_size);
  std::vector<std::uint8_t>& file = session().files[own];
  file.assign(bytes, bytes + size);
#ifdef __EMSCRIPTEN__  // meshes find there what they refer to; the "disk" is memory of the page
  if (!is_page_file(file))
    std::ofstream(own.substr(own.find_last_of('/') + 1), std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes), static_cast<long>(size));
#endif
}

const OrbcReply* orbc_take_mesh(const char* name, size_t name_size, const uint8_t* bytes, size_t size) {
  return answer([&](Session& s, Reply& reply) {
    const std::string own(name, name_size);
    const PageFiles files{{own, {bytes, bytes + size}}};
    const auto loaded = assets_of_page(files).load_mesh(own);
    reply.object().key("diagnostics");
    describe_diagnostics(loaded ? loaded->warnings : loaded.error(), reply);
    if (loaded) {
      s.files[own] = page_file(loaded->mesh);  // so that it is not read anew with every change of the scene
      reply.key("triangles").value(loaded->mesh.triangles.size());
    }
    reply.end_object();
  });
}

const OrbcReply* orbc_open(const char* text, size_t size) {
  return answer([&](Session& s, Reply& reply) {
    auto source = std::make_shared<SourceText>();
    source->name = "scene.yaml";
    source->text.assign(text, size);
    const std::shared_ptr<const SourceText> shared = source;
    Opened opened = open_scene(shared, s.files);
    reply.object().key("ok").value(opened.scene != nullptr).key("diagnostics");
    describe_diagnostics(opened.diagnostics, reply);
    if (const auto document = scene::parse_document(shared)) {
      reply.key("nodes");
      describe_nodes(document->root, reply);
    }
    if (opened.scene) {
      s.open = std::move(opened.scene);
      describe_scene(*s.open, reply);
    }
    reply.end_object();
  });
}

const OrbcReply* orbc_notation(const char* text, size_t size, int real) {
  return answer([&](Session&, Reply& reply) {
    notation::ParseOptions options;
    options.allow_non_orbifold = real != 0;
    const auto parsed = notation::parse_with_notes(std::string_view(text, size), options);
    reply.object().key("diagnostics");
    describe_diagnostics(parsed ? parsed->notes : parsed.error(), reply);
    if (parsed) {
      reply.key("orbifold");
      describe_orbifold(parsed->orbifold, reply);
    }
    reply.end_object();
  });
}

const OrbcReply* orbc_copies(int bounces, int most) {
  return answer([&](Session& s, Reply& reply) {
    std::vector<double> matrices;
    std::vector<std::uint8_t> words, lengths;
    bool whole = true;
    if (s.open && notation::is_orbifold(s.open->scene.orbifold)) {
      const room::Room& room = s.open->interior.polygon;
      // Breadth first by lengths, so that the nearest copies are kept where there are too many.
      const cover::Automaton automaton(room.orbifold, std::max(1, bounces));
      std::vector<std::uint8_t> wall_of_letter;
      for (std::size_t i = 0; i < room.walls.size(); ++i)
        if (room.walls[i].reflects) wall_of_letter.push_back(static_cast<std::uint8_t>(i));
      for (int length = 0; length <= bounces && whole; ++length)
        cover::enumerate(automaton, room::generators(room), length, [&](const cover::Element& element, const geometry::Isometry& map) {
          if (static_cast<int>(element.word.size()) < length) return cover::Visit::descend;
          if (static_cast<int>(lengths.size()) >= most) return whole = false, cover::Visit::stop;
          for (const auto& row : geometry::matrix(map)) matrices.insert(matrices.end(), row.begin(), row.end());
          for (const std::uint8_t letter : element.word) words.push_back(wall_of_letter[letter]);
          lengths.push_back(static_cast<std::uint8_t>(element.word.size()));
          return cover::Visit::prune;
        });
    }
    reply.object().key("matrices").block(matrices).key("words").block(words).key("lengths").block(lengths);
    reply.key("whole").value(whole).end_object();
  });
}

const OrbcReply* orbc_light(int count) {
  return answer([&](Session& s, Reply& reply) {
    std::vector<float> irradiance;
    reply.object();
    if (s.open) {
      LightJob& job = light_job_of(*s.open);
      const std::size_t first = s.open->lit, end = std::min(job.points.size(), first + static_cast<std::size_t>(std::max(0, count)));
      for (std::size_t i = first; i < end; ++i) {
        const scene::Color light = light_at(job, i);
        for (const double c : {light.r, light.g, light.b}) irradiance.push_back(static_cast<float>(c));
      }
      s.open->lit = end;
      reply.key("done").value(end).key("all").value(job.points.size()).key("first").value(first);
      add_grid("floor", job.floor, reply);
      add_grid("ceiling", job.ceiling, reply);
      reply.key("walls").array();
      for (const LightGrid& grid : job.walls) reply.value(grid.first);
      reply.end_array();
    }
    reply.key("irradiance").block(irradiance).end_object();
  });
}

void orbc_trace_begin(const double* eye, double fov, int width, int height, const double* shift) {
  Session& s = session();
  if (!s.open) return;
  place::Camera& camera = s.picture.eye;
  camera = {};
  stand(camera, s.open->interior.polygon.space, eye);
  camera.fov.radians = fov;
  camera.width = width;
  camera.height = height;
  s.picture.shift_x = shift[0];
  s.picture.shift_y = shift[1];
  const auto pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  s.picture.sums.assign(pixels, {0, 0, 0});
  s.picture.counts.assign(pixels, 0);
}

const OrbcReply* orbc_trace_tile(const int* tile, int index, int samples) {
  return answer([&](Session& s, Reply& reply) {
    std::vector<std::uint8_t> pixels;
    if (s.open && !s.picture.counts.empty()) pixels = refine(*s.open, s.picture, {tile[0], tile[1], tile[2], tile[3]}, index, samples);
    reply.object().key("pixels").block(pixels).end_object();
  });
}

const OrbcReply* orbc_export(const char* text, size_t size, const char* format, const double* eye) {
  return answer([&](Session& s, Reply& reply) {
    auto source = std::make_shared<SourceText>();
    source->name = "scene.yaml";
    source->text.assign(text, size);
    const ExportedScene made = export_scene(source, s.files, {format, eye}, tell);
    reply.object().key("diagnostics");
    describe_diagnostics(made.diagnostics, reply);
    reply.key("files").array();
    for (const driver::File& file : made.files)
      reply.object()
          .key("name")
          .value(file.name)
          .key("bytes")
          .block(std::vector<std::uint8_t>(file.bytes.begin(), file.bytes.end()))
          .end_object();
    reply.end_array().key("copies").value(static_cast<double>(made.copies)).key("triangles").value(static_cast<double>(made.triangles));
    reply.key("error_px").value(made.error_px).end_object();
  });
}
