#pragma once
#include <vector>

#include "compiler/base/diagnostic.h"
#include "compiler/light/lamp.h"
#include "compiler/place/camera.h"
#include "compiler/place/interior.h"
#include "compiler/scene/document.h"
#include "exporters/html/core/drawn_mesh.h"
#include "exporters/html/core/reply.h"

namespace orbc::html {

/// [{"severity": "error", "code", "message", "hint", "line", "column", "length", "text": as on a terminal}, …]; line 0: the whole file.
void describe_diagnostics(const Diagnostics& diagnostics, Reply& reply);

/// Where the values of a YAML text stand: [[path, kind, line, column, length, line of the key, column of the key], …]. Paths are keys and
/// indices joined by dots, "objects.0.at"; kinds are 0 empty, 1 scalar, 2 list, 3 map; lines and columns count from 1, in code points. Of
/// lists and maps only the beginning is told: the bracket, or the first entry.
void describe_nodes(const scene::Node& root, Reply& reply);

/// The value {"notation", "chi", "chi_value", "space", "orders": ["2", "5/2"], "real": whether a corner is no integer}.
void describe_orbifold(const notation::Orbifold& orbifold, Reply& reply);

/// The value {"curvature", "height", "corners": [[w, x, y, angle], …], "walls": [{"line": [w, x, y], "start": [w, x, y], "along": [w, x,
/// y], "length", "reflects"}, …], "inradius", "circumradius", "area", "moduli"}.
void describe_room(const place::Interior& interior, Reply& reply);

/// The value {"floor": surface, "ceiling": surface, "walls": [surface, …]}, where a surface is {"color": [r, g, b], "second": …, "pattern",
/// "cell", "texture": index or −1, "emission", "mirrors": [{"span": [from, to], "height": [from, to], "throughput": [r, g, b]}, …]}.
void describe_shell(const scene::Scene& scene, const place::Interior& interior, Reply& reply);

/// The member "styles": [surface without mirrors, and "kind", "roughness", "index"], parallel to Interior::styles; the member "textures":
/// [{"width", "height", "pixels": 4 u8 each, sRGB and alpha}, …].
void describe_styles(const place::Interior& interior, Reply& reply);

/// The member "meshes": {"positions", "normals", "colors", "coordinates": numbers of all vertices (drawn_mesh.h), "parts": [{"style",
/// "part", "name", "kind", "indices"}, …]}.
void describe_meshes(const place::Interior& interior, const DrawnMeshes& drawn, Reply& reply);

/// The members "objects": [{"name", "kind", "at": [w, x, y, z], "extent": largest horizontal distance from there, "top"}, …] and "lamps":
/// [{"kind", "at": [w, x, y, z], "power": [r, g, b]}, …].
void describe_things(const scene::Scene& scene, const place::Interior& interior, const std::vector<light::PlacedLamp>& lamps, Reply& reply);

/// The member "eye": {"room_from_eye": 9 numbers, "z", "forward", "right", "up", "fov" in radians, "size": [width, height]}.
void describe_eye(const place::Camera& eye, Reply& reply);

}  // namespace orbc::html
