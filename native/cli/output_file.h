// Files that appear whole or not at all: written beside their place, then renamed to it.
#pragma once

#include <filesystem>
#include <list>
#include <stdexcept>
#include <string>

namespace atlas_refine::cli {

/// A file or folder that cannot be written; what() names the reason, `path` the thing.
class OutputError : public std::runtime_error {
 public:
  OutputError(std::filesystem::path path, const std::string& what) : std::runtime_error(what), path(std::move(path)) {}
  std::filesystem::path path;
};

/// Throws OutputError where a file could not be put at `path`: no folder, a folder of that name, no permission.
void check_writable(const std::filesystem::path& path);

/// As above for a folder that may be created inside an existing one.
void check_folder_creatable(const std::filesystem::path& path);

/// Whether both names lead to one place, whether or not something is there.
bool same_file(const std::filesystem::path& a, const std::filesystem::path& b);

/// The content of a file to be. Until commit_together() nothing has changed at `path`; without it no trace stays.
class PendingFile {
 public:
  PendingFile(const std::filesystem::path& path, const std::string& content);
  ~PendingFile();
  PendingFile(const PendingFile&) = delete;
  PendingFile& operator=(const PendingFile&) = delete;

 private:
  friend void commit_together(std::list<PendingFile>& files);
  void link_old();
  void put_in_place();
  void put_back() noexcept;

  std::filesystem::path path_;
  std::filesystem::path temporary_;  ///< the new content, until it is in place
  std::filesystem::path old_;        ///< what was at `path_`
  bool replaces_ = false;
  bool in_place_ = false;
};

/// All files get to their places, or OutputError is thrown and everything is as it was.
void commit_together(std::list<PendingFile>& files);

/// A folder to be: made where it is missing, removed again without keep().
class PendingFolder {
 public:
  explicit PendingFolder(const std::filesystem::path& path);
  ~PendingFolder();
  PendingFolder(const PendingFolder&) = delete;
  PendingFolder& operator=(const PendingFolder&) = delete;
  void keep() { made_ = false; }

 private:
  std::filesystem::path path_;
  bool made_ = false;
};

}  // namespace atlas_refine::cli
