#pragma once
#include <map>
#include <optional>
#include <string>

namespace orbc::cli {

/// A folder of frames, and `manifest.json` in it, which says what each frame was made of. Several processes, also on several machines, may
/// fill one folder: they take frames by advisory locks, which the system releases when a process ends, however it ends.
class FilmFolder {
 public:
  /// Makes the folder if it is missing. Throws std::system_error. In: the ending of frames, ".png".
  FilmFolder(std::string folder, std::string ending, int frames);

  /// "film/frame-0007.png", with as many digits as the last frame needs, at least four.
  [[nodiscard]] std::string frame_file(int frame) const;
  /// "frame-%04d.png", as ffmpeg reads it.
  [[nodiscard]] std::string pattern() const;
  [[nodiscard]] std::string path_of(const std::string& name) const;

  /// What the frames that are there were made of, by file name.
  [[nodiscard]] std::map<std::string, std::string> manifest() const;
  /// Whether the frame is there and was made of the same.
  [[nodiscard]] bool has(int frame, const std::string& fingerprint) const;
  /// Files named like frames that the manifest does not know: other programs' pictures, which are not replaced.
  [[nodiscard]] std::optional<std::string> foreign_frame(int begin, int end) const;

  /// Writes a frame and its entry in the manifest; both appear whole.
  void write(int frame, const std::string& fingerprint, const std::string& bytes) const;

  /// The right to make a frame: held by one process at a time, until the object ends.
  class Claim {
   public:
    Claim(std::string file, bool wait);
    ~Claim();
    Claim(const Claim&) = delete;
    Claim& operator=(const Claim&) = delete;
    [[nodiscard]] bool held() const { return descriptor_ >= 0; }

   private:
    std::string file_;
    int descriptor_ = -1;
  };
  [[nodiscard]] Claim claim(int frame) const { return {frame_file(frame) + ".lock", false}; }

 private:
  std::string folder_, ending_;
  int digits_;
};

}  // namespace orbc::cli
