#include "compiler/cli/film_folder.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <system_error>

#include "compiler/cli/output.h"

namespace orbc::cli {
namespace {

constexpr int kLeastDigits = 4;
constexpr const char* kManifest = "manifest.json";

[[noreturn]] void fail_with_errno(const std::string& what) { throw std::system_error(errno, std::generic_category(), what); }

/// Whether the file that a descriptor has open is still the one of that name.
bool is_current(int descriptor, const std::string& file) {
  struct stat opened {
  }, named{};
  return ::fstat(descriptor, &opened) == 0 && ::stat(file.c_str(), &named) == 0 && opened.st_ino == named.st_ino &&
         opened.st_dev == named.st_dev;
}

}  // namespace

FilmFolder::FilmFolder(std::string folder, std::string ending, int frames)
    : folder_(std::move(folder)),
      ending_(std::move(ending)),
      digits_(std::max(kLeastDigits, static_cast<int>(std::to_string(frames - 1).size()))) {
  std::error_code error;
  std::filesystem::create_directories(folder_, error);
  if (error) throw std::system_error(error, "cannot make the folder " + folder_);
}

std::string FilmFolder::path_of(const std::string& name) const { return (std::filesystem::path(folder_) / name).string(); }

std::string FilmFolder::frame_file(int frame) const { return path_of(fmt::format("frame-{:0{}}{}", frame, digits_, ending_)); }

std::string FilmFolder::pattern() const { return fmt::format("frame-%0{}d{}", digits_, ending_); }

std::map<std::string, std::string> FilmFolder::manifest() const {
  std::ifstream file(path_of(kManifest), std::ios::binary);
  if (!file) return {};
  const std::string text((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  const auto json = nlohmann::json::parse(text, nullptr, false);
  std::map<std::string, std::string> entries;
  if (!json.is_object() || !json.contains("frames") || !json["frames"].is_object())
    throw std::runtime_error(fmt::format("{} is no manifest of orbc animate: choose another folder", path_of(kManifest)));
  for (const auto& [name, value] : json["frames"].items())
    if (value.is_string()) entries[name] = value.get<std::string>();
  return entries;
}

bool FilmFolder::has(int frame, const std::string& fingerprint) const {
  const std::string file = frame_file(frame);
  if (!std::filesystem::exists(file)) return false;
  const auto entries = manifest();
  const auto entry = entries.find(std::filesystem::path(file).filename().string());
  return entry != entries.end() && entry->second == fingerprint;
}

std::optional<std::string> FilmFolder::foreign_frame(int begin, int end) const {
  const auto entries = manifest();
  for (int frame = begin; frame < end; ++frame) {
    const std::filesystem::path file = frame_file(frame);
    if (std::filesystem::exists(file) && entries.count(file.filename().string()) == 0) return file.string();
  }
  return std::nullopt;
}

void FilmFolder::write(int frame, const std::string& fingerprint, const std::string& bytes) const {
  const Claim manifest_lock(path_of(kManifest) + ".lock", true);
  auto entries = manifest();
  const std::string file = frame_file(frame);
  const auto write_manifest = [&](const std::string& entry) {
    entries[std::filesystem::path(file).filename().string()] = entry;
    const nlohmann::ordered_json json = {{"orbc", "film"}, {"frames", entries}};
    write_output(path_of(kManifest), json.dump(1) + "\n");
  };
  // An end between two of these steps leaves a frame that is ours and is drawn again.
  write_manifest("");
  write_output(file, bytes);
  write_manifest(fingerprint);
}

FilmFolder::Claim::Claim(std::string file, bool wait) : file_(std::move(file)) {
  for (;;) {
    descriptor_ = ::open(file_.c_str(), O_CREAT | O_RDWR | O_CLOEXEC, 0666);
    if (descriptor_ < 0) fail_with_errno("cannot create " + file_);
    const int locked = ::flock(descriptor_, LOCK_EX | (wait ? 0 : LOCK_NB));
    if (locked == 0 && is_current(descriptor_, file_)) return;
    const bool taken = locked != 0 && errno == EWOULDBLOCK;
    const bool failed = locked != 0 && errno != EWOULDBLOCK && errno != EINTR;
    ::close(descriptor_);
    descriptor_ = -1;
    if (failed) fail_with_errno("cannot lock " + file_);
    if (taken) return;
  }
}

FilmFolder::Claim::~Claim() {
  if (descriptor_ < 0) return;
  ::unlink(file_.c_str());
  ::close(descriptor_);
}

}  // namespace orbc::cli
