#include "tissue/imaging/dicom/transfer_syntax.h"

namespace trocar {
namespace {

constexpr PixelCoding kNative = PixelCoding::kNative, kRle = PixelCoding::kRle, kJpeg = PixelCoding::kJpeg,
                      kJpegLs = PixelCoding::kJpegLs, kJpeg2000 = PixelCoding::kJpeg2000,
                      kCannot = PixelCoding::kCannot;

constexpr TransferSyntax kImplicit{"1.2.840.10008.1.2", "Implicit VR Little Endian", kNative, false};
constexpr TransferSyntax kExplicit{"1.2.840.10008.1.2.1", "Explicit VR Little Endian"};

constexpr TransferSyntax encapsulated(std::string_view uid, std::string_view name, PixelCoding coding,
                                      bool lossy = false) {
  return {uid, name, coding, true, false, false, lossy};
}

constexpr TransferSyntax kTable[] = {
    kImplicit,
    kExplicit,
    {"1.2.840.10008.1.2.1.99", "Deflated Explicit VR Little Endian", kNative, true, false, true},
    {"1.2.840.10008.1.2.2", "Explicit VR Big Endian", kNative, true, true},
    {"1.2.840.113619.5.2", "GE private implicit VR with big endian pixels", kCannot, false},
    encapsulated("1.2.840.10008.1.2.5", "RLE Lossless", kRle),
    encapsulated("1.2.840.10008.1.2.4.50", "JPEG Baseline (Process 1)", kJpeg, true),
    encapsulated("1.2.840.10008.1.2.4.51", "JPEG Extended (Process 2 and 4)", kJpeg, true),
    encapsulated("1.2.840.10008.1.2.4.52", "JPEG Extended (Process 3 and 5)", kCannot, true),
    encapsulated("1.2.840.10008.1.2.4.53", "JPEG Spectral Selection (Process 6 and 8)", kCannot, true),
    encapsulated("1.2.840.10008.1.2.4.55", "JPEG Full Progression (Process 10 and 12)", kCannot, true),
    encapsulated("1.2.840.10008.1.2.4.57", "JPEG Lossless (Process 14)", kJpeg),
    encapsulated("1.2.840.10008.1.2.4.58", "JPEG Lossless (Process 15)", kCannot),
    encapsulated("1.2.840.10008.1.2.4.70", "JPEG Lossless, First-Order Prediction (Process 14, Selection 1)", kJpeg),
    encapsulated("1.2.840.10008.1.2.4.80", "JPEG-LS Lossless", kJpegLs),
    encapsulated("1.2.840.10008.1.2.4.81", "JPEG-LS Near-Lossless", kJpegLs, true),
    encapsulated("1.2.840.10008.1.2.4.90", "JPEG 2000 (Lossless Only)", kJpeg2000),
    encapsulated("1.2.840.10008.1.2.4.91", "JPEG 2000", kJpeg2000, true),
    encapsulated("1.2.840.10008.1.2.4.92", "JPEG 2000 Part 2 Multi-component (Lossless Only)", kCannot),
    encapsulated("1.2.840.10008.1.2.4.93", "JPEG 2000 Part 2 Multi-component", kCannot, true),
    encapsulated("1.2.840.10008.1.2.4.94", "JPIP Referenced", kCannot),
    encapsulated("1.2.840.10008.1.2.4.95", "JPIP Referenced Deflate", kCannot),
    encapsulated("1.2.840.10008.1.2.4.100", "MPEG2 Main Profile / Main Level", kCannot, true),
    encapsulated("1.2.840.10008.1.2.4.101", "MPEG2 Main Profile / High Level", kCannot, true),
    encapsulated("1.2.840.10008.1.2.4.102", "MPEG-4 AVC/H.264 High Profile / Level 4.1", kCannot, true),
    encapsulated("1.2.840.10008.1.2.4.103", "MPEG-4 AVC/H.264 BD-compatible High Profile", kCannot, true),
    encapsulated("1.2.840.10008.1.2.4.104", "MPEG-4 AVC/H.264 High Profile for 2D Video", kCannot, true),
    encapsulated("1.2.840.10008.1.2.4.105", "MPEG-4 AVC/H.264 High Profile for 3D Video", kCannot, true),
    encapsulated("1.2.840.10008.1.2.4.106", "MPEG-4 AVC/H.264 Stereo High Profile", kCannot, true),
    encapsulated("1.2.840.10008.1.2.4.107", "HEVC/H.265 Main Profile", kCannot, true),
    encapsulated("1.2.840.10008.1.2.4.108", "HEVC/H.265 Main 10 Profile", kCannot, true),
    encapsulated("1.2.840.10008.1.2.4.110", "JPEG XL Lossless", kCannot),
    encapsulated("1.2.840.10008.1.2.4.111", "JPEG XL JPEG Recompression", kCannot, true),
    encapsulated("1.2.840.10008.1.2.4.112", "JPEG XL", kCannot, true),
    encapsulated("1.2.840.10008.1.2.4.201", "High-Throughput JPEG 2000 (Lossless Only)", kCannot),
    encapsulated("1.2.840.10008.1.2.4.202", "High-Throughput JPEG 2000 with RPCL Options (Lossless Only)", kCannot),
    encapsulated("1.2.840.10008.1.2.4.203", "High-Throughput JPEG 2000", kCannot, true),
};

}  // namespace

const TransferSyntax* transfer_syntax(std::string_view uid) {
  for (const TransferSyntax& syntax : kTable)
    if (syntax.uid == uid) return &syntax;
  return nullptr;
}

const TransferSyntax& implicit_little_endian() { return kTable[0]; }
const TransferSyntax& explicit_little_endian() { return kTable[1]; }

}  // namespace trocar
