// Files that are read whole; a file that cannot be used is named with the reason.
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>

namespace atlas_refine::io {

/// A file that cannot be read or used; what() names the reason and, where there is one, the line.
class InputError : public std::runtime_error {
 public:
  InputError(std::filesystem::path path, const std::string& what) : std::runtime_error(what), path(std::move(path)) {}
  std::filesystem::path path;
};

/// The file's bytes; "-" is the standard input. `kind` ("an OBJ file") is what messages expect. Throws InputError, also for
/// devices and for pipes that bring more than 1 GiB: they may never end.
std::string read_text(const std::filesystem::path& path, const char* kind);

/// Text as it may stand in a one-line message: short, printable, in quotes.
std::string quoted(std::string_view text);

}  // namespace atlas_refine::io
