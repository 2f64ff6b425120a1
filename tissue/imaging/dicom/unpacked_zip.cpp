#include "tissue/imaging/dicom/unpacked_zip.h"

#include <fcntl.h>
#include <unistd.h>
#include <zip.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <memory>
#include <string_view>

#include "haptics/input_error.h"
#include "tissue/imaging/child_process.h"
#include "tissue/imaging/dicom/byte_source.h"

namespace trocar {
namespace {

constexpr std::size_t kZipBlock = 65536;

struct CloseArchive {
  void operator()(zip_t* archive) const { zip_discard(archive); }
};
struct CloseEntry {
  void operator()(zip_file_t* entry) const { zip_fclose(entry); }
};
using Archive = std::unique_ptr<zip_t, CloseArchive>;
using Entry = std::unique_ptr<zip_file_t, CloseEntry>;

std::string printable_name(const char* name) {
  std::string text = name != nullptr ? std::string(name).substr(0, 200) : "";
  for (char& letter : text)
    if (static_cast<unsigned char>(letter) < ' ' || letter == 127) letter = '?';
  return text;
}

bool may_be_dicom(std::string_view start) {
  if (start.size() >= 132 && start.substr(128, 4) == "DICM") return true;
  return start.size() >= 8 && start[0] == 8 && start[1] == 0 && start[3] == 0;
}

/// Runs in the child: nothing of it outlives the process but the files that it writes.
class Unpacking {
 public:
  Unpacking(std::string name, const std::filesystem::path& folder, const ZipLimits& limits, std::uint64_t archive_bytes,
            UnpackedZip::Wanted wanted)
      : name_(std::move(name)),
        wanted_(std::move(wanted)),
        folder_(folder),
        limits_(limits),
        most_(limits.free_bytes + limits.ratio * archive_bytes) {}

  /// One line a file: number in the folder, space, name in the archive.
  std::string unpack(const std::filesystem::path& file) {
    int error = 0;
    const Archive archive(zip_open(file.c_str(), ZIP_RDONLY, &error));
    if (!archive) refuse("is damaged, or no zip archive");
    const zip_int64_t count = zip_get_num_entries(archive.get(), 0);
    if (static_cast<std::uint64_t>(count) > limits_.entries)
      refuse("holds " + std::to_string(count) + " files: more than " + std::to_string(limits_.entries));
    for (zip_int64_t n = 0; n < count; ++n) unpack_entry(archive.get(), static_cast<zip_uint64_t>(n));
    return list_;
  }

 private:
  [[noreturn]] void refuse(const std::string& what) const { throw InputError(name_ + ": the archive " + what); }

  void unpack_entry(zip_t* archive, zip_uint64_t index) {
    zip_stat_t facts;
    if (zip_stat_index(archive, index, 0, &facts) != 0) refuse("is damaged");
    const std::string entry_name = printable_name(facts.name);
    if (entry_name.empty() || entry_name.back() == '/') return;
    if ((facts.valid & ZIP_STAT_ENCRYPTION_METHOD) != 0 && facts.encryption_method != ZIP_EM_NONE)
      refuse("is encrypted: unpack it with its password and give the folder");
    const Entry entry(zip_fopen_index(archive, index, 0));
    if (!entry) refuse("holds a file that cannot be unpacked (" + std::string(zip_strerror(archive)) + ")");
    if (!wanted_ || wanted_(entry_name)) copy_entry(entry.get(), index, entry_name);
  }

  std::size_t read_block(zip_file_t* entry) {
    std::size_t filled = 0;
    while (filled < kZipBlock) {
      const zip_int64_t got = zip_fread(entry, block_.data() + filled, kZipBlock - filled);
      if (got < 0) refuse("is damaged: a file in it cannot be unpacked");
      if (got == 0) break;
      filled += static_cast<std::size_t>(got);
    }
    all_ += filled;
    if (all_ > limits_.all_bytes)
      refuse("unpacks to more than " + std::to_string(limits_.all_bytes >> 20) + " MiB, the limit");
    if (all_ > most_)
      refuse("unpacks to more than " + std::to_string(limits_.ratio) + " times its size, as no scan does");
    return filled;
  }

