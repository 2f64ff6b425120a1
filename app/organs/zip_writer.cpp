#include "app/organs/zip_writer.h"

#include <zip.h>

#include <memory>

#include "haptics/input_error.h"

namespace trocar {
namespace {

constexpr zip_uint16_t kDosTime = 0, kDosDate = (1 << 5) | 1;  // 1 January 1980: the earliest that the format knows

[[noreturn]] void fail(const std::string& what) { throw EnvironmentError("the archive cannot be made: " + what); }

struct Archive {
  zip_error_t error{};
  zip_source_t* source = nullptr;
  zip_t* zip = nullptr;

  Archive() {
    zip_error_init(&error);
    source = zip_source_buffer_create(nullptr, 0, 0, &error);
    if (source == nullptr) fail(zip_error_strerror(&error));
    zip_source_keep(source);
    zip = zip_open_from_source(source, ZIP_TRUNCATE, &error);
    if (zip == nullptr) fail(zip_error_strerror(&error));
  }
  ~Archive() {
    if (zip) zip_discard(zip);
    if (source) zip_source_free(source);
    zip_error_fini(&error);
  }
  Archive(const Archive&) = delete;
  Archive& operator=(const Archive&) = delete;
};

void add(Archive& archive, const std::string& name, const std::string& bytes) {
  zip_source_t* content = zip_source_buffer(archive.zip, bytes.data(), bytes.size(), 0);
  if (content == nullptr) fail(zip_strerror(archive.zip));
  const zip_int64_t index = zip_file_add(archive.zip, name.c_str(), content, ZIP_FL_ENC_UTF_8);
  if (index < 0) {
    zip_source_free(content);
    fail(zip_strerror(archive.zip));
  }
  zip_file_set_dostime(archive.zip, static_cast<zip_uint64_t>(index), kDosTime, kDosDate, 0);
}

}  // namespace

std::string zip_bytes(const std::map<std::string, std::string>& files) {
  Archive archive;
  for (const auto& [name, bytes] : files) add(archive, name, bytes);
  if (zip_close(archive.zip) != 0) fail(zip_strerror(archive.zip));
  archive.zip = nullptr;
  if (zip_source_open(archive.source) != 0) fail("it cannot be read back");
  zip_source_seek(archive.source, 0, SEEK_END);
  std::string bytes(static_cast<std::size_t>(zip_source_tell(archive.source)), '\0');
  zip_source_seek(archive.source, 0, SEEK_SET);
  const zip_int64_t got = zip_source_read(archive.source, bytes.data(), bytes.size());
  zip_source_close(archive.source);
  if (got != static_cast<zip_int64_t>(bytes.size())) fail("it cannot be read back");
  return bytes;
}

}  // namespace trocar
