#include "trainees/exchange/export/named_uuid.h"

#include <openssl/evp.h>

#include <array>

#include "haptics/input_error.h"

namespace trocar {
namespace {

int nibble(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

/// The 16 bytes of a UUID; "" when it is none.
std::string bytes_of(const std::string& uuid) {
  std::string hex, bytes;
  for (std::size_t i = 0; i < uuid.size(); ++i) {
    const bool dash = i == 8 || i == 13 || i == 18 || i == 23;
    if (dash ? uuid[i] != '-' : nibble(uuid[i]) < 0) return "";
    if (!dash) hex += uuid[i];
  }
  if (hex.size() != 32) return "";
  for (std::size_t i = 0; i < 32; i += 2) bytes += static_cast<char>(nibble(hex[i]) * 16 + nibble(hex[i + 1]));
  return bytes;
}

}  // namespace

std::string named_uuid(const std::string& space, std::string_view name) {
  std::string text = bytes_of(space);
  if (text.empty()) throw InputError("\"" + space + "\" is no UUID");
  text += name;
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
  unsigned int size = 0;
  if (EVP_Digest(text.data(), text.size(), digest.data(), &size, EVP_sha1(), nullptr) != 1) {
    throw EnvironmentError("SHA-1 is not offered by this machine's OpenSSL");
  }
  digest[6] = static_cast<unsigned char>((digest[6] & 0x0F) | 0x50);
  digest[8] = static_cast<unsigned char>((digest[8] & 0x3F) | 0x80);
  std::string out;
  for (std::size_t i = 0; i < 16; ++i) {
    if (i == 4 || i == 6 || i == 8 || i == 10) out += '-';
    out += "0123456789abcdef"[digest[i] >> 4];
    out += "0123456789abcdef"[digest[i] & 15];
  }
  return out;
}

}  // namespace trocar
