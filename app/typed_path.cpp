#include "app/typed_path.h"

#include <filesystem>

namespace trocar {

std::string typed_path_fault(const std::string& path) {
  namespace fs = std::filesystem;
  if (path.empty()) return "is empty: a file is asked for";
  fs::path target(path);
  while (!target.has_filename() && target.has_relative_path()) target = target.parent_path();  // "folder/" is the folder
  const fs::path folder = target.parent_path();
  if (folder.empty()) return "";
  std::error_code error;
  const fs::file_status status = fs::status(folder, error);
  if (status.type() == fs::file_type::not_found) return path + ": there is no folder " + folder.string() + "; make it first";
  if (status.type() == fs::file_type::none || fs::is_directory(status)) return "";  // not allowed to look: writing will say why
  return path + ": " + folder.string() + " is a file, not a folder";
}

}  // namespace trocar
