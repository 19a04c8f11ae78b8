#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace orbc::html {

/// A reply in the making: JSON text, and the block of bytes in which its arrays lie (core.h).
class Reply {
 public:
  Reply& object() { return open('{'); }
  Reply& array() { return open('['); }
  Reply& end_object() { return close('}'); }
  Reply& end_array() { return close(']'); }
  Reply& key(std::string_view name);
  Reply& value(std::string_view text);
  Reply& value(const char* text) { return value(std::string_view(text)); }
  Reply& value(bool truth);
  /// Infinite numbers are null: JSON has none.
  Reply& value(double number);
  Reply& value(int number) { return value(static_cast<double>(number)); }
  Reply& value(std::size_t number) { return value(static_cast<double>(number)); }
  Reply& numbers(std::span<const double> list);
  /// Numbers in the block.
  template <class T>
  Reply& block(const std::vector<T>& list) {
    return add_block(name_of<T>(), list.data(), list.size(), sizeof(T));
  }

  std::string json;
  std::vector<std::uint8_t> bytes;

 private:
  template <class T>
  static const char* name_of() {
    if (std::is_same_v<T, float>) return "f32";
    if (std::is_same_v<T, double>) return "f64";
    if (std::is_same_v<T, std::uint32_t>) return "u32";
    static_assert(std::is_same_v<T, float> || std::is_same_v<T, double> || std::is_same_v<T, std::uint32_t> ||
                  std::is_same_v<T, std::uint8_t>);
    return "u8";
  }
  Reply& open(char bracket);
  Reply& close(char bracket);
  Reply& add_block(const char* type, const void* data, std::size_t count, std::size_t size);
  void separate();

  bool first_ = true;  ///< nothing stands yet in the innermost bracket, or a key stands before the value
};

/// The text as a JSON string, with quotes. `<` is escaped, so that it may stand in a script element of HTML.
[[nodiscard]] std::string quoted(std::string_view text);

}  // namespace orbc::html
