#pragma once
#include "compiler/base/executor.h"
#include "compiler/driver/compile.h"

namespace orbc::driver {

/// Whether the renderer is to light the exports of this scene by lamps of its own (`bake: {lights: native}`).
[[nodiscard]] bool lit_natively(const scene::Scene& scene);

/// The scene as the renderer's lamps find it: without lamps, in plain colours; what glows as it is shown, in parts of its own.
[[nodiscard]] Opened unlit_twin(const Opened& opened);
/// How the triangles of a part of the twin shine. In: a part whose looks all glow, or none.
[[nodiscard]] Shine shine_of(const place::Interior& room, const place::PlacedMesh& part);

/// Hangs the lamps of a scene into its product: for every copy the images of the room's lamps that light reaches it from over
/// `bake.mirrors` mirrors, with their weights; and gives it normals.
/// Exact:       in E² with mirrors that are all alike, if a renderer lights each copy with its own lamps alone and lets everything cast
///              shadows; point, sphere, disk, rectangle and spot. Elsewhere lamps hang where the eye sees them.
/// In:          the product of the twin; copies as they were drawn.
/// Makes:       what its author should know, errors if it could not be done.
/// Diagnostics: driver.too-many-lamps; as a warning driver.native-lights-approximate.
[[nodiscard]] Diagnostics add_native_light(const Opened& opened, const std::vector<cover::Copy>& copies, Product& product,
                                           const Executor& executor);

/// The most images of lamps that a product may have.
inline constexpr std::size_t kMaxNativeLamps = 20'000;

}  // namespace orbc::driver
