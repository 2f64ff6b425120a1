// Where a recording goes: a file, or memory. Appends only. Thread: the recorder task.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace trocar {

class RecordingSink {
 public:
  virtual ~RecordingSink() = default;
  /// Appends all bytes or throws EnvironmentError naming the file; what was appended before stays readable.
  virtual void append(std::string_view bytes) = 0;
  /// Hands what was appended to the disk.
  virtual void sync() = 0;
};

/// File created (with its folder) or emptied on construction.
class FileSink final : public RecordingSink {
 public:
  /// @throws EnvironmentError naming the file: folder not creatable, no permission, no space.
  explicit FileSink(std::filesystem::path file);
  ~FileSink() override;
  FileSink(const FileSink&) = delete;
  FileSink& operator=(const FileSink&) = delete;
  void append(std::string_view bytes) override;
  void sync() override;

 private:
  [[noreturn]] void fail(const char* what, int error_number);

  std::filesystem::path file_;
  int descriptor_ = -1;
  long long written_ = 0;  ///< bytes of whole appends
};

class MemorySink final : public RecordingSink {
 public:
  void append(std::string_view bytes) override { bytes_ += bytes; }
  void sync() override {}
  const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
};

}  // namespace trocar
