// Bytes that are not UTF-8 would make the whole file unreadable; they become U+FFFD. Titles and names come from authors.
#include "exporters/gltf/json.h"

namespace orbc::gltf {
void Json::text(std::string_view value) {
  static constexpr char kHex[] = "0123456789abcdef";
  pen_ << '"';
  for (std::size_t i = 0; i < value.size();) {
    const unsigned char c = static_cast<unsigned char>(value[i]);
    const std::size_t length = exporters::utf8_length(value.substr(i));
    if (c == '"' || c == '\\') {
      pen_ << '\\' << value[i];
    } else if (c < 32) {
      pen_ << "\\u00" << kHex[c >> 4] << kHex[c & 15];
    } else if (length == 0) {
      pen_ << "\\ufffd";
    } else {
      pen_ << value.substr(i, length);
    }
    i += length == 0 ? 1 : length;
  }
  pen_ << '"';
}

}  // namespace orbc::gltf
