#include "tissue/library_versions.h"

namespace trocar {

std::vector<std::pair<std::string, std::string>> library_versions() {
  return {{"CGAL", TROCAR_CGAL_VERSION},
          {"ITK", TROCAR_ITK_VERSION},
          {"assimp", TROCAR_ASSIMP_VERSION},
          {"Eigen", TROCAR_EIGEN_VERSION}};
}

}  // namespace trocar
