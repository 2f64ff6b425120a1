// One rule for every path that a person types and the program writes: its folder has to be there already.
//
// A folder made on the way would hide a typing error, and the record of an attempt would lie where nobody looks. What
// the program chooses itself (the data folder, the folder of recordings beside a database) it makes. Thread: any.
#pragma once

#include <string>

namespace trocar {

/// What is wrong with a path to be written, a file or a folder: empty, or its folder is missing. Empty: nothing.
std::string typed_path_fault(const std::string& path);

}  // namespace trocar
