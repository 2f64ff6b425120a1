#include "tests/trainees/desk/print/pdf_reader.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <regex>
#include <stdexcept>

namespace trocar::printed {
namespace {

/// The bytes in a file of their own while it lives.
class PdfFile {
 public:
  explicit PdfFile(const std::string& bytes) {
    std::string name = (std::filesystem::temp_directory_path() / "trocar-pdf-XXXXXX").string();
    const int made = mkstemp(name.data());
    if (made < 0) throw std::runtime_error("no temporary file");
    close(made);
    path_ = name;
    std::ofstream(path_, std::ios::binary) << bytes;
  }
  ~PdfFile() { std::filesystem::remove(path_); }
  PdfFile(const PdfFile&) = delete;
  PdfFile& operator=(const PdfFile&) = delete;

  /// Output of a program called with the file in place of "@".
  std::string said_by(std::string command, const char* errors = " 2>/dev/null") const {
    command.replace(command.find('@'), 1, path_.string());
    FILE* pipe = popen((command + errors).c_str(), "r");
    if (pipe == nullptr) throw std::runtime_error(command);
    std::string out;
    std::array<char, 65536> piece{};
    for (std::size_t count = 0; (count = fread(piece.data(), 1, piece.size(), pipe)) > 0;)
      out.append(piece.data(), count);
    if (pclose(pipe) != 0) throw std::runtime_error(command + ": failed (poppler-utils?)");
    return out;
  }

 private:
  std::filesystem::path path_;
};

/// The slanted words across a page, letter by letter: they are meant to lie under the others.
bool stamped(const WordBox& box) { return box.y1 - box.y0 > 40; }

}  // namespace

std::string squeezed(const std::string& text) { return std::regex_replace(text, std::regex("\\s+"), " "); }

std::string poppler_warnings(const std::string& bytes) {
  const PdfFile file(bytes);
  std::string told;
  for (const char* program : {"pdfinfo @", "pdftotext @ -", "pdftoppm -r 40 @", "pdffonts @"})
    told += file.said_by(program, " 2>&1 >/dev/null");
  return told;
}

ReadPdf read_pdf(const std::string& bytes) {
  const PdfFile file(bytes);
  ReadPdf out;
  const std::string text = file.said_by("pdftotext -layout @ -");
  for (std::size_t from = 0; from < text.size();) {
    const std::size_t to = std::min(text.find('\f', from), text.size());
    out.pages.push_back(text.substr(from, to - from));
    from = to + 1;
  }
  // Reading order beside it: words of a cell that go over lines stand together there.
  out.all = squeezed(text) + " " + squeezed(file.said_by("pdftotext @ -"));
  out.info = file.said_by("pdfinfo @");
  out.fonts = file.said_by("pdffonts @");
  return out;
}

std::vector<WordBox> word_boxes(const std::string& bytes) {
  const std::string text = PdfFile(bytes).said_by("pdftotext -bbox @ -");
  const std::regex pattern(
      "<page |<word xMin=\"([-0-9.]+)\" yMin=\"([-0-9.]+)\" xMax=\"([-0-9.]+)\" yMax=\"([-0-9.]+)\">([^<]*)<");
  std::vector<WordBox> out;
  int page = -1;
  for (std::sregex_iterator it(text.begin(), text.end(), pattern), end; it != end; ++it) {
    if (!(*it)[1].matched)
      ++page;
    else
      out.push_back(
          {page, std::stod((*it)[1]), std::stod((*it)[2]), std::stod((*it)[3]), std::stod((*it)[4]), (*it)[5]});
  }
  return out;
}

std::vector<std::string> collisions(const std::string& bytes) {
  std::vector<std::string> out;
  const std::vector<WordBox> words = word_boxes(bytes);
  for (std::size_t i = 0; i < words.size(); ++i)
    for (std::size_t k = i + 1; k < words.size() && words[k].page == words[i].page; ++k) {
      const WordBox &a = words[i], &b = words[k];
      // A box is as high as the font's tallest letter: the letters themselves fill the middle.
      const double wide = std::min(a.x1, b.x1) - std::max(a.x0, b.x0),
                   high = std::min(a.y1, b.y1) - std::max(a.y0, b.y0);
      const double least = std::min(a.y1 - a.y0, b.y1 - b.y0);
      if (wide > 0.8 && high > 0.34 * least && !stamped(a) && !stamped(b))
        out.push_back("page " + std::to_string(a.page + 1) + ": " + a.words + " / " + b.words);
    }
  return out;
}

std::vector<std::string> outside(const std::string& bytes, double margin) {
  std::vector<std::string> out;
  for (const WordBox& w : word_boxes(bytes))
    if (!stamped(w) && (w.x0 < margin || w.x1 > 595.3 - margin || w.y0 < margin || w.y1 > 841.9 - margin))
      out.push_back("page " + std::to_string(w.page + 1) + ": " + w.words);
  return out;
}

}  // namespace trocar::printed
