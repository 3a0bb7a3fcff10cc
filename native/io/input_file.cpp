// Files that are read whole; a file that cannot be used is named with the reason.
#include "io/input_file.h"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <system_error>

namespace atlas_refine::io {

std::string read_text(const std::filesystem::path& path, const char* kind) {
  const auto refuse = [&path](const std::string& what) { throw InputError(path, what); };
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (status.type() == std::filesystem::file_type::not_found) refuse("does not exist");
  if (error) refuse("cannot be read: " + error.message());
  if (std::filesystem::is_directory(status)) refuse(std::string("is a directory, not ") + kind);
  std::ifstream file(path, std::ios::binary);
  if (!file) refuse(std::string("cannot be read: ") + std::strerror(errno));
  std::string text;
  if (const auto size = std::filesystem::file_size(path, error); !error) text.reserve(size);
  constexpr std::size_t block = 1 << 20;
  while (file) {
    const std::size_t old_size = text.size();
    text.resize(old_size + block);
    file.read(text.data() + old_size, block);
    text.resize(old_size + static_cast<std::size_t>(file.gcount()));
  }
  if (file.bad()) refuse("cannot be read");
  return text;
}

std::string quoted(std::string_view text) {
  std::string result = "'";
  for (char c : text.substr(0, 40)) result += static_cast<unsigned char>(c) < 0x20 || c == 0x7f ? '?' : c;
  return result + (text.size() > 40 ? "...'" : "'");
}

}  // namespace atlas_refine::io
