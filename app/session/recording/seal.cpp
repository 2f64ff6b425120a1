#include "app/session/recording/seal.h"

#include <nlohmann/json.hpp>

#include "haptics/digest/digest.h"

namespace trocar {

std::string link_text(std::string_view hash) { return "trocar-recording-1\n" + std::string(hash); }

std::string make_link(std::string_view before, std::string_view bytes, const std::optional<SigningKey>& key) {
  digest::Stream all;
  all.update(before);
  all.update(bytes);
  const std::string hash = all.hex();
  return key ? hash + key->sign(link_text(hash)) : hash;
}

std::string attempt_field(const std::string& attempt, const std::string& name) {
  const auto json = nlohmann::json::parse(attempt, nullptr, false);
  const auto found = json.is_object() ? json.find(name) : json.end();
  return found != json.end() && found->is_string() ? found->get<std::string>() : "";
}

}  // namespace trocar
