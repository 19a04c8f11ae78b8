// The man page. What commands take comes from their definitions; what holds for all of them stands here.
#include "compiler/cli/manual.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "compiler/cli/accepts.h"

namespace orbc::cli {
namespace {

constexpr const char* kExitStatus = R"(.SH EXIT STATUS
.TP
.B 0
Done. Of
.BR verify :
the pictures agree.
.TP
.B 1
The scene is wrong, or cannot be had within the limits given. Of
.BR verify :
the pictures differ.
.TP
.B 2
The command line is wrong.
.TP
.B 3
The machine: disk, memory, or a renderer that is missing or fails.
.TP
.B 130
Stopped by Ctrl\-C, SIGTERM or SIGHUP. The message says whether the output had been written; it is never half there.
)";

constexpr const char* kFiles = R"(.SH FILES
.TP
.I scene.yaml
A scene: YAML or JSON.
.B orbc new
writes one,
.B orbc schema
prints which keys there are.
Meshes and pictures are looked for relative to the scene file; of a scene on standard input, relative to the working directory.
.TP
.I PREFIX/share/orbc/orbc\-scene.schema.json
The schema, for editors.
.TP
.I PREFIX/share/orbc/povray\-pipe\fR, \fIPREFIX/share/orbc/render_blender.py
Scripts that draw exports with POV\-Ray and Blender.
.SH ENVIRONMENT
.TP
.B TMPDIR
Where
.BR render " and " verify
keep what they hand to a renderer; removed afterwards. Default: /tmp.
.TP
.B PATH
Where
.B povray
and
.B blender
are looked for.
.TP
.B TERM
.I dumb
shows no progress bar. Neither does standard error that is no terminal.
)";

