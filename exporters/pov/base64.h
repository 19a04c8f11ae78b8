#pragma once
#include <string_view>

#include "exporters/text.h"

namespace orbc::pov {

/// Writes bytes as base64 (RFC 4648 §4) in lines of 76 characters, each ended by a newline. None of its letters can end a comment.
void write_base64(exporters::Pen& pen, std::string_view bytes);

}  // namespace orbc::pov
