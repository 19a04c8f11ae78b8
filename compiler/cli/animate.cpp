// Films: orbc at, orbc animate.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <functional>
#include <optional>

#include "compiler/animation/moment.h"
#include "compiler/cli/child.h"
#include "compiler/cli/commands.h"
#include "compiler/cli/draw.h"
#include "compiler/cli/film_folder.h"
#include "compiler/cli/output.h"
#include "compiler/cli/picture.h"
#include "compiler/cli/progress_bar.h"
#include "compiler/cli/result.h"
#include "compiler/cli/streams.h"
#include "compiler/cli/support.h"
#include "compiler/driver/fingerprint.h"
#include "compiler/driver/threads.h"
#include "compiler/driver/trace_film.h"
#include "compiler/image_io/exr.h"
#include "compiler/scene/animation.h"
#include "compiler/scene/print_document.h"

namespace orbc::cli {
namespace {

constexpr int kSamplesOfAFrame = 4;  // samples a pixel

/// The scene's text with what the command line says, and the film that it describes.
struct Film {
  scene::SceneText text;
  scene::Overrides overrides;  ///< of the command line
  std::shared_ptr<const scene::Animation> animation;
  Diagnostics notes;
  std::uint64_t max_memory = 0;

  [[nodiscard]] scene::Overrides with(const scene::Overrides& more) const {
    scene::Overrides all = overrides;
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }
  [[nodiscard]] animation::ReadScene reader() const {
    return [this](const scene::Overrides& more) { return scene::read_scene(text.source, text.folder, with(more)); };
  }
};

Result<Film> open_film(const SceneArguments& arguments, const Common& common) {
  auto text = driver::open(arguments.scene);
  if (!text) return text.error();
  Film film{std::move(*text), overrides_of(arguments), nullptr, {}, parse_bytes(common.max_memory)};
  const auto read = film.reader()({});
  if (!read) return read.error();
  film.notes = read->notes;
  film.animation = read->scene.animation;
  if (!film.animation)
    return make_error("animation.missing", "nothing moves in this scene",
                      "add animation: {frames: 100, set: {camera.at: {walk: walls, distance: 0.15}, camera.look_at: ahead}}",
                      read->scene.span);
  return film;
}

// ---- frames ---------------------------------------------------------------------------------------------------------------------

/// A range of frames; `end` is not included.
struct FrameRange {
  int begin = 0, end = 0;
};

/// "40-79", "12", "" for all.
FrameRange frame_range(const std::string& text, int frames) {
  if (text.empty()) return {0, frames};
  int first = 0, last = 0;
  const char* end = text.data() + text.size();
  auto [at, error] = std::from_chars(text.data(), end, first);
  bool well = error == std::errc();
  last = first;
  if (well && at != end) {
    well = *at == '-';
    const auto second = std::from_chars(at + (well ? 1 : 0), end, last);
    well = well && second.ec == std::errc() && second.ptr == end;
  }
  if (!well || first < 0 || last < first || last >= frames)
    throw UsageError(
        fmt::format("--frames wants FIRST-LAST within 0-{}, such as 0-{}; got {}", frames - 1, std::min(39, frames - 1), text));
  return {first, last + 1};
}

/// A moment of the film, ready to be drawn: what it is made of, and what no eye changes of it.
struct Moment {
  scene::Overrides overrides;
  std::shared_ptr<const driver::PreparedScene> prepared;
  std::uint64_t content = 0;  ///< fingerprint of the furnished room
  place::Camera eye;
};

bool is_of_camera(const SourceText& override_text) { return override_text.text.compare(0, 7, "camera.") == 0; }

bool differ_in_camera_alone(const scene::Overrides& a, const scene::Overrides& b) {
  if (a.size() != b.size()) return false;
  for (std::size_t i = 0; i < a.size(); ++i)
    if (a[i].text != b[i].text && !(is_of_camera(a[i]) && is_of_camera(b[i]))) return false;
  return true;
}

/// The next moment. What no eye changes is taken over from the last moment, if nothing but the camera moves between them.
Result<Moment> next_moment(const Film& film, int frame, const std::optional<Moment>& last, const driver::PrepareOptions& options) {
  auto overrides = animation::overrides_of_frame(*film.animation, frame, film.reader());
  if (!overrides) return overrides.error();
  if (last && differ_in_camera_alone(last->overrides, *overrides)) {
    const auto still = film.reader()(*overrides);
    if (!still) return still.error();
    const auto eye = driver::eye_of(still->scene, last->prepared->loaded());
    if (!eye) return located(eye.error(), film.animation->span);
    return Moment{std::move(*overrides), last->prepared, last->content, *eye};
  }
  auto loaded = driver::load(film.text, film.with(*overrides), film.max_memory);
  if (!loaded) return loaded.error();
  Moment moment{std::move(*overrides), nullptr, driver::fingerprint(*loaded->interior), loaded->eye};
  moment.prepared = std::make_shared<const driver::PreparedScene>(std::move(*loaded), options);
  return moment;
}

/// All options that change the pixels of a frame, as text.
std::string options_text(const AnimateArguments& a) {
  const CompileArguments& c = a.render.compile;
  return fmt::format("{} {} {} {} {} {} {} {}", a.render.engine, a.render.samples, a.format, c.tolerance, c.max_triangles.value_or(0),
                     c.no_lod, c.highlights, c.max_atlas);
}

/// What a frame is made of, in 16 digits: program, scene, contents of its files, options.
Result<std::string> fingerprint_of(const Film& film, const Moment& moment, const std::string& options) {
  const auto document = scene::document_of(film.text, film.with(moment.overrides));
  if (!document) return document.error();
  std::uint64_t sum = driver::checksum(ORBC_VERSION);
  sum = driver::checksum(scene::flow_text(document->root), sum);
  sum = driver::checksum(fmt::format("{:x} {}", moment.content, options), sum);
  return fmt::format("{:016x}", sum);
}

/// The bytes of a frame, or nothing after an exit code other than kDone.
struct DrawnFrame {
  int code = kDone;
  std::string bytes;
};

DrawnFrame draw_frame(const Moment& moment, const AnimateArguments& a, PictureFormat format, const Common& common) {
  Common quiet = common;
  quiet.quiet = true;
  quiet.json = false;
  if (a.render.engine != "tracer") {
    // Exports are made for the eye of their scene.
    driver::LoadedScene loaded = moment.prepared->loaded();
    loaded.eye = moment.eye;
    Drawn drawn = draw_elsewhere(driver::PreparedScene(std::move(loaded), moment.prepared->options()), a.render, quiet);
    return {drawn.code, drawn.code == kDone ? encoded(drawn.picture, format) : ""};
  }
  const render::Film film = driver::trace_film(*moment.prepared, moment.eye, {a.render.samples}, driver::parallel_executor(common.threads));
  return {kDone, format == PictureFormat::exr
                     ? image_io::encode_exr(render::to_float_image(film))
                     : encoded(render::to_image(film, render::Pass::color, moment.prepared->scene().exposure), format)};
}

// ---- the film as a video ------------------------------------------------------------------------------------------------------------

std::vector<std::string> video_command(const FilmFolder& folder, const std::string& output, double rate) {
  const std::string program = program_in_path("ffmpeg").value_or("ffmpeg");
  std::vector<std::string> command = {
      program, "-y", "-loglevel", "error", "-framerate", fmt::format("{}", rate), "-i", folder.path_of(folder.pattern())};
  const bool webm = lower_case(std::filesystem::path(output).extension().string()) == ".webm";
  // Constant quality, in the pixel format that every player shows; an odd last row or column is left out, as this format asks for.
  const std::vector<std::string> codec = webm ? std::vector<std::string>{"-c:v", "libvpx-vp9", "-crf", "20", "-b:v", "0"}
                                              : std::vector<std::string>{"-c:v", "libx264", "-crf", "16"};
  command.insert(command.end(), codec.begin(), codec.end());
  command.insert(command.end(), {"-vf", "crop=trunc(iw/2)*2:trunc(ih/2)*2", "-pix_fmt", "yuv420p", "-bitexact", output});
  return command;
}

void check_video(const AnimateArguments& a) {
  if (a.video.empty()) return;
  const std::string ending = lower_case(std::filesystem::path(a.video).extension().string());
  if (ending != ".webm" && ending != ".mp4") throw UsageError(fmt::format("\"{}\": end a video in .webm or .mp4", a.video));
  if (a.format == "exr") throw UsageError("a video is made of frames of 8 bits: --format png");
  if (!program_in_path("ffmpeg")) throw UsageError("--video needs the program ffmpeg: apt-get install ffmpeg");
}

struct Counts {
  int drawn = 0, kept = 0, elsewhere = 0;
};

std::string summary(const AnimateArguments& a, const Counts& counts) {
  std::string text = fmt::format("{}: {} frames drawn", a.folder, counts.drawn);
  if (counts.kept > 0) text += fmt::format(", {} were there", counts.kept);
  if (counts.elsewhere > 0) text += fmt::format(", {} are being drawn by others", counts.elsewhere);
  return text;
}

enum class FrameState { drawn, kept, elsewhere, failed };

/// What has become of a frame; a failure has been printed, and has an exit code.
struct MadeFrame {
  FrameState state;
  int code = kDone;
};

/// Draws a frame unless it is there and still true, or another process is drawing it.
MadeFrame make_frame(const FilmFolder& folder, int frame, const std::string& fingerprint, const std::function<DrawnFrame()>& draw) {
  if (folder.has(frame, fingerprint)) return {FrameState::kept};
  const FilmFolder::Claim claim = folder.claim(frame);
  if (!claim.held()) return {FrameState::elsewhere};
  if (folder.has(frame, fingerprint)) return {FrameState::kept};  // another process has drawn it between the two questions
  const DrawnFrame drawn = draw();
  if (drawn.code != kDone) return {FrameState::failed, drawn.code};
  folder.write(frame, fingerprint, drawn.bytes);
  return {FrameState::drawn};
}

/// What has become of the frames of a range; a failure has been printed, and has an exit code.
struct DrawnFrames {
  Counts counts;
  int code = kDone;
};

DrawnFrames draw_frames(const Film& film, const FrameRange& range, const FilmFolder& folder, const AnimateArguments& a,
                        const Common& common) {
  const PictureFormat format = picture_format_of("frame." + a.format, a.render.engine == "tracer", "pictures of renderers have 8 bits");
  ProgressBar bar(!common.quiet && stderr_is_terminal());
  const Progress progress = bar.progress();
  Counts counts;
  std::optional<Moment> last;
  for (int frame = range.begin; frame < range.end; ++frame) {
    report(progress, "drawing", static_cast<std::uint64_t>(frame - range.begin), static_cast<std::uint64_t>(range.end - range.begin));
    auto moment = next_moment(film, frame, last, prepare_options(a.render.compile));
    if (!moment) return bar.clear(), print(moment.error(), common), DrawnFrames{counts, kSceneWrong};
    last = std::move(*moment);
    const auto fingerprint = fingerprint_of(film, *last, options_text(a));
    if (!fingerprint) return bar.clear(), print(fingerprint.error(), common), DrawnFrames{counts, kSceneWrong};
    const MadeFrame made = make_frame(folder, frame, *fingerprint, [&] { return draw_frame(*last, a, format, common); });
    switch (made.state) {
      case FrameState::drawn:
        ++counts.drawn;
        break;
      case FrameState::kept:
        ++counts.kept;
        break;
      case FrameState::elsewhere:
        ++counts.elsewhere;
        break;
      case FrameState::failed:
        return {counts, made.code};
    }
  }
  bar.clear();
  return {counts};
}

}  // namespace

int print_moment(const AtArguments& a, const Common& common) {
  const auto film = open_film(a.scene, common);
  if (!film) return print(film.error(), common), kSceneWrong;
  const auto overrides = animation::overrides_at(*film->animation, a.time, film->reader());
  if (!overrides) return print(overrides.error(), common), kSceneWrong;
  const auto still = film->reader()(*overrides);
  if (!still) return print(still.error(), common), kSceneWrong;
  const auto document = scene::document_of(film->text, film->with(*overrides));
  if (!document) return print(document.error(), common), kSceneWrong;
  const std::string text = scene::block_text(document->root);
  if (!common.json) write_output("-", text);
  print_result({{"time", a.time}, {"scene", text}}, still->notes, common);
  return kDone;
}

int animate(const AnimateArguments& arguments, const Common& common) {
  AnimateArguments a = arguments;
  if (a.render.samples == 0) a.render.samples = kSamplesOfAFrame;
  (void)picture_format_of("frame." + a.format, a.render.engine == "tracer", "pictures of renderers have 8 bits");
  check_video(a);
  if (a.render.engine != "tracer")
    if (const Diagnostics missing = missing_renderer(a.render.engine); !missing.empty()) return print(missing, common), kMachine;
  const auto film = open_film(a.render.compile.scene, common);
  if (!film) return print(film.error(), common), kSceneWrong;
  print(film->notes, common);
  const FrameRange range = frame_range(a.frames, film->animation->frames);
  const FilmFolder folder(a.folder, "." + a.format, film->animation->frames);
  if (const auto foreign = folder.foreign_frame(range.begin, range.end))
    return print({make_error("animation.foreign-frame", fmt::format("{} was not drawn by orbc animate", *foreign),
                             "move it away, or choose another folder")},
                 common),
           kSceneWrong;
  const DrawnFrames frames = draw_frames(*film, range, folder, a, common);
  if (frames.code != kDone) return frames.code;
  const Counts& counts = frames.counts;
  nlohmann::ordered_json result = {{"output", a.folder},
                                   {"frames", range.end - range.begin},
                                   {"drawn", counts.drawn},
                                   {"kept", counts.kept},
                                   {"drawn_by_others", counts.elsewhere}};
  if (!a.video.empty()) {
    if (counts.drawn + counts.kept < film->animation->frames)
      return print({make_error("animation.frames-missing", "the video is made when all frames are there",
                               "draw the others first, then give --video without --frames")},
                   common),
             kSceneWrong;
    const TemporaryFolder temporary;
    if (run_child({video_command(folder, a.video, film->animation->rate), temporary.path().string()}) != 0) return kMachine;
    result["video"] = a.video;
  }
  print_result(std::move(result), film->notes, common);
  if (!common.quiet) print_message(summary(a, counts) + "\n");
  return kDone;
}

}  // namespace orbc::cli
