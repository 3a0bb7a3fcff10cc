// Files that are read whole; a file that cannot be used is named with the reason.
#include "io/input_file.h"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <system_error>

namespace atlas_refine::io {

namespace {

constexpr std::size_t most_of_a_pipe = std::size_t{1} << 30;

/// A pipe may bring a file; devices that are none may never end.
std::filesystem::path readable(const std::filesystem::path& path) { return path == "-" ? "/dev/stdin" : path; }

}  // namespace

std::string read_text(const std::filesystem::path& path, const char* kind) {
  const auto refuse = [&path](const std::string& what) { throw InputError(path, what); };
  std::error_code error;
  const auto status = std::filesystem::status(readable(path), error);
  if (status.type() == std::filesystem::file_type::not_found) refuse("does not exist");
  if (error) refuse("cannot be read: " + error.message());
  if (std::filesystem::is_directory(status)) refuse(std::string("is a directory, not ") + kind);
  const bool is_pipe = std::filesystem::is_fifo(status);
  if (!is_pipe && !std::filesystem::is_regular_file(status)) refuse(std::string("is a device, not ") + kind);
  std::ifstream file(readable(path), std::ios::binary);
  if (!file) refuse(std::string("cannot be read: ") + std::strerror(errno));
  std::string text;
  constexpr std::size_t block = 1 << 20;
  if (const auto size = std::filesystem::file_size(readable(path), error); !error) text.reserve(size + block);
  while (file) {
    const std::size_t old_size = text.size();
    text.resize(old_size + block);
    file.read(text.data() + old_size, block);
    text.resize(old_size + static_cast<std::size_t>(file.gcount()));
    if (is_pipe && text.size() > most_of_a_pipe) refuse("is a pipe that brings more than 1 GiB; write it to a file first");
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
