#include "tissue/imaging/dicom/inflate.h"

#include <zlib.h>

#include <algorithm>

#include "haptics/input_error.h"

namespace trocar {
namespace {

constexpr std::size_t kBlock = 65536;
constexpr std::uint64_t kMostOfOneFile = std::uint64_t{256} << 20;

struct Inflater {
  z_stream stream{};
  Inflater() {
    if (inflateInit2(&stream, -MAX_WBITS) != Z_OK) throw EnvironmentError("zlib cannot start");
  }
  ~Inflater() { inflateEnd(&stream); }
  Inflater(const Inflater&) = delete;
  Inflater& operator=(const Inflater&) = delete;
};

[[noreturn]] void refuse(const ByteSource& source, const std::string& what) {
  throw InputError(source.name() + ": damaged DICOM: the deflated data " + what + "; copy or export it again");
}

}  // namespace

std::string inflate_raw(ByteSource& source, std::uint64_t from, InflateBudget& budget) {
  Inflater inflater;
  std::string result, in, out(kBlock, '\0');
  const std::uint64_t most = std::min(kMostOfOneFile, budget.left);
  inflater.stream.avail_out = 1;  // nothing waits to be put out
  for (int state = Z_OK; state != Z_STREAM_END;) {
    if (inflater.stream.avail_in == 0 && inflater.stream.avail_out != 0) {
      const auto count = static_cast<std::size_t>(std::min<std::uint64_t>(kBlock, source.size() - from));
      if (count == 0) refuse(source, "are cut off");
      in = source.bytes(from, count);
      from += count;
      inflater.stream.next_in = reinterpret_cast<Bytef*>(in.data());
      inflater.stream.avail_in = static_cast<uInt>(count);
    }
    inflater.stream.next_out = reinterpret_cast<Bytef*>(out.data());
    inflater.stream.avail_out = static_cast<uInt>(kBlock);
    state = inflate(&inflater.stream, Z_NO_FLUSH);
    if (state != Z_OK && state != Z_STREAM_END && state != Z_BUF_ERROR) refuse(source, "are damaged");
    result.append(out, 0, kBlock - inflater.stream.avail_out);
    if (result.size() > most) refuse(source, "are larger than " + std::to_string(most >> 20) + " MiB, the limit");
  }
  budget.left -= result.size();
  return result;
}

}  // namespace trocar
