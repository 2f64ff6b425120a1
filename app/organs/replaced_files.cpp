#include "app/organs/replaced_files.h"

#include <algorithm>

#include "haptics/input_error.h"
#include "tissue/organ/organ_manifest.h"
#include "tissue/organ/organ_set.h"

namespace trocar {

std::set<std::string> files_named_by(const std::filesystem::path& manifest) {
  const std::string file = manifest.string();
  try {
    if (!file.ends_with(kOrganSetSuffix)) {
      const std::vector<std::string> names = files_beside(parse_manifest(read_bytes(manifest), file));
      return {names.begin(), names.end()};
    }
    const OrganSet set = parse_organ_set(read_bytes(manifest), file);
    std::set<std::string> names(set.more_files.begin(), set.more_files.end());
    for (const std::string& member : set.files) {
      names.insert(member);
      names.merge(files_named_by(manifest.parent_path() / member));
    }
    return names;
  } catch (const InputError&) {
    return {};  // what cannot be understood is left alone
  }
}

void require_not_foreign(const std::filesystem::path& manifest, const std::set<std::string>& before,
                         const std::vector<std::filesystem::path>& targets) {
  std::error_code none;
  for (const std::filesystem::path& target : targets) {
    const bool own = target.parent_path() == manifest.parent_path() && before.contains(target.filename().string());
    if (!own && std::filesystem::exists(target, none))
      throw InputError(target.string() + ": is there already; it is not overwritten");
  }
}

bool is_older_page(const std::filesystem::path& file, const std::string& page) {
  constexpr std::string_view kTitleEnds = "</title>";
  const std::size_t end = page.find(kTitleEnds);
  std::error_code none;
  if (end == std::string::npos || !std::filesystem::is_regular_file(file, none)) return false;
  return read_bytes(file).starts_with(page.substr(0, end + kTitleEnds.size()));
}

std::vector<std::string> remove_replaced(const std::filesystem::path& manifest, const std::set<std::string>& before,
                                         const std::set<std::string>& after,
                                         const std::vector<std::filesystem::path>& keep) {
  std::vector<std::string> removed;
  for (const std::string& name : before) {
    const std::filesystem::path path = manifest.parent_path() / name;
    std::error_code error;
    const bool wanted =
        after.contains(name) || std::any_of(keep.begin(), keep.end(), [&](const std::filesystem::path& one) {
          return std::filesystem::equivalent(one, path, error);
        });
    if (!wanted && std::filesystem::is_regular_file(path, error) && std::filesystem::remove(path, error))
      removed.push_back(name);
  }
  return removed;
}

}  // namespace trocar
