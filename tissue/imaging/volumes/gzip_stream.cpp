#include "tissue/imaging/volumes/gzip_stream.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <vector>

#include "haptics/input_error.h"

namespace trocar {

void GzipStream::Close::operator()(void* file) const { gzclose(static_cast<gzFile>(file)); }

GzipStream::GzipStream(const std::filesystem::path& path) : name_(path.string()) {
  if (!std::filesystem::is_regular_file(path)) throw InputError(name_ + ": no such file");
  std::ifstream probe(path, std::ios::binary);
  std::array<char, 2> signature{};
  probe.read(signature.data(), signature.size());
  gzip_ = probe.gcount() == 2 && signature[0] == '\x1f' && signature[1] == '\x8b';
  file_.reset(gzopen(name_.c_str(), "rb"));
  if (!file_) throw InputError(name_ + ": cannot be opened");
}

std::size_t GzipStream::read(unsigned char* into, std::size_t count) {
  std::size_t done = 0;
  auto* file = static_cast<gzFile>(file_.get());
  while (done < count) {
    const auto block = static_cast<unsigned>(std::min<std::size_t>(count - done, 1 << 20));
    const int got = gzread(file, into + done, block);
    int code = Z_OK;
    const char* message = gzerror(file, &code);
    if (got < 0 || (code != Z_OK && code != Z_STREAM_END))
      throw InputError(name_ + ": data: damaged gzip stream (" + message + ")");
    if (got == 0) break;
    done += static_cast<std::size_t>(got);
  }
  return done;
}

void GzipStream::finish_member() {
  unsigned char beyond = 0;
  read(&beyond, 1);  // one step further: zlib compares the checksum at the end of the member
}

std::string gzip_compressed(const std::string& bytes) {
  z_stream stream{};
  constexpr int kGzipWrapper = 16;
  if (deflateInit2(&stream, Z_BEST_COMPRESSION, Z_DEFLATED, MAX_WBITS + kGzipWrapper, 8, Z_DEFAULT_STRATEGY) != Z_OK)
    throw EnvironmentError("zlib cannot compress");
  std::string packed(deflateBound(&stream, static_cast<uLong>(bytes.size())), '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = reinterpret_cast<Bytef*>(packed.data());
  stream.avail_out = static_cast<uInt>(packed.size());
  const int result = deflate(&stream, Z_FINISH);
  packed.resize(stream.total_out);
  deflateEnd(&stream);
  if (result != Z_STREAM_END) throw EnvironmentError("zlib cannot compress");
  return packed;
}

}  // namespace trocar