  void copy_entry(zip_file_t* entry, zip_uint64_t index, const std::string& entry_name) {
    std::size_t count = read_block(entry);
    if (!wanted_ && !may_be_dicom({block_.data(), count})) return;
    std::ofstream out(folder_ / std::to_string(index), std::ios::binary);
    for (std::uint64_t written = 0; count > 0; count = read_block(entry)) {
      if ((written += count) > limits_.file_bytes)
        refuse("holds a file above " + std::to_string(limits_.file_bytes >> 20) + " MiB, the limit");
      if (!out.write(block_.data(), static_cast<std::streamsize>(count)))
        refuse("does not fit into the temporary folder");
    }
    if (!out.flush()) refuse("does not fit into the temporary folder");
    list_ += std::to_string(index) + " " + entry_name + "\n";
  }

  std::string name_;
  UnpackedZip::Wanted wanted_;
  std::filesystem::path folder_;
  ZipLimits limits_;
  std::uint64_t most_, all_ = 0;
  std::vector<char> block_ = std::vector<char>(kZipBlock);
  std::string list_;
};

}  // namespace

UnpackedZip::Folder::Folder() {
  std::error_code error;
  std::string pattern = (std::filesystem::temp_directory_path(error) / "trocar-zip-XXXXXX").string();
  if (error || mkdtemp(pattern.data()) == nullptr)
    throw EnvironmentError("no temporary folder can be made for a zip archive");
  path = pattern;
}

UnpackedZip::Folder::~Folder() {
  std::error_code ignored;
  std::filesystem::remove_all(path, ignored);
}

UnpackedZip::UnpackedZip(const std::filesystem::path& archive, const ZipLimits& limits, const Progress& progress,
                         const Wanted& wanted) {
  const std::string name = archive.string();
  const std::uint64_t bytes = ByteSource(archive, name).size();
  report(progress, "unpacking", -1);
  const std::string list = in_child(name, ChildLimits{}, progress, [&] {
    return Unpacking(name, folder_.path, limits, bytes, wanted).unpack(archive);
  });
  for (std::size_t from = 0; from < list.size();) {
    const std::size_t space = list.find(' ', from), end = list.find('\n', from);
    files_.push_back({folder_.path / list.substr(from, space - from), list.substr(space + 1, end - space - 1)});
    from = end + 1;
  }
  std::stable_sort(files_.begin(), files_.end(), [](const File& a, const File& b) { return a.name < b.name; });
  for (File& file : files_) file.name.erase(0, file.name.rfind('/') + 1);  // folders are often called like the patient
}

UnpackedZip::~UnpackedZip() = default;

std::vector<std::string> names_in_zip(const std::filesystem::path& archive, const Progress& progress) {
  const std::string list = in_child(archive.string(), ChildLimits{}, progress, [&] {
    int error = 0;
    const Archive opened(zip_open(archive.c_str(), ZIP_RDONLY, &error));
    if (!opened) throw InputError(archive.string() + ": the archive is damaged, or no zip archive");
    const zip_int64_t most = std::min<zip_int64_t>(zip_get_num_entries(opened.get(), 0), ZipLimits{}.entries);
    std::string names;
    for (zip_int64_t n = 0; n < most; ++n)
      names += printable_name(zip_get_name(opened.get(), static_cast<zip_uint64_t>(n), 0)) + "\n";
    return names;
  });
  std::vector<std::string> names;
  for (std::size_t from = 0; from < list.size();) {
    const std::size_t end = list.find('\n', from);
    if (end > from && list[end - 1] != '/') names.push_back(list.substr(from, end - from));
    from = end + 1;
  }
  return names;
}

bool is_zip(const std::filesystem::path& file) {
  ByteSource source(file, file.string());
  std::array<char, 4> start{};
  return source.read(0, start.data(), start.size()) &&
         (start == std::array<char, 4>{'P', 'K', 3, 4} || start == std::array<char, 4>{'P', 'K', 5, 6});
}

}  // namespace trocar
