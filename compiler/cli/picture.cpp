#include "compiler/cli/picture.h"

#include <fmt/format.h>

#include <filesystem>

#include "compiler/cli/support.h"
#include "compiler/image/image.h"
#include "compiler/image_io/jpeg.h"
#include "compiler/image_io/png.h"

namespace orbc::cli {

const char* name(PictureFormat format) { return format == PictureFormat::png ? "png" : format == PictureFormat::jpeg ? "jpeg" : "exr"; }

PictureFormat picture_format_of(const std::string& output, bool floats, const std::string& why) {
  if (output == "-") return PictureFormat::png;
  const std::string ending = lower_case(std::filesystem::path(output).extension().string());
  if (ending == ".png") return PictureFormat::png;
  if (ending == ".jpg" || ending == ".jpeg") return PictureFormat::jpeg;
  if (ending == ".exr" && floats) return PictureFormat::exr;
  if (ending == ".exr") throw UsageError(fmt::format("\"{}\": {}; end it in .png or .jpg", output, why));
  throw UsageError(fmt::format("cannot tell the format from \"{}\"; end it in .png, .jpg{}, or use - for PNG on standard output", output,
                               floats ? " or .exr" : ""));
}

std::string encoded(const image::Image& picture, PictureFormat format) {
  return format == PictureFormat::jpeg ? image_io::encode_jpeg(picture) : image_io::encode_png(picture);
}

}  // namespace orbc::cli
