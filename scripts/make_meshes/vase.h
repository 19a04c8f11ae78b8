#pragma once
#include "scripts/make_meshes/sdf.h"

namespace make_meshes {

orbc::mesh::Mesh vase();
orbc::mesh::Image vase_paint();

}  // namespace make_meshes
