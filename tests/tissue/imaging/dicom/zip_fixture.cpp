#include "tests/tissue/imaging/dicom/zip_fixture.h"

#include <gtest/gtest.h>
#include <zip.h>

namespace trocar::test {

std::filesystem::path write_zip(const std::filesystem::path& path,
                                const std::vector<std::pair<std::string, std::string>>& files,
                                const std::string& password) {
  int error = 0;
  zip_t* archive = zip_open(path.c_str(), ZIP_CREATE | ZIP_TRUNCATE, &error);
  EXPECT_NE(archive, nullptr);
  for (const auto& [name, bytes] : files) {
    zip_source_t* source = zip_source_buffer(archive, bytes.data(), bytes.size(), 0);
    const zip_int64_t index = zip_file_add(archive, name.c_str(), source, ZIP_FL_ENC_UTF_8);
    EXPECT_GE(index, 0) << name;
    zip_file_set_mtime(archive, static_cast<zip_uint64_t>(index), 1000000000, 0);  // same bytes every time
    if (!password.empty())
      zip_file_set_encryption(archive, static_cast<zip_uint64_t>(index), ZIP_EM_AES_256, password.c_str());
  }
  EXPECT_EQ(zip_close(archive), 0);
  return path;
}

}  // namespace trocar::test
