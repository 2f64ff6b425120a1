// Ed25519 signatures (RFC 8032, by libsodium): who holds the seed can sign, everybody can tell whether a signature
// holds. Seeds and public keys are 64, signatures 128 lower-case hexadecimal digits. Thread: any.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace trocar {

class SigningKey {
 public:
  /// From the system's random numbers.
  static SigningKey make();
  /// Nothing when it is no seed.
  static std::optional<SigningKey> of_seed(std::string_view seed);

  const std::string& seed() const { return seed_; }
  const std::string& public_key() const { return public_; }
  std::string sign(std::string_view text) const;

 private:
  SigningKey() = default;
  std::string seed_, public_, secret_;
};

/// False also for what is no public key or no signature.
bool signature_holds(std::string_view public_key, std::string_view text, std::string_view signature);

}  // namespace trocar
