#include "haptics/digest/digest.h"

#include <openssl/evp.h>

#include <array>
#include <fstream>

#include "haptics/input_error.h"

namespace trocar::digest {
namespace {

struct FreeContext {
  void operator()(EVP_MD_CTX* context) const { EVP_MD_CTX_free(context); }
};

void require(int ok) {
  if (ok != 1) throw EnvironmentError("OpenSSL cannot compute SHA-256");
}

std::string to_hex(const unsigned char* bytes, unsigned size) {
  constexpr char kDigits[] = "0123456789abcdef";
  std::string text;
  for (unsigned i = 0; i < size; ++i) {
    text += kDigits[bytes[i] >> 4];
    text += kDigits[bytes[i] & 15];
  }
  return text;
}

}  // namespace

struct Stream::Context {
  std::unique_ptr<EVP_MD_CTX, FreeContext> evp{EVP_MD_CTX_new()};
};

Stream::Stream() : context_(std::make_unique<Context>()) {
  require(EVP_DigestInit_ex(context_->evp.get(), EVP_sha256(), nullptr));
}
Stream::~Stream() = default;
Stream::Stream(Stream&&) noexcept = default;
Stream& Stream::operator=(Stream&&) noexcept = default;

void Stream::update(std::string_view bytes) {
  require(EVP_DigestUpdate(context_->evp.get(), bytes.data(), bytes.size()));
}

std::string Stream::hex() const {
  const std::unique_ptr<EVP_MD_CTX, FreeContext> copy(EVP_MD_CTX_new());
  require(EVP_MD_CTX_copy_ex(copy.get(), context_->evp.get()));
  std::array<unsigned char, EVP_MAX_MD_SIZE> bytes{};
  unsigned size = 0;
  require(EVP_DigestFinal_ex(copy.get(), bytes.data(), &size));
  return to_hex(bytes.data(), size);
}

std::string of_bytes(std::string_view bytes) {
  Stream stream;
  stream.update(bytes);
  return stream.hex();
}

std::string of_file(const std::filesystem::path& file) {
  std::error_code error;
  const bool ends = std::filesystem::is_regular_file(file, error);  // a pipe or a device need not
  std::ifstream in;
  if (ends) in.open(file, std::ios::binary);
  if (!ends || !in) throw InputError(file.string() + ": cannot be opened for reading");
  Stream stream;
  std::array<char, 65536> block{};
  while (in.read(block.data(), block.size()) || in.gcount() > 0) {
    stream.update({block.data(), static_cast<std::size_t>(in.gcount())});
  }
  if (in.bad()) throw InputError(file.string() + ": cannot be read");
  return stream.hex();
}

std::string of_readable_file(const std::filesystem::path& file) {
  try {
    return of_file(file);
  } catch (const InputError&) {
    return "";
  }
}

}  // namespace trocar::digest
