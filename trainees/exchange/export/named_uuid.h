// UUIDs that are made of a name and always come out the same: version 5 of RFC 9562 (SHA-1 of namespace and name).
// Thread: any.
#pragma once

#include <string>
#include <string_view>

namespace trocar {

/// @param space UUID of the namespace, 36 characters. @throws InputError when it is none.
std::string named_uuid(const std::string& space, std::string_view name);

}  // namespace trocar
