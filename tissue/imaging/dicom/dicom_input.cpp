#include "tissue/imaging/dicom/dicom_input.h"

#include <algorithm>
#include <cctype>
#include <optional>
#include <set>

#include "haptics/input_error.h"
#include "tissue/imaging/dicom/dicom_elements.h"
#include "tissue/imaging/dicom/dicom_tags.h"
#include "tissue/organ/file_lock.h"

namespace trocar {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostFiles = 100000;

/// The path that a DICOMDIR record names ("A\B\C"); nullopt when it would leave the folder.
std::optional<fs::path> relative_path(const std::string& text, bool lower) {
  fs::path path;
  for (std::size_t from = 0; from <= text.size();) {
    const std::size_t to = std::min(text.find('\\', from), text.size());
    std::string part = text.substr(from, to - from);
    if (part.empty() || part == "." || part == ".." || part.size() > 64 || part.find('/') != std::string::npos)
      return {};
    if (lower)
      std::transform(part.begin(), part.end(), part.begin(),
                     [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    path /= part;
    from = to + 1;
  }
  return path;
}

/// The file that a record names, when it exists and lies below `root` with every link resolved.
std::optional<fs::path> named_file(const fs::path& root, const std::string& text) {
  for (const bool lower : {false, true}) {
    const auto relative = relative_path(text, lower);
    std::error_code error;
    if (!relative || !fs::is_regular_file(root / *relative, error)) continue;
    const fs::path real = fs::weakly_canonical(root / *relative, error), real_root = fs::weakly_canonical(root, error);
    const auto [end, unused] = std::mismatch(real_root.begin(), real_root.end(), real.begin(), real.end());
    if (end == real_root.end()) return root / *relative;
  }
  return {};
}

}  // namespace

void DicomInput::walk(const fs::path& folder) {
  std::error_code error;
  auto entry = fs::recursive_directory_iterator(folder, fs::directory_options::skip_permission_denied, error);
  if (error) throw InputError(name_ + ": the folder cannot be read: " + error.message());
  for (; entry != fs::recursive_directory_iterator(); entry.increment(error)) {
    if (error) throw InputError(name_ + ": the folder cannot be read: " + error.message());
    if (!entry->is_regular_file(error) || is_name_lock(entry->path())) continue;
    if (files_.size() >= kMostFiles)
      throw InputError(name_ + ": holds more than " + std::to_string(kMostFiles) + " files");
    files_.push_back({entry->path(), entry->path().string()});
  }
  std::sort(files_.begin(), files_.end(), [](const File& a, const File& b) { return a.name < b.name; });
}

void DicomInput::unpack(const fs::path& archive, const Progress& progress) {
  zip_ = std::make_unique<UnpackedZip>(archive, ZipLimits{}, progress);
  for (const UnpackedZip::File& file : zip_->files()) files_.push_back({file.path, name_ + ": " + file.name});
}

bool DicomInput::follow_directory(const fs::path& file) {
  InflateBudget budget;
  const auto elements = read_dicom_elements(file, name_, budget);
  const DicomElement* records = elements ? elements->data.find(tag::kDirectoryRecords) : nullptr;
  if (records == nullptr) return false;
  if (!elements->damage.empty()) throw InputError(elements->damage + ", or give the folder in which the DICOMDIR lies");
  std::set<fs::path> found;  // ordered: the result does not depend on the order of the records
  std::size_t named = 0, missing = 0;
  for (const DicomItem& record : records->items) {
    const std::string text = record.text(tag::kReferencedFile);
    if (text.empty()) continue;
    ++named;
    const auto path = named_file(file.parent_path(), text);
    if (path) found.insert(*path);
    missing += path ? 0 : 1;
  }
  if (found.empty())
    throw InputError(name_ + ": this DICOMDIR names " + std::to_string(named) +
                     " files, none of which lies beside it; " + "give the whole disc or folder");
  if (missing > 0)
    notes_.push_back("The DICOMDIR names " + std::to_string(named) + " files, of which " + std::to_string(missing) +
                     " are not there.");
  for (const fs::path& path : found) files_.push_back({path, path.string()});
  return true;
}

DicomInput::DicomInput(const fs::path& input, const Progress& progress) : name_(input.string()) {
  std::error_code error;
  if (!fs::exists(input, error)) throw InputError(name_ + ": does not exist");
  if (fs::is_directory(input, error)) {
    walk(input);
  } else if (is_zip(input)) {
    unpack(input, progress);
  } else if (!follow_directory(input)) {
    single_ = true;
    files_.push_back({input, name_});
  }
}

}  // namespace trocar
