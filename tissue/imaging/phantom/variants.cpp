#include <algorithm>

#include "haptics/input_error.h"
#include "tissue/imaging/phantom/phantom.h"

namespace trocar {
namespace {

constexpr std::array<std::string_view, kPhantomVariants.size()> kNames{"normal", "short-duct", "low-insertion", "fat",
                                                                       "artery-anterior"};

}  // namespace

std::string_view phantom_variant_name(PhantomVariant variant) { return kNames.at(static_cast<std::size_t>(variant)); }

PhantomVariant phantom_variant(std::string_view name) {
  const auto found = std::find(kNames.begin(), kNames.end(), name);
  if (found != kNames.end()) return kPhantomVariants.at(static_cast<std::size_t>(found - kNames.begin()));
  std::string known;
  for (const std::string_view each : kNames) known += (known.empty() ? "" : ", ") + std::string(each);
  throw InputError("no phantom variant \"" + std::string(name) + "\"; known: " + known);
}

PhantomVariant phantom_variant_of_seed(std::uint64_t seed) {
  return kPhantomVariants.at(seed % kPhantomVariants.size());
}

}  // namespace trocar