constexpr const char* kExamples = R"(.SH EXAMPLES
A scene, what is wrong with it, a picture, a smoother and larger one:
.PP
.nf
.RS
orbc new \(aq*2323\(aq > s.yaml
orbc check s.yaml
orbc render s.yaml \-o s.png
orbc render s.yaml \-o s.png \-\-samples 16 \-\-set \(aqcamera.size=[1600, 1200]\(aq
.RE
.fi
.PP
The same room from another place, and in another orbifold, without touching the file:
.PP
.nf
.RS
orbc render s.yaml \-o t.png \-\-set \(aqcamera.at={polar: [0.2, 90deg], z: 0.4}\(aq
orbc render s.yaml \-o u.png \-\-set \(aqorbifold=*22222\(aq \-\-set cover.max_bounces=4
.RE
.fi
.PP
For Blender, for POV\-Ray through a pipe, and as a drawing of the tiling:
.PP
.nf
.RS
orbc compile s.yaml \-o s.glb
orbc compile s.yaml \-f pov \-o \- | povray\-pipe \-o s.png
orbc compile s.yaml \-o s.svg \-\-model klein
.RE
.fi
.PP
What a diagnostic means:
.PP
.nf
.RS
orbc explain scene.no\-effect
.RE
.fi
)";

// The character of UTF-8 that begins at `at` as roff names it, which reads ASCII: \[u221E]. Moves `at` to its last byte.
std::string named_character(const std::string& text, std::size_t& at) {
  const auto lead = static_cast<unsigned char>(text[at]);
  const std::size_t more = lead >= 0xF0 ? 3 : lead >= 0xE0 ? 2 : 1;
  unsigned code = lead & (0x3Fu >> more);
  for (std::size_t i = 0; i < more && at + 1 < text.size(); ++i) code = code << 6 | (static_cast<unsigned char>(text[++at]) & 0x3Fu);
  return fmt::format("\\[u{:04X}]", code);
}

// Text as roff shows it: dashes that can be copied, straight quotes, no line that begins with a request.
std::string roff(const std::string& text) {
  std::string out;
  bool line_start = true;
  for (std::size_t at = 0; at < text.size(); ++at) {
    const char c = text[at];
    if (static_cast<unsigned char>(c) >= 0x80) out += named_character(text, at);
    else if (c == '\\') out += "\\e";
    else if (c == '-') out += "\\-";
    else if (c == '\'') out += "\\(aq";
    else if (c == '`') out += "\\(ga";
    else if (c == '^') out += "\\(ha";
    else if (c == '~') out += "\\(ti";
    else if (line_start && c == '.') out += "\\&.";
    else out += c;
    line_start = c == '\n';
  }
  return out;
}

// "-o, --output FILE" with the names bold and what stands behind them in italics.
std::string heading(const CLI::Option& option) {
  const std::string names = fmt::format("\\fB{}\\fR", roff(names_of(option)));
  const Accepts taken = accepts(option);
  if (taken.type.empty()) return names;
  if (option.get_positional()) return fmt::format("\\fI{}\\fR", roff(taken.type));
  return fmt::format("{} \\fI{}\\fR", names, roff(taken.choices.empty() ? taken.type : placeholder(taken)));
}

std::string option_entry(const CLI::Option& option) {
  std::string text = option.get_description();
  if (!text.empty() && text.back() != '.') text += '.';
  const Accepts taken = accepts(option);
  if (taken.bounds) text += fmt::format(" From {} to {}.", taken.bounds->least, taken.bounds->most);
  if (option.get_required()) text += " Required.";
  if (!option.get_default_str().empty()) text += fmt::format(" Default: {}.", option.get_default_str());
  return fmt::format(".TP\n{}\n{}\n", heading(option), roff(text));
}

std::string synopsis(const CLI::App& command) {
  std::string text = fmt::format(".B orbc {}\n", roff(command.get_name()));
  for (const CLI::Option* option : options_of(command))
    if (!option->get_positional() && option->get_required()) text += fmt::format("{}\n", heading(*option));
  text += "[\\fIoptions\\fR]\n";
  for (const CLI::Option* option : options_of(command))
    if (option->get_positional()) {
      const std::string word = fmt::format("\\fI{}\\fR{}", accepts(*option).type, option->get_items_expected_max() > 1 ? " ..." : "");
      text += option->get_required() ? word + "\n" : fmt::format("[{}]\n", word);
    }
  return text;
}

// The examples of a command: its footer without the heading.
std::string examples(const CLI::App& command) {
  std::string footer = command.get_footer();
  const std::string title = "Examples:\n";
  if (footer.rfind(title, 0) == 0) footer = footer.substr(title.size());
  if (footer.empty()) return "";
  std::string text;
  for (std::size_t begin = 0; begin < footer.size();) {
    const std::size_t end = std::min(footer.find('\n', begin), footer.size());
    const std::size_t word = std::min(footer.find_first_not_of(' ', begin), end);
    text += roff(footer.substr(word, end - word)) + "\n";
    begin = end + 1;
  }
  return ".PP\n.nf\n.RS\n" + text + ".RE\n.fi\n";
}

}  // namespace

std::string man_page(const CLI::App& app) {
  std::string text = fmt::format(".TH ORBC 1 \"\" \"{}\" \"User Commands\"\n.SH NAME\norbc \\- compile rooms with mirrors: orbifolds to "
                                 "POV\\-Ray, Blender and SVG\n.SH SYNOPSIS\n", roff(app.version()));
  bool first = true;
  for (const CLI::App* command : commands_of(app)) {
    if (!first) text += ".br\n";
    text += synopsis(*command);
    first = false;
  }
  text += ".SH DESCRIPTION\n" + roff(app.get_description()) + "\n.SH COMMANDS\n";
  for (const CLI::App* command : commands_of(app)) {
    text += fmt::format(".SS orbc {}\n{}.\n", roff(command->get_name()), roff(command->get_description()));
    for (const CLI::Option* option : options_of(*command))
      if (!option->check_lname("help")) text += option_entry(*option);
    text += examples(*command);
  }
  text += ".SH OPTIONS\nThese stand before a command.\n";
  for (const CLI::Option* option : options_of(app)) text += option_entry(*option);
  return text + kExitStatus + kFiles + kExamples;
}

}  // namespace orbc::cli
