#pragma once
#include "compiler/image/image.h"
#include "scripts/make_meshes/sdf.h"

namespace make_meshes {

orbc::mesh::Mesh vase();
orbc::image::Image vase_paint();

}  // namespace make_meshes
