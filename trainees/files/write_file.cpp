#include "trainees/files/write_file.h"

#include <cerrno>
#include <cstring>
#include <fstream>

#include "haptics/input_error.h"
#include "trainees/files/owner_file.h"

namespace trocar {
namespace {

void write_to(std::ofstream out, const std::filesystem::path& file, std::string_view bytes) {
  out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  out.close();
  if (!out) throw EnvironmentError(file.string() + ": cannot be written: " + std::strerror(errno));
}

}  // namespace

void write_file(const std::filesystem::path& file, std::string_view bytes) {
  write_to(std::ofstream(file, std::ios::binary), file, bytes);
}

void write_owner_file(const std::filesystem::path& file, std::string_view bytes) {
  write_to(open_owner_file(file), file, bytes);
}

}  // namespace trocar
