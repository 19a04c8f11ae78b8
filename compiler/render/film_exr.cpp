// OpenEXR through a stream in memory, so that only the command line opens files.
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfOutputFile.h>

#include "compiler/mesh/exr_stream.h"
#include "compiler/render/film.h"

namespace orbc::render {
std::string to_exr(const Film& film) {
  const std::size_t n = film.color.size();
  const char* names[] = {"R", "G", "B", "Z", "N.X", "N.Y", "N.Z", "object.id", "bounces", "weight"};
  std::vector<std::vector<float>> planes(std::size(names), std::vector<float>(n));
  for (std::size_t i = 0; i < n; ++i) {
    const scene::Color& c = film.color[i];
    const double values[] = {c.r, c.g, c.b, film.depth[i], film.normal[i][0], film.normal[i][1], film.normal[i][2],
                             static_cast<double>(film.object[i]), static_cast<double>(film.bounces[i]), film.weight[i]};
    for (std::size_t k = 0; k < std::size(names); ++k) planes[k][i] = static_cast<float>(values[k]);
  }
  Imf::Header header(film.width, film.height);
  header.compression() = Imf::ZIP_COMPRESSION;
  Imf::FrameBuffer frame;
  for (std::size_t k = 0; k < std::size(names); ++k) {
    header.channels().insert(names[k], Imf::Channel(Imf::FLOAT));
    frame.insert(names[k], Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(planes[k].data()), sizeof(float),
                                      sizeof(float) * static_cast<std::size_t>(film.width)));
  }
  std::string bytes;
  {
    mesh::MemoryStream stream(bytes);
    Imf::OutputFile file(stream, header, 1);
    file.setFrameBuffer(frame);
    file.writePixels(film.height);
  }
  return bytes;
}

}  // namespace orbc::render
