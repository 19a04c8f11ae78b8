#pragma once
#include <optional>
#include <string>
#include <string_view>

namespace orbc::mesh_io {

[[nodiscard]] bool is_data_uri(std::string_view uri);

/// The bytes of a data URI (RFC 2397) of any type, in base64 or percent-encoded. Blanks stand for '+', which decoders of URIs replace.
/// Makes: nothing when it has no comma or is no base64.
[[nodiscard]] std::optional<std::string> decode_data_uri(std::string_view uri);

}  // namespace orbc::mesh_io
