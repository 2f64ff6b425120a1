// The moment as a part of a file's name: "20261122-125703", local time. For pictures and exports. Thread: any.
#pragma once

#include <string>

namespace trocar {

std::string file_stamp();

}  // namespace trocar
