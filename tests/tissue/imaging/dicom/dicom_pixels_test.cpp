// Stored bytes to values: bits, signs, byte orders and compressed syntaxes; what is damaged or not an image is refused.
#include <gtest/gtest.h>

#include "tests/tissue/imaging/dicom/dicom_folder.h"
#include "tests/tissue/imaging/dicom/gdcm_fixture.h"
#include "tissue/imaging/dicom/dicom_pixels.h"

namespace trocar::test::dicom_pixels_test {
namespace {

constexpr const char *kJpegBaseline = "1.2.840.10008.1.2.4.50", *kJpegLossless = "1.2.840.10008.1.2.4.70",
                     *kJpegProcess14 = "1.2.840.10008.1.2.4.57", *kJpegLs = "1.2.840.10008.1.2.4.80",
                     *kJpeg2000 = "1.2.840.10008.1.2.4.90";

void expect_reads(const std::vector<SliceFixture>& slices,
                  const std::function<std::string(const SliceFixture&)>& file) {
  const DicomFolder folder;
  for (std::size_t n = 0; n < slices.size(); ++n) folder.write(std::to_string(n), file(slices[n]));
  expect_holds(folder.read(), slices);
}

TEST(DicomPixels, EveryNativeEncodingGivesTheSameValues) {
  for (const Encoding encoding : {Encoding::kExplicit, Encoding::kImplicit, Encoding::kBigEndian, Encoding::kDeflated})
    for (const int allocated : {8, 16, 32}) {
      SliceFixture like;
      like.encoding = encoding, like.allocated = like.stored = allocated, like.is_signed = false, like.columns = 5,
      like.rows = 3;
      auto slices = stack_of(3, 1, like);
      for (SliceFixture& slice : slices) slice.value = [](int i, int j) { return 50 + 7 * i + 31 * j; };
      expect_reads(slices, [](const SliceFixture& slice) { return slice.file(); });
    }
}

TEST(DicomPixels, StoredBitsAndSignDecideTheValue) {
  const auto one = [](int raw, int allocated, int stored, int high, bool sign) {
    std::string bytes;
    for (int n = 0; n < allocated / 8; ++n) bytes += static_cast<char>(static_cast<unsigned>(raw) >> 8 * n & 0xFF);
    return unpacked(bytes, {allocated, stored, high, sign}).at(0);
  };
  EXPECT_EQ(one(0x0FFF, 16, 12, 11, false), 4095);
  EXPECT_EQ(one(0x0FFF, 16, 12, 11, true), -1);
  EXPECT_EQ(one(0x0800, 16, 12, 11, true), -2048);
  EXPECT_EQ(one(0xA7FF, 16, 12, 11, true), 2047) << "bits above the stored ones (overlays) do not count";
  EXPECT_EQ(one(0x0FF0, 16, 8, 11, false), 255) << "stored bits that do not begin at the lowest";
  EXPECT_EQ(one(0xFFFF, 16, 16, 15, true), -1);
  EXPECT_EQ(one(0x80, 8, 8, 7, true), -128);
  EXPECT_EQ(one(0xFF, 8, 8, 7, false), 255);
  EXPECT_EQ(one(-5, 32, 32, 31, true), -5);
}

TEST(DicomPixels, RescaleIsAppliedFileByFile) {
  auto slices = stack_of(4, 2);
  for (std::size_t k = 0; k < slices.size(); ++k)
    slices[k].slope = 0.5 + static_cast<double>(k), slices[k].intercept = -10.0 * static_cast<double>(k);
  expect_reads(slices, [](const SliceFixture& slice) { return slice.file(); });
}

TEST(DicomPixels, ACtWithoutRescaleSaysSo) {
  const DicomFolder folder;
  SliceFixture like;
  like.rescale = false;
  const auto slices = stack_of(3, 2, like);
  folder.write_all(slices);
  const ImageVolume volume = folder.read();
  expect_holds(volume, slices);
  ASSERT_EQ(volume.notes.size(), 1U);
  EXPECT_CONTAINS(volume.notes[0], "no rescale slope");
}

TEST(DicomPixels, Monochrome1KeepsItsValues) {
  const DicomFolder folder;
  SliceFixture like;
  like.photometric = "MONOCHROME1", like.modality = "MR", like.rescale = false;
  const auto slices = stack_of(3, 2, like);
  folder.write_all(slices);
  const ImageVolume volume = folder.read();
  EXPECT_EQ(volume.modality, "MR");
  expect_holds(volume, slices);
  EXPECT_CONTAINS(volume.notes.at(0), "MONOCHROME1");
}

struct Compressed {
  const char* name;
  const char* syntax;
  int allocated, stored;
  bool is_signed;
};

class DicomCompressed : public ::testing::TestWithParam<Compressed> {};

TEST_P(DicomCompressed, LosslessSyntaxesGiveTheSameValues) {
  const Compressed& how = GetParam();
  SliceFixture like;
  like.columns = 33, like.rows = 21;
  like.allocated = how.allocated, like.stored = how.stored, like.is_signed = how.is_signed;
  auto slices = stack_of(3, 2, like);
  for (std::size_t k = 0; k < slices.size(); ++k)
    slices[k].value = [&, k](int i, int j) {
      const int value = (37 * i * j + 11 * i + static_cast<int>(k)) % (1 << (how.stored - 1));
      return how.is_signed && i % 2 == 0 ? -value : value;
    };
  expect_reads(slices, [&](const SliceFixture& slice) {
    if (std::string(how.syntax) != kRle) return compressed(slice.file(), how.syntax);
    SliceFixture coded = slice;  // GDCM's own RLE encoder refuses odd sizes
    coded.change = [&](Elements& data) {
      data.fragments({rle_frame(slice.pixels().substr(0, 33 * 21 * static_cast<std::size_t>(how.allocated / 8)),
                                how.allocated / 8)});
    };
    return coded.file(kRle);
  });
}

INSTANTIATE_TEST_SUITE_P(
    All, DicomCompressed,
    ::testing::Values(Compressed{"rle16", kRle, 16, 16, true}, Compressed{"rle8", kRle, 8, 8, false},
                      Compressed{"jpeg", kJpegLossless, 16, 16, false},
                      Compressed{"jpeg12", kJpegLossless, 16, 12, false},
                      Compressed{"jpegsigned", kJpegLossless, 16, 16, true},
                      Compressed{"jpeg14", kJpegProcess14, 8, 8, false}, Compressed{"jpegls", kJpegLs, 16, 16, false},
                      Compressed{"jpegls12", kJpegLs, 16, 12, false}, Compressed{"jpeglssigned", kJpegLs, 16, 16, true},
                      Compressed{"j2k", kJpeg2000, 16, 16, false}, Compressed{"j2ksigned", kJpeg2000, 16, 16, true},
                      Compressed{"j2k8", kJpeg2000, 8, 8, false}),
    [](const auto& compressed_as) { return compressed_as.param.name; });

TEST(DicomPixels, LossyBaselineJpegIsReadWithANote) {
  SliceFixture like;
  like.allocated = like.stored = 8, like.is_signed = false, like.columns = 32, like.rows = 24, like.rescale = false,
  like.modality = "MR";
  auto slices = stack_of(3, 2, like);
  for (SliceFixture& slice : slices) slice.value = [](int i, int j) { return 60 + 3 * i + 2 * j; };
  const DicomFolder folder;
  for (std::size_t n = 0; n < slices.size(); ++n)
    folder.write(std::to_string(n), compressed(slices[n].file(), kJpegBaseline));
  const ImageVolume volume = folder.read();
  EXPECT_CONTAINS(volume.notes.at(0), "compressed with loss");
  EXPECT_NEAR(value_at_lps(volume, centre_of(slices[1], 10, 10)), 110, 4);
}

/// Frames of a multi-frame file, one fragment each, and one frame in two fragments found through the offset table.
TEST(DicomPixels, FragmentsOfSeveralFrames) {
  auto slices = stack_of(3, 2);
  Elements data = enhanced(slices);
  std::vector<std::string> pieces;
  for (const SliceFixture& slice : slices) pieces.push_back(rle_frame(slice.pixels(), 2));
  const DicomFolder folder;
  data.fragments(pieces);
  expect_holds(read_dicom_series(folder.write("one", dicom_file(data, kRle))), slices);
  const std::string& middle = pieces[1];
  const std::vector<std::string> split{pieces[0], middle.substr(0, 70), middle.substr(70), pieces[2]};
  const auto second = static_cast<std::uint32_t>(8 + split[0].size());
  data.fragments(split, {0, second, static_cast<std::uint32_t>(second + 16 + middle.size())});
  expect_holds(read_dicom_series(folder.write("two", dicom_file(data, kRle))), slices);
  data.fragments(split);
  EXPECT_CONTAINS(message_of<InputError>([&] { read_dicom_series(folder.write("three", dicom_file(data, kRle))); }),
                  "3 frames come in 4 pieces without a table");
  data.fragments(split, {0, 4, 8});
  EXPECT_CONTAINS(message_of<InputError>([&] { read_dicom_series(folder.write("four", dicom_file(data, kRle))); }),
                  "table of frames does not fit");
}

std::string refusal_of(const std::function<std::string(const SliceFixture&)>& file, const SliceFixture& like = {}) {
  const DicomFolder folder;
  const auto slices = stack_of(3, 2, like);
  for (std::size_t n = 0; n < slices.size(); ++n)
    folder.write("s" + std::to_string(n), n == 1 ? file(slices[n]) : slices[n].file());
  const std::string message = folder.refusal();
  EXPECT_CONTAINS(message, "s1");
  return message;
}

TEST(DicomPixels, CutOffNativePixelsAreRefused) {
  EXPECT_CONTAINS(refusal_of([](const SliceFixture& s) { return s.file().substr(0, s.file().size() - 2); }),
                  "pixel data are cut off: 58 of 60 bytes");
  EXPECT_CONTAINS(refusal_of([](SliceFixture s) {
                    s.change = [](Elements& data) { data.bytes(0x7FE00010, "OW", std::string(40, 'x')); };
                    return s.file();
                  }),
                  "pixel data are cut off: 40 of 60 bytes");
}

TEST(DicomPixels, CutOffDeflatedDataAreRefused) {
  EXPECT_CONTAINS(refusal_of([](SliceFixture s) {
                    s.encoding = Encoding::kDeflated;
                    const std::string file = s.file();
                    return file.substr(0, file.size() - 20);
                  }),
                  "damaged");
}

TEST(DicomPixels, CutOffOrForeignCompressedPixelsAreRefused) {
  const auto with = [](const std::string& piece, const char* syntax) {
    return refusal_of([&](SliceFixture s) {
      s.change = [&](Elements& data) { data.fragments({piece}); };
      return s.file(syntax);
    });
  };
  const std::string rle = rle_frame(SliceFixture{}.pixels(), 2);
  EXPECT_CONTAINS(with(rle.substr(0, rle.size() - 10), kRle), "RLE pixels are cut off");
  EXPECT_CONTAINS(with(rle_frame(SliceFixture{}.pixels(), 1), kRle), "does not hold 2 planes");
  EXPECT_CONTAINS(with("no picture", "1.2.840.10008.1.2.4.90"), "are not JPEG 2000 (Lossless Only)");
  EXPECT_CONTAINS(with(rle, "1.2.840.10008.1.2.4.70"), "are not JPEG Lossless");
}

TEST(DicomPixels, CompressedPixelsOfAnotherSizeOrWithoutEndAreRefused) {
  SliceFixture larger;
  larger.columns = 32, larger.rows = 32, larger.is_signed = false;
  for (const std::string syntax : {kJpeg2000, kJpegLs, kJpegLossless}) {
    const std::string file = compressed(larger.file(), syntax);
    const std::size_t start = file.find(syntax == kJpeg2000 ? "\xFF\x4F\xFF" : "\xFF\xD8\xFF");
    const std::string code = file.substr(start, file.size() - start - 8);
    EXPECT_CONTAINS(refusal_of([&](SliceFixture s) {
                      s.is_signed = false, s.change = [&](Elements& data) { data.fragments({code}); };
                      return s.file(syntax);
                    }),
                    "compressed pixels are 32 x 32 in 1 colours, its header says 6 x 5 grey");
    EXPECT_CONTAINS(refusal_of(
                        [&](SliceFixture s) {
                          s.change = [&](Elements& data) { data.fragments({code.substr(0, code.size() / 2 / 2 * 2)}); };
                          return s.file(syntax);
                        },
                        larger),
                    "cut off");
  }
}

TEST(DicomPixels, WhatCannotBeDecodedIsRefusedByItsName) {
  const auto as = [](const std::string& syntax) {
    return refusal_of([&](const SliceFixture& s) { return s.file(syntax); });
  };
  EXPECT_CONTAINS(as("1.2.840.10008.1.2.4.201"),
                  "High-Throughput JPEG 2000 (Lossless Only), which cannot be decoded here");
  EXPECT_CONTAINS(as("1.2.840.10008.1.2.4.100"), "MPEG2 Main Profile / Main Level");
  EXPECT_CONTAINS(as("1.2.840.10008.1.2.4.94"), "JPIP Referenced");
  EXPECT_CONTAINS(as("1.2.3.4.5"), "a transfer syntax that is not in the DICOM standard's list");
  EXPECT_CONTAINS(as("1.2.840.10008.1.2.4.90"), "not stored as JPEG 2000 (Lossless Only), which it claims");
}

TEST(DicomPixels, WhatIsNoGreyImageIsRefused) {
  const auto with = [](const std::function<void(Elements&)>& change) {
    return refusal_of([&](SliceFixture s) {
      s.change = change;
      return s.file();
    });
  };
  EXPECT_CONTAINS(with([](Elements& d) { d.word(0x00280002, 3).text(0x00280004, "CS", "RGB"); }), "is a colour image");
  EXPECT_CONTAINS(with([](Elements& d) { d.text(0x00280004, "CS", "PALETTE COLOR"); }), "is a colour image");
  EXPECT_CONTAINS(with([](Elements& d) { d.word(0x00280100, 1).word(0x00280101, 1).word(0x00280102, 0); }),
                  "1-bit pixels");
  EXPECT_CONTAINS(with([](Elements& d) { d.word(0x00280100, 12); }), "BitsAllocated is 12");
  EXPECT_CONTAINS(with([](Elements& d) { d.word(0x00280101, 17); }), "do not fit into BitsAllocated");
  EXPECT_CONTAINS(with([](Elements& d) { d.word(0x00280102, 16); }), "do not fit into BitsAllocated");
  EXPECT_CONTAINS(with([](Elements& d) { d.word(0x00280103, 2); }), "PixelRepresentation");
  EXPECT_CONTAINS(with([](Elements& d) { d.erase(0x7FE00010); }), "holds no pixel data");
  EXPECT_CONTAINS(with([](Elements& d) { d.erase(0x7FE00010).bytes(0x7FE00008, "OF", std::string(120, '\0')); }),
                  "floating point");
  EXPECT_CONTAINS(with([](Elements& d) { d.text(0x00280008, "IS", "1A"); }), "NumberOfFrames");
  EXPECT_CONTAINS(with([](Elements& d) { d.text(0x00280008, "IS", "-2"); }), "NumberOfFrames");
}

TEST(DicomPixels, ClaimsOfHugeImagesAreRefusedAtOnce) {
  const auto claim = [](unsigned rows, unsigned columns, const char* frames) {
    return refusal_of([&](SliceFixture s) {
      s.change = [&](Elements& d) {
        d.word(0x00280010, rows).word(0x00280011, columns).text(0x00280008, "IS", frames);
      };
      return s.file();
    });
  };
  EXPECT_CONTAINS(claim(65535, 65535, "1000"), "more than 8192 along an edge");
  EXPECT_CONTAINS(claim(8192, 8192, "1000"), "more than an import may hold");
  EXPECT_CONTAINS(claim(8192, 8192, "2147483647"), "more than an import may hold");
  EXPECT_CONTAINS(claim(4096, 4096, "1"), "pixel data are cut off");
}

TEST(DicomPixels, PaddedPixelDataAreReadWithANote) {
  const DicomFolder folder;
  auto slices = stack_of(3, 2);
  for (SliceFixture& slice : slices)
    slice.change = [bytes = slice.pixels()](Elements& data) {
      data.bytes(0x7FE00010, "OW", bytes + std::string(50, 'x'));
    };
  folder.write_all(slices);
  const ImageVolume volume = folder.read();
  expect_holds(volume, slices);
  EXPECT_CONTAINS(volume.notes.at(0), "more bytes of pixels");
}

}  // namespace
}  // namespace trocar::test::dicom_pixels_test
