// The files of an organ or a scene that a new one of the same name leaves behind: a lattice, tetrahedra, members that
// it no longer has.
//
// Only what the old manifest named, only beside it; what else lies there is not overwritten. Thread: any.
#pragma once

#include <filesystem>
#include <set>
#include <vector>

namespace trocar {

/// Names of the files that a manifest or a scene, with its members, speaks of; none when there is no such file, or it
/// cannot be read.
std::set<std::string> files_named_by(const std::filesystem::path& manifest);

/// @param before names of what may be replaced in the folder of the manifest
/// @throws InputError naming the first of the targets that is there and may not
void require_not_foreign(const std::filesystem::path& manifest, const std::set<std::string>& before,
                         const std::vector<std::filesystem::path>& targets);

/// Whether a file is a page about the organ that a new page is about: both begin alike, down to the title.
bool is_older_page(const std::filesystem::path& file, const std::string& page);

/// Removes those of `before` that are not in `after`, in the folder of the manifest. @param keep paths that are never
/// removed: inputs
/// @returns names of what was removed
std::vector<std::string> remove_replaced(const std::filesystem::path& manifest, const std::set<std::string>& before,
                                         const std::set<std::string>& after,
                                         const std::vector<std::filesystem::path>& keep);

}  // namespace trocar
