// Versions of the libraries that an import's result depends on, as found when the program was built. Thread: any.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace trocar {

/// Pairs of name and version: CGAL, ITK (which brings GDCM), assimp, Eigen.
std::vector<std::pair<std::string, std::string>> library_versions();

}  // namespace trocar
