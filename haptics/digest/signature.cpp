#include "haptics/digest/signature.h"

#include <sodium.h>

#include <stdexcept>

namespace trocar {
namespace {

void begin() {
  if (sodium_init() < 0) throw std::runtime_error("libsodium has no random numbers");
}

const unsigned char* bytes_of(std::string_view text) { return reinterpret_cast<const unsigned char*>(text.data()); }

unsigned char* bytes_of(std::string& text) { return reinterpret_cast<unsigned char*>(text.data()); }

std::string hex_of(std::string_view bytes) {
  std::string out(2 * bytes.size() + 1, '\0');
  sodium_bin2hex(out.data(), out.size(), bytes_of(bytes), bytes.size());
  out.pop_back();
  return out;
}

std::optional<std::string> bytes_of_hex(std::string_view hex, std::size_t size) {
  std::string out(size, '\0');
  std::size_t read = 0;
  const int code = sodium_hex2bin(bytes_of(out), size, hex.data(), hex.size(), nullptr, &read, nullptr);
  if (code != 0 || read != size || hex.size() != 2 * size) return std::nullopt;
  return out;
}

}  // namespace

SigningKey SigningKey::make() {
  begin();
  std::string seed(crypto_sign_SEEDBYTES, '\0');
  randombytes_buf(seed.data(), seed.size());
  return *of_seed(hex_of(seed));
}

std::optional<SigningKey> SigningKey::of_seed(std::string_view seed) {
  begin();
  const auto bytes = bytes_of_hex(seed, crypto_sign_SEEDBYTES);
  if (!bytes) return std::nullopt;
  SigningKey key;
  std::string known(crypto_sign_PUBLICKEYBYTES, '\0');
  key.secret_.resize(crypto_sign_SECRETKEYBYTES);
  crypto_sign_seed_keypair(bytes_of(known), bytes_of(key.secret_), bytes_of(*bytes));
  key.seed_ = seed;
  key.public_ = hex_of(known);
  return key;
}

std::string SigningKey::sign(std::string_view text) const {
  std::string out(crypto_sign_BYTES, '\0');
  crypto_sign_detached(bytes_of(out), nullptr, bytes_of(text), text.size(), bytes_of(secret_));
  return hex_of(out);
}

bool signature_holds(std::string_view public_key, std::string_view text, std::string_view signature) {
  begin();
  const auto known = bytes_of_hex(public_key, crypto_sign_PUBLICKEYBYTES);
  const auto signed_by = bytes_of_hex(signature, crypto_sign_BYTES);
  return known && signed_by &&
         crypto_sign_verify_detached(bytes_of(*signed_by), bytes_of(text), text.size(), bytes_of(*known)) == 0;
}

}  // namespace trocar
