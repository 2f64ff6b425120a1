#include "tissue/mesh/files/organ_sizes.h"

#include <array>
#include <cctype>

namespace trocar {

std::string OrganSize::with_article() const { return (name.front() == 'a' ? "an " : "a ") + std::string(name); }

std::optional<OrganSize> organ_size(const std::string& text) {
  // Longer names before those that they hold: gallbladder before bladder, and vessels of an organ before the organ.
  constexpr std::array<OrganSize, 21> kSizes{{{"hepatic vein", 40, 260},    {"portal vein", 40, 260},
                                              {"artery", 20, 500, "arter"}, {"vein", 20, 500},
                                              {"biliary", 20, 250},         {"duct", 10, 250},
                                              {"tumour", 5, 300},           {"cyst", 5, 300},
                                              {"gallbladder", 30, 130},     {"urinary bladder", 35, 220},
                                              {"bladder", 35, 220},         {"liver", 150, 300},
                                              {"spleen", 60, 220},          {"kidney", 70, 170},
                                              {"pancreas", 80, 230},        {"stomach", 100, 350},
                                              {"adrenal", 15, 80},          {"large intestine", 200, 550},
                                              {"colon", 200, 550},          {"small intestine", 120, 450},
                                              {"ureter", 120, 380}}};
  std::string plain;
  for (const char letter : text)
    plain += letter == '_' || letter == '-' || letter == '.'
                 ? ' '
                 : static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
  for (const OrganSize& size : kSizes)
    if (plain.find(size.found_by.empty() ? size.name : size.found_by) != std::string::npos) return size;
  return std::nullopt;
}

}  // namespace trocar
