#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "compiler/driver/product.h"

namespace orbc::exporters {

/// What an export is to be called, and how it is to be divided.
struct ExportOptions {
  std::string name = "scene";     ///< the output's stem: files beside the main output begin with it
  bool single_file = false;       ///< all in the main output, which may then be a pipe
  bool nodes_per_copy = false;    ///< formats with nodes: one for every copy
  bool nodes_per_object = false;  ///< formats with nodes: one for every object, of all its copies
};

/// A format that scenes are exported in.
struct ExportFormat {
  std::string_view name;             ///< of the option --format, and without its dot the ending of files
  std::string_view engine = "";      ///< the engine of `orbc render` that draws it; "" for none
  bool can_be_single_file = true;    ///< it can go to standard output
  bool holds_exr = false;            ///< its atlas may be an EXR
  bool lights_copies_apart = false;  ///< native lamps light their own copy alone
  bool has_nodes = false;
  bool has_side_files = false;       ///< unless all is in a single file
  bool is_page = false;              ///< the designer's page, which holds the scene itself and shows no product
  /// Null for the formats that show no product: tilings and the page.
  std::vector<driver::File> (*write)(const driver::Product& product, const ExportOptions& options) = nullptr;
  /// About how many bytes that takes, without the atlas. Null where `write` is.
  std::uint64_t (*estimated_bytes)(const driver::Amount& amount) = nullptr;
};

/// All formats, in the order in which texts name them.
[[nodiscard]] const std::vector<ExportFormat>& export_formats();

/// The format of that name, or null.
[[nodiscard]] const ExportFormat* find_export_format(std::string_view name);

/// The format that an engine of `orbc render` draws, or null.
[[nodiscard]] const ExportFormat* find_format_of_engine(std::string_view engine);

/// The names of all formats with a prefix: ".pov, .glb, .gltf or .svg".
[[nodiscard]] std::string export_format_names(std::string_view prefix);

}  // namespace orbc::exporters
