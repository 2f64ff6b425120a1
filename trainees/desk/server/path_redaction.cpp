#include "trainees/desk/server/path_redaction.h"

#include <algorithm>

namespace trocar::review {
namespace {

constexpr const char *kEnds = " \t\r\n\"'<>(),;:",
                     *kBefore = " \t\r\n\"'<>(),;";  // an address of the net has a path after a colon

bool begins_path(const std::string& text, std::size_t at) {
  return text[at] == '/' && (at == 0 || std::string(kBefore).find(text[at - 1]) != std::string::npos);
}

}  // namespace

std::string without_folders(const std::string& message, const std::filesystem::path& database) {
  std::string text = message;
  if (const std::string folder = database.parent_path().string() + "/"; folder.size() > 1) {
    for (std::size_t at; (at = text.find(folder)) != std::string::npos;) text.erase(at, folder.size());
  }
  for (std::size_t at = 0; at < text.size(); ++at) {
    if (!begins_path(text, at)) continue;
    const std::size_t end = std::min(text.find_first_of(kEnds, at), text.size());
    const std::size_t last = text.rfind('/', end - 1);
    if (last > at) text.erase(at, last + 1 - at);
  }
  return text;
}

}  // namespace trocar::review
