#include "trainees/files/password_file.h"

#include <sys/stat.h>

#include <fstream>

#include "haptics/input_error.h"

namespace trocar {

std::string read_password_file(const std::filesystem::path& file) {
  struct stat about {};
  if (stat(file.c_str(), &about) != 0)
    throw InputError(file.string() + ": the password cannot be read: there is no such file");
  if ((about.st_mode & 077) != 0) throw InputError(file.string() + ": others may read the password; chmod 600 first");
  std::ifstream in(file);
  std::string line;
  std::getline(in, line);
  if (line.empty()) throw InputError(file.string() + ": its first line is to be the password; it is empty");
  return line;
}

}  // namespace trocar
