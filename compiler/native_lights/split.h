#pragma once
#include "compiler/native_lights/native_light.h"
#include "compiler/place/interior.h"

namespace orbc::native_lights {

/// Whether the renderer lights the exports of this scene by lamps of its own (`bake: {lights: native}`).
[[nodiscard]] bool uses_native_lights(const scene::Scene& scene);

/// A scene and its room without light.
struct UnlitCopy {
  scene::Scene scene;
  place::Interior interior;
};

/// The scene as the renderer's lamps expect it: without lamps, in plain colors. Emissive surfaces have the radiance that the picture shows,
/// and parts of their own.
[[nodiscard]] UnlitCopy unlit_copy(const scene::Scene& scene, const place::Interior& interior);

/// In: a part of UnlitCopy::interior, all of whose triangles are emissive, or none; or an impostor, whose styles come after the interior's.
[[nodiscard]] Shading shading_of(const place::Interior& interior, const place::PlacedMesh& part);

}  // namespace orbc::native_lights
