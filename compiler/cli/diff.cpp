// Two files side by side: golden files and what is made of the scene today.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "compiler/cli/commands.h"
#include "compiler/cli/streams.h"
#include "compiler/cli/support.h"
#include "compiler/diff/compare.h"

namespace orbc::cli {
namespace {

std::string json(const diff::Finding& f, const DiffArguments& a) {
  nlohmann::ordered_json result = {{"agree", !f.differs},
                                 {"within", a.within},
                                 {"pixel_steps", a.pixels},
                                 {"same_structure", f.same_structure},
                                 {"numbers", f.numbers},
                                 {"numbers_differing", f.numbers_differing},
                                 {"numbers_beyond", f.numbers_beyond},
                                 {"largest", f.largest},
                                 {"largest_at", f.largest_at},
                                 {"pictures", f.pictures},
                                 {"pixels", f.pixels},
                                 {"pixels_differing", f.pixels_differing},
                                 {"pixels_beyond", f.pixels_beyond},
                                 {"largest_step", f.largest_step},
                                 {"largest_step_at", f.largest_step_at}};
  if (f.differs) result["first"] = {{"at", f.first.at}, {"at_in_other", f.first.at_in_other}, {"what", f.first.what}};
  // JSON has no infinity; names of files may be in any encoding.
  return result.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

std::string summary(const diff::Finding& f, const DiffArguments& a) {
  std::string text;
  if (f.differs) {
    text = fmt::format("{} and {} differ, first at {}", a.left, a.right, f.first.at);
    if (f.first.at_in_other != f.first.at) text += fmt::format(" ({} in the other)", f.first.at_in_other);
    text += ": " + f.first.what + (f.same_structure ? "\n" : "; what comes after it is not compared\n");
  } else {
    text = fmt::format("{} and {} agree\n", a.left, a.right);
  }
  if (f.numbers > 0) {
    text += fmt::format("numbers: {} of {} differ, {} by more than {:g}", f.numbers_differing, f.numbers, f.numbers_beyond, a.within);
    text += f.numbers_differing ? fmt::format("; the largest by {:.3g} at {}\n", f.largest, f.largest_at) : "\n";
  }
  if (f.pictures > 0) {
    text += fmt::format("pixels: {} of {} differ, {} by more than {}/255", f.pixels_differing, f.pixels, f.pixels_beyond, a.pixels);
    text += f.pixels_differing ? fmt::format("; the largest by {:.3g}/255 at {}\n", f.largest_step, f.largest_step_at) : "\n";
  }
  return text;
}

}  // namespace

int diff(const DiffArguments& a, const Common& common) {
  const auto left_form = diff::form_of(a.left), right_form = diff::form_of(a.right);
  for (const auto& [form, name] : {std::pair(left_form, &a.left), std::pair(right_form, &a.right)})
    if (!form)
      throw UsageError(
          fmt::format("cannot tell what \"{}\" is: the ending must be .pov, .svg, .json, .gltf, .glb, .png, .jpg or .exr", *name));
  if (*left_form != *right_form) throw UsageError(fmt::format("{} and {} are files of different kinds", a.left, a.right));
  Common plain = common;
  plain.json = false;  // unreadable files are the machine's fault, not a result
  const auto left = diff::read_source(a.left), right = diff::read_source(a.right);
  if (!left) print(left.error(), plain);
  if (!right) print(right.error(), plain);
  if (!left || !right) return kMachine;
  const auto finding = diff::compare(*left_form, *left, *right, {a.within, a.pixels});
  if (!finding) return print(finding.error(), plain), kMachine;
  if (common.json) write_standard_output(json(*finding, a));
  else if (!common.quiet) write_standard_output(summary(*finding, a));
  return finding->differs ? kSceneWrong : kDone;
}

}  // namespace orbc::cli
