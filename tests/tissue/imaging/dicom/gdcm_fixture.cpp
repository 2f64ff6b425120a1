#include "tests/tissue/imaging/dicom/gdcm_fixture.h"

#include <gdcmImageChangeTransferSyntax.h>
#include <gdcmImageReader.h>
#include <gdcmImageWriter.h>
#include <gtest/gtest.h>

#include <sstream>

namespace trocar::test {

std::string compressed(const std::string& file, const std::string& syntax) {
  std::istringstream in(file);
  gdcm::ImageReader reader;
  reader.SetStream(in);
  EXPECT_TRUE(reader.Read());
  gdcm::ImageChangeTransferSyntax change;
  change.SetTransferSyntax(gdcm::TransferSyntax(gdcm::TransferSyntax::GetTSType(syntax.c_str())));
  change.SetInput(reader.GetImage());
  EXPECT_TRUE(change.Change());
  std::ostringstream out;
  gdcm::ImageWriter writer;
  writer.SetFile(reader.GetFile());
  writer.SetImage(change.GetOutput());
  writer.SetStream(out);
  EXPECT_TRUE(writer.Write());
  return out.str();
}

}  // namespace trocar::test
