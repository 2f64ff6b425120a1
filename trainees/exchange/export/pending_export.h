// A file or folder that is written beside its place and moved there whole: all or nothing, and nothing is overwritten
// unasked. Its files are the owner's alone: they are about people.
//
// It is for its owner's eyes only. Until commit() it is called ".NAME.part-PID" in the same folder; without commit() it
// is removed. Thread: one.
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <ostream>
#include <string>

namespace trocar {

class PendingExport {
 public:
  enum class Shape : std::uint8_t { kFile, kFolder };

  enum class Existing : std::uint8_t { kKept, kReplaced };

  /// @param existing kReplaced: a file of that name gives way (a folder never does).
  /// @throws InputError: no name, exists already, its folder is missing. EnvironmentError: cannot be written there.
  PendingExport(const std::filesystem::path& out, Shape shape, Existing existing = Existing::kKept);
  ~PendingExport();
  PendingExport(const PendingExport&) = delete;
  PendingExport& operator=(const PendingExport&) = delete;

  /// Begins a file and ends the one before. @param name inside the folder ("part/NAME.txt"); not looked at for a file.
  /// @throws EnvironmentError: disk full, no permission.
  std::ostream& file(const std::string& name = "");
  /// Moves it to its place. @throws EnvironmentError; InputError when something has got that name meanwhile.
  void commit();

 private:
  void end_file();

  std::filesystem::path out_, pending_, current_;
  Shape shape_;
  Existing existing_;
  std::ofstream stream_;
  bool committed_ = false;
};

}  // namespace trocar
