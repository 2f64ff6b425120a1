// The folder NAME.live beside a database, in which every program that runs an attempt keeps one small file.
//
// Folder 0700 and files 0600 of the user who runs the program: a folder or file of anybody else, a link in its place,
// or one that others may open is not touched and not read. Files are written under another name and renamed, so that
// nobody reads half of one. Nothing here throws: training goes on without a live view. Thread: one folder object
// belongs to one thread.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace trocar {

class LiveFolder {
 public:
  static constexpr std::size_t kLargest = 64 * 1024;                   ///< bytes of a file that is read
  static constexpr const char *kMoment = ".json", *kPicture = ".jpg";  ///< how the names of a program's two files end
  /// Name of the picture that goes with a moment's name.
  static std::string picture_of(const std::string& moment_name);

  enum class Open : std::uint8_t { kExisting, kMake };
  /// @param database its file; empty (in memory): there is no folder.
  LiveFolder(const std::filesystem::path& database, Open how);
  ~LiveFolder();
  LiveFolder(const LiveFolder&) = delete;
  LiveFolder& operator=(const LiveFolder&) = delete;

  bool open() const { return folder_ >= 0; }
  /// Why a folder that is there is not used; "" when it is, or when there is none.
  const std::string& refusal() const { return refusal_; }

  bool write(const std::string& name, const std::string& text);
  /// Nothing: no such file, or one that is not to be trusted.
  std::optional<std::string> read(const std::string& name) const;
  void remove(const std::string& name);
  /// Names of files that tell of a program, in their order.
  std::vector<std::string> names() const;
  /// Age of a file's content by the wall clock, s.
  std::optional<double> age_s(const std::string& name) const;

  /// A desk looks now.
  void look();
  /// How long ago a desk looked, s; nothing: none ever did.
  std::optional<double> last_look_s() const;

  static std::filesystem::path beside(const std::filesystem::path& database);

 private:
  std::filesystem::path path_;
  std::string refusal_;
  int folder_ = -1;
};

}  // namespace trocar
