#pragma once
#include <string>

#include "compiler/image/image.h"
#include "compiler/mesh/mesh.h"

namespace orbc::cli {

/// How a picture is written.
enum class PictureFormat { png, jpeg, exr };
[[nodiscard]] const char* name(PictureFormat format);

/// The format that the ending of `output` names, in capitals or not; "-", standard output, takes PNG.
/// Throws UsageError when it names none, or EXR where there are only 8 bits to write (`floats` is false; `why` says so).
[[nodiscard]] PictureFormat picture_format_of(const std::string& output, bool floats, const std::string& why);

/// The file's bytes: same picture, same bytes. In: png or jpeg.
[[nodiscard]] std::string encoded(const image::Image& picture, PictureFormat format);

}  // namespace orbc::cli
