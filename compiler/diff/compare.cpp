#include "compiler/diff/compare.h"

#include <fmt/format.h>

#include <array>
#include <utility>

namespace orbc::diff {

Diagnostic bad_file(const std::string& name, const std::string& what) {
  return make_error("diff.bad-file", fmt::format("{}: {}", name, what), "write the file again");
}

std::optional<Form> form_of(std::string_view name) {
  constexpr std::array<std::pair<std::string_view, Form>, 10> kEndings = {{{".pov", Form::pov},
                                                                           {".inc", Form::pov},
                                                                           {".svg", Form::svg},
                                                                           {".json", Form::json},
                                                                           {".gltf", Form::gltf},
                                                                           {".glb", Form::glb},
                                                                           {".png", Form::picture},
                                                                           {".jpg", Form::picture},
                                                                           {".jpeg", Form::picture},
                                                                           {".exr", Form::picture}}};
  for (const auto& [ending, form] : kEndings)
    if (name.size() > ending.size() && name.substr(name.size() - ending.size()) == ending) return form;
  return {};
}

Result<Finding> compare(Form form, const Source& a, const Source& b, const Limits& limits) {
  Finding finding;
  Diagnostics errors;
  switch (form) {
    case Form::pov:
    case Form::svg:
      errors = compare_text(form, a, b, limits, finding);
      break;
    case Form::json:
      errors = compare_json(a, b, limits, finding);
      break;
    case Form::gltf:
    case Form::glb:
      errors = compare_gltf(form, a, b, limits, finding);
      break;
    case Form::picture:
      errors = compare_pictures({a.name, a.bytes}, {b.name, b.bytes}, limits, finding);
      break;
  }
  if (!errors.empty()) return errors;
  return finding;
}

}  // namespace orbc::diff
