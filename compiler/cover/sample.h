#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

#include "compiler/cover/copy.h"
#include "compiler/place/camera.h"
#include "compiler/place/interior.h"

namespace orbc::cover {

/// A copy that represents `weight` copies, itself included.
struct Sample {
  std::size_t copy = 0;  ///< index
  double weight = 1;
};

/// The meshes of copies. A model is a list of meshes, one for each part of the room that it draws; every copy is drawn from one model.
struct Contents {
  const place::Interior* room = nullptr;
  std::vector<std::vector<const place::PlacedMesh*>> models;
  std::vector<std::uint32_t> model_of_copy;  ///< empty: all copies are drawn from the first model
};
/// Every copy is drawn with all parts of the room.
[[nodiscard]] Contents contents_of(const place::Interior& room);

/// Samples about `max_samples` copies, so that a sum over all copies is estimated by Σ weight · (value of the sampled copy).
/// In:      max_samples ≥ 1.
/// Makes:   the quarter of the samples that is nearest to the eye one by one (bending splits these most). Of the other copies a systematic
///          sample in the order of distance, with a probability proportional to the estimated number of visible triangles. The same input
///          gives the same sample: no random numbers are used.
[[nodiscard]] std::vector<Sample> stratified_sample(const std::vector<Copy>& copies, const Contents& contents, const place::Camera& eye,
                                                    std::size_t max_samples);

}  // namespace orbc::cover
