// Files that appear whole or not at all: written beside their place, then renamed to it.
#include "output_file.h"

#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <system_error>

namespace atlas_refine::cli {

namespace fs = std::filesystem;

namespace {

fs::path folder_of(const fs::path& path) { return path.has_parent_path() ? path.parent_path() : fs::path("."); }

void check_folder(const fs::path& path, const fs::path& folder) {
  std::error_code error;
  const fs::file_status status = fs::status(folder, error);
  if (status.type() == fs::file_type::not_found) throw OutputError(path, "its folder does not exist");
  if (!fs::is_directory(status)) throw OutputError(path, "its folder is not a folder");
  if (access(folder.c_str(), W_OK | X_OK) != 0) throw OutputError(path, std::string("its folder: ") + std::strerror(errno));
}

/// Where a symbolic link leads, so that the link stays a link.
fs::path behind_links(const fs::path& path) {
  std::error_code error;
  const fs::path target = fs::is_symlink(fs::symlink_status(path, error)) ? fs::weakly_canonical(path, error) : path;
  return error ? path : target;
}

}  // namespace

void check_writable(const fs::path& path) {
  if (path.empty()) throw OutputError(path, "an empty file name");
  const fs::path target = behind_links(path);
  std::error_code error;
  const fs::file_status status = fs::status(target, error);
  if (fs::is_directory(status)) throw OutputError(path, "is a folder");
  if (fs::exists(status) && !fs::is_regular_file(status)) throw OutputError(path, "is not a regular file");
  check_folder(path, folder_of(target));
}

void check_folder_creatable(const fs::path& path) {
  if (path.empty()) throw OutputError(path, "an empty folder name");
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (fs::is_directory(status)) {
    check_folder(path, path);
  } else if (fs::exists(status)) {
    throw OutputError(path, "is not a folder");
  } else {
    // "pictures/" and "pictures" mean the same folder.
    check_folder(path, folder_of(path.has_filename() ? path : path.parent_path()));
  }
}

bool same_file(const fs::path& a, const fs::path& b) {
  std::error_code error;
  const fs::path place_a = fs::weakly_canonical(fs::absolute(a), error);
  return !error && place_a == fs::weakly_canonical(fs::absolute(b), error);
}

PendingFile::PendingFile(const fs::path& path, const std::string& content) : path_(behind_links(path)) {
  temporary_ = folder_of(path_) / ("." + path_.filename().string() + "." + std::to_string(getpid()) + ".tmp");
  std::FILE* file = std::fopen(temporary_.c_str(), "wbx");
  if (!file) throw OutputError(path, std::string("cannot be written: ") + std::strerror(errno));
  const bool written = std::fwrite(content.data(), 1, content.size(), file) == content.size();
  const bool closed = std::fclose(file) == 0;
  if (written && closed) return;
  const std::string reason = std::strerror(errno);
  std::error_code ignored;
  fs::remove(temporary_, ignored);
  throw OutputError(path, "cannot be written: " + reason);
}

PendingFile::~PendingFile() {
  std::error_code ignored;
  if (!temporary_.empty()) fs::remove(temporary_, ignored);
  if (!old_.empty()) fs::remove(old_, ignored);
}

// A second name for the old file; a file system without such names cannot give it back.
void PendingFile::link_old() {
  std::error_code error;
  replaces_ = fs::exists(path_, error);
  if (!replaces_) return;
  fs::permissions(temporary_, fs::status(path_, error).permissions(), error);
  const fs::path old = temporary_.string() + ".old";
  fs::create_hard_link(path_, old, error);
  if (!error) old_ = old;
}

void PendingFile::put_in_place() {
  std::error_code error;
  fs::rename(temporary_, path_, error);
  if (error) throw OutputError(path_, "cannot be written: " + error.message());
  temporary_.clear();
  in_place_ = true;
}

void PendingFile::put_back() noexcept {
  std::error_code ignored;
  if (in_place_ && !replaces_) fs::remove(path_, ignored);
  if (in_place_ && !old_.empty()) fs::rename(old_, path_, ignored);
}

void commit_together(std::list<PendingFile>& files) {
  for (PendingFile& file : files) file.link_old();
  try {
    for (PendingFile& file : files) file.put_in_place();
  } catch (const OutputError&) {
    for (PendingFile& file : files) file.put_back();
    throw;
  }
}

PendingFolder::PendingFolder(const fs::path& path) : path_(path) {
  std::error_code error;
  made_ = fs::create_directory(path, error);
  if (error) throw OutputError(path, "cannot be created: " + error.message());
}

PendingFolder::~PendingFolder() {
  std::error_code ignored;
  if (made_) fs::remove(path_, ignored);
}

}  // namespace atlas_refine::cli
