#pragma once
#include <cstdint>
#include <vector>

#include "compiler/bend/bend.h"
#include "compiler/cutoff/endings.h"

namespace orbc::cutoff {

/// One impostor per mirror (parallel to Interior::mirrors): a panel that is drawn in the mirror where no copy lies behind it.
/// In:    `bands`: heights in ascending order. The panel has a style of its own between each two of them: first_style from the floor up to
///        bands[0], first_style + 1 up to bands[1], …  `unsplit`: as few triangles as possible, to be drawn without splitting.
/// Makes: meshes in room coordinates named "curtain".
[[nodiscard]] std::vector<place::PlacedMesh> impostor_panels(const place::Interior& room, std::uint16_t first_style,
                                                             const std::vector<double>& bands = {}, bool unsplit = false);

/// Whether impostors that stand for copies of at most `pixels` may be drawn without splitting their triangles. From the eye an unsplit
/// panel covers the same bearings as the wall, whose image bulges towards the eye, and nothing else lies between the two. Only the edge of
/// the floor in front does not end at the panel; the panel hides that by reaching into the floor.
[[nodiscard]] bool can_skip_splitting(const place::Interior& room, double pixels);

/// The heights at which impostors for culled copies change their color: above the eye more of the ceiling is seen through a mirror, below
/// it more of the floor. Makes: ascending; none in rooms with mirrors on floor or ceiling.
[[nodiscard]] std::vector<double> height_bands(const place::Interior& room, const place::Camera& eye);

/// The panels that a picture may need, each list parallel to the mirrors.
struct ImpostorPanels {
  std::vector<place::PlacedMesh> depth;         ///< one style: that after the room's
  std::vector<place::PlacedMesh> size;          ///< a style for each band: those after the style of `depth`
  std::vector<place::PlacedMesh> size_unsplit;  ///< the same as few triangles
};
[[nodiscard]] ImpostorPanels impostor_panels(const place::Interior& room, const place::Camera& eye);

/// The impostors for each kind of ending, parallel to the mirrors; empty: such endings get none.
struct Impostors {
  std::vector<bend::Model::Part> depth, size;
};

/// Models together with impostors.
struct ModelsWithImpostors {
  std::vector<bend::Model> models;  ///< the given ones first
  std::vector<std::uint32_t> model_of_copy;
  std::uint64_t attached = 0;  ///< impostors of all copies
};

/// Adds impostors to the models of copies at whose mirrors paths end. Copies that need the same impostors on the same model share one.
[[nodiscard]] ModelsWithImpostors attach_impostors(const Endings& endings, const std::vector<cover::Copy>& copies,
                                                   const Impostors& impostors, std::vector<bend::Model> models,
                                                   std::vector<std::uint32_t> model_of_copy);

}  // namespace orbc::cutoff
