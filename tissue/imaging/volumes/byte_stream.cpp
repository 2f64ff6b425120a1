#include "tissue/imaging/volumes/byte_stream.h"

#include <zlib.h>

#include <algorithm>
#include <fstream>
#include <string>
#include <vector>

#include "haptics/input_error.h"

namespace trocar {
namespace {

class PlainBytes final : public ByteStream {
 public:
  PlainBytes(const std::filesystem::path& path, std::uint64_t offset) : name_(path.string()) {
    if (!std::filesystem::is_regular_file(path)) throw InputError(name_ + ": no such file");
    file_.open(path, std::ios::binary);
    if (!file_) throw InputError(name_ + ": cannot be opened");
    file_.seekg(static_cast<std::streamoff>(offset));
  }

  std::size_t read(unsigned char* into, std::size_t count) override {
    file_.read(reinterpret_cast<char*>(into), static_cast<std::streamsize>(count));
    if (file_.bad()) throw InputError(name_ + ": data: the file cannot be read to its end");
    return static_cast<std::size_t>(file_.gcount());
  }

  const std::string& name() const { return name_; }

 private:
  std::string name_;
  std::ifstream file_;
};

class InflatedBytes final : public ByteStream {
 public:
  InflatedBytes(const std::filesystem::path& path, std::uint64_t offset) : packed_(path, offset), input_(1 << 16) {
    constexpr int kGzipOrZlib = 32;
    if (inflateInit2(&stream_, MAX_WBITS + kGzipOrZlib) != Z_OK) throw EnvironmentError("zlib cannot inflate");
  }
  ~InflatedBytes() override { inflateEnd(&stream_); }
  InflatedBytes(const InflatedBytes&) = delete;
  InflatedBytes& operator=(const InflatedBytes&) = delete;

  std::size_t read(unsigned char* into, std::size_t count) override {
    std::size_t done = 0;
    while (done < count && !ended_) {
      const auto room = static_cast<uInt>(std::min<std::size_t>(count - done, 1 << 20));
      stream_.next_out = into + done;
      stream_.avail_out = room;
      step();
      done += room - stream_.avail_out;
    }
    return done;
  }

 private:
  void step() {
    if (stream_.avail_in == 0 && !refill()) damaged("it ends early");
    const int code = inflate(&stream_, Z_NO_FLUSH);
    if (code == Z_STREAM_END)
      next_member();
    else if (code != Z_OK)
      damaged(stream_.msg != nullptr ? stream_.msg : "it cannot be inflated");
  }

  /// Another gzip member may follow; anything else behind the stream is not part of it.
  void next_member() {
    if (stream_.avail_in == 0) refill();
    if (stream_.avail_in > 0 && *stream_.next_in == 0x1f)
      inflateReset(&stream_);
    else
      ended_ = true;
  }

  bool refill() {
    stream_.next_in = input_.data();
    stream_.avail_in = static_cast<uInt>(packed_.read(input_.data(), input_.size()));
    return stream_.avail_in > 0;
  }

  [[noreturn]] void damaged(const std::string& why) const {
    throw InputError(packed_.name() + ": data: damaged gzip stream (" + why + ")");
  }

  PlainBytes packed_;
  std::vector<unsigned char> input_;
  z_stream stream_{};
  bool ended_ = false;
};

}  // namespace

std::unique_ptr<ByteStream> open_plain(const std::filesystem::path& path, std::uint64_t offset) {
  return std::make_unique<PlainBytes>(path, offset);
}

std::unique_ptr<ByteStream> open_deflated(const std::filesystem::path& path, std::uint64_t offset) {
  return std::make_unique<InflatedBytes>(path, offset);
}

}  // namespace trocar
