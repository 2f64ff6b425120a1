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

/// The next compressed bytes. @return false at the end of the file
bool feed(Inflater& inflater, ByteSource& source, std::uint64_t& from, std::string& in) {
  const auto count = static_cast<std::size_t>(std::min<std::uint64_t>(kBlock, source.size() - from));
  in = source.bytes(from, count);
  from += count;
  inflater.stream.next_in = reinterpret_cast<Bytef*>(in.data());
  inflater.stream.avail_in = static_cast<uInt>(count);
  return count > 0;
}

/// "" or why it ended before its end.
std::string run(Inflater& inflater, ByteSource& source, std::uint64_t from, std::uint64_t most, std::string& result) {
  std::string in, out(kBlock, '\0');
  inflater.stream.avail_out = 1;  // nothing waits to be put out
  for (int state = Z_OK; state != Z_STREAM_END;) {
    if (inflater.stream.avail_in == 0 && inflater.stream.avail_out != 0 && !feed(inflater, source, from, in))
      return "are cut off";
    inflater.stream.next_out = reinterpret_cast<Bytef*>(out.data());
    inflater.stream.avail_out = static_cast<uInt>(kBlock);
    state = inflate(&inflater.stream, Z_NO_FLUSH);
    result.append(out, 0, kBlock - inflater.stream.avail_out);
    if (state != Z_OK && state != Z_STREAM_END && state != Z_BUF_ERROR) return "are damaged";
    if (result.size() > most) return "are larger than " + std::to_string(most >> 20) + " MiB, the limit";
  }
  return "";
}

}  // namespace

Inflated inflate_raw(ByteSource& source, std::uint64_t from, InflateBudget& budget) {
  Inflater inflater;
  Inflated result;
  const std::string fault = run(inflater, source, from, std::min(kMostOfOneFile, budget.left), result.bytes);
  budget.left -= std::min<std::uint64_t>(budget.left, result.bytes.size());
  if (!fault.empty())
    result.damage = source.name() + ": damaged DICOM: the deflated data " + fault + "; copy or export it again";
  return result;
}

}  // namespace trocar
