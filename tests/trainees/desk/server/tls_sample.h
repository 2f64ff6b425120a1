// A TLS identity made for a test.
#pragma once

#include <filesystem>

namespace trocar::review {

/// A key and a certificate for "localhost" that signs itself, valid for an hour, as PEM files.
void make_identity(const std::filesystem::path& certificate, const std::filesystem::path& key);

}  // namespace trocar::review
