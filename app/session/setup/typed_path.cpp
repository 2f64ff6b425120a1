#include "app/session/setup/typed_path.h"

#include <filesystem>

namespace trocar {

std::string typed_path_fault(const std::string& path) {
  namespace fs = std::filesystem;
  if (path.empty()) return "is empty: a file is asked for";
  fs::path target(path);
  while (!target.has_filename() && target.has_relative_path())
    target = target.parent_path();  // "folder/" is the folder
  const fs::path folder = target.parent_path();
  if (folder.empty()) return "";
  std::error_code error;
  const fs::file_status status = fs::status(folder, error);
  // Anything else that is no folder to write into (a file, no right to look) is the machine's fault: writing will say
  // why.
  return status.type() == fs::file_type::not_found
             ? path + ": there is no folder " + folder.string() + "; make it first"
             : "";
}

}  // namespace trocar
