#include "compiler/cli/scene_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "compiler/place/distortion.h"
#include "compiler/place/locate.h"

namespace orbc::cli {
namespace {

using Json = nlohmann::ordered_json;

Json relations_json(const driver::LoadedScene& loaded) {
  const auto& walls = loaded.interior->polygon.walls;
  const auto length = [&](int wall) { return walls[static_cast<std::size_t>(wall - 1)].length; };
  Json list = Json::array();
  for (const scene::LengthRelation& relation : loaded.scene.room.shape.relations)
    list.push_back({{"wall", relation.wall},
                    {"factor", relation.factor},
                    {"of", relation.of},
                    {"residual", std::fabs(length(relation.wall) - relation.factor * length(relation.of))}});
  return list;
}

Json object_json(const scene::Object& object, const place::PlacedMesh& part, const driver::LoadedScene& loaded) {
  constexpr double kDegrees = 180 / std::numbers::pi;
  const room::Room& room = loaded.interior->polygon;
  const auto axis = place::locate(object.place, room);
  if (!axis) return nullptr;
  const place::EmbeddingDistortion d = place::embedding_distortion(room.space, object.embedding, place::reach_of(part, room.space, *axis));
  return {{"name", object.name},
          {"embedding", object.embedding == scene::Embedding::conformal ? "conformal" : "exponential"},
          {"reach", d.reach / loaded.unit_of_length},
          {"least_scale", d.least_scale},
          {"largest_scale", d.largest_scale},
          {"angle", d.angle * kDegrees},
          {"upright_angle", d.upright_angle * kDegrees}};
}

Json objects_json(const driver::LoadedScene& loaded) {
  Json list = Json::array();
  const auto& parts = loaded.interior->parts;
  for (const scene::Object& object : loaded.scene.objects) {
    const auto part = std::find_if(parts.begin(), parts.end(), [&](const place::PlacedMesh& mesh) {
      return mesh.kind == place::PartKind::object && mesh.name == object.name;
    });
    if (part == parts.end()) continue;
    if (Json told = object_json(object, *part, loaded); !told.is_null()) list.push_back(std::move(told));
  }
  return list;
}

std::string object_text(const Json& object) {
  const double least = object["least_scale"], largest = object["largest_scale"], angle = object["angle"], upright = object["upright_angle"];
  const std::string name = object["name"], reach = place::to_text(object["reach"]);
  if (least == 1 && largest == 1) return fmt::format("  {}: reaches {} from its axis, in true shape\n", name, reach);
  return fmt::format(
      "  {}: reaches {} from its axis; {} embedding: lengths there are {:.1f} % of true ones, angles in the floor off by {:.1f}°, "
      "upright ones by {:.1f}°\n",
      name, reach, object["embedding"].get<std::string>(), 100 * (least < 1 ? least : largest), angle, upright);
}

}  // namespace

Json scene_report(const std::string& scene, const driver::LoadedScene& loaded) {
  Json lengths = Json::array();
  for (const room::Wall& wall : loaded.interior->polygon.walls) lengths.push_back(wall.length / loaded.unit_of_length);
  return {{"scene", scene}, {"side_lengths", lengths}, {"relations", relations_json(loaded)}, {"objects", objects_json(loaded)}};
}

std::string report_text(const Json& report) {
  std::string text = "  walls:";
  for (const double length : report["side_lengths"]) text += fmt::format(" {}", place::to_text(length));
  text += '\n';
  for (const Json& relation : report["relations"])
    text += fmt::format("  wall {} = {} wall {}, residual {:.1e}\n", relation["wall"].get<int>(), place::to_text(relation["factor"]),
                        relation["of"].get<int>(), relation["residual"].get<double>());
  for (const Json& object : report["objects"]) text += object_text(object);
  return text;
}

}  // namespace orbc::cli
