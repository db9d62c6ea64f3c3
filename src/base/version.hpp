#pragma once
/// Which program this is; written into every results folder.
#include <string_view>

namespace mudlark {

std::string_view program_version();  ///< "0.1.0"
/// Commit of the source at build time, "-dirty" with changes on top; "unknown" outside a git
/// checkout.
std::string_view program_commit();

}  // namespace mudlark
