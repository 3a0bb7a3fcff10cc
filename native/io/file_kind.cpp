// What a file is that is not OBJ, told from how it begins.
#include "io/file_kind.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace atlas_refine::io {

namespace {

using namespace std::string_view_literals;

constexpr std::size_t head_size = 4096;

struct Magic {
  std::string_view begin;
  std::string_view kind;
};

// No OBJ record begins like one of these.
constexpr std::array magics{
    Magic{"glTF"sv, "a binary glTF (GLB) file"},
    Magic{"Kaydara FBX Binary"sv, "an FBX file"},
    Magic{"; FBX"sv, "an FBX file"},
    Magic{";FBX"sv, "an FBX file"},
    Magic{"ply\n"sv, "a PLY file"},
    Magic{"ply\r"sv, "a PLY file"},
    Magic{"#usda"sv, "a USD file"},
    Magic{"PXR-USDC"sv, "a USD file"},
    Magic{"\x1f\x8b"sv, "a gzip file"},
    Magic{"\x28\xb5\x2f\xfd"sv, "a Zstandard file"},
    Magic{"BLENDER"sv, "a Blender file"},
    Magic{"Ogawa"sv, "an Alembic file"},
    Magic{"\xfd\x37zXZ"sv, "an xz file"},
    Magic{"\x89PNG"sv, "a PNG image"},
    Magic{"OFF\n"sv, "an OFF file"},
    Magic{"OFF\r"sv, "an OFF file"},
    Magic{"COFF\n"sv, "an OFF file"},
    Magic{"version https://git-lfs"sv, "a pointer of Git LFS, whose file is to be fetched with git lfs pull"},
    Magic{"\xff\xfe"sv, "a UTF-16 file"},
    Magic{"\xfe\xff"sv, "a UTF-16 file"}};

bool has(std::string_view text, std::string_view part) { return text.find(part) != std::string_view::npos; }

// Text whose every other byte is zero, as UTF-16 without a byte order mark is.
bool is_utf16(std::string_view head) {
  const std::size_t pairs = std::min<std::size_t>(head.size(), 64) / 2;
  std::size_t zero_first = 0, zero_second = 0;
  for (std::size_t k = 0; k < pairs; ++k) {
    zero_first += head[2 * k] == 0;
    zero_second += head[2 * k + 1] == 0;
  }
  return pairs >= 2 && ((zero_first == pairs && zero_second == 0) || (zero_second == pairs && zero_first == 0));
}

// A header of 80 bytes, a count, and 50 bytes for each triangle, to the byte.
bool is_binary_stl(std::string_view bytes) {
  constexpr std::size_t header = 80, triangle = 50;
  if (bytes.size() < header + 4) return false;
  std::uint64_t count = 0;
  for (std::size_t k = 0; k < 4; ++k) count |= std::uint64_t{static_cast<unsigned char>(bytes[header + k])} << (8 * k);
  return bytes.size() == header + 4 + triangle * count;
}

std::string_view kind_of_text(std::string_view head) {
  head.remove_prefix(std::min(head.find_first_not_of(" \t\r\n"), head.size()));
  if (head.starts_with('{')) return has(head, "\"asset\"") ? "a glTF file" : "a JSON file";
  if (head.starts_with("<!DOCTYPE html") || head.starts_with("<!doctype html") || head.starts_with("<html"))
    return "an HTML page";
  if (head.starts_with("<?xml") || head.starts_with("<COLLADA")) return has(head, "<COLLADA") ? "a COLLADA file" : "an XML file";
  if (head.starts_with("solid") && (has(head, "facet") || has(head, "endsolid"))) return "an STL file";
  if (has(head, "FBXHeaderExtension:")) return "an FBX file";
  return {};
}

}  // namespace

std::string_view foreign_kind(std::string_view bytes) {
  std::string_view head = bytes.substr(0, head_size);
  for (const Magic& magic : magics) {
    if (head.starts_with(magic.begin)) return magic.kind;
  }
  if (head.starts_with("PK\x03\x04")) return has(head, ".usd") ? "a USD file" : "a zip file";
  if (is_binary_stl(bytes)) return "an STL file";
  if (is_utf16(head)) return "a UTF-16 file";
  if (head.starts_with("\xEF\xBB\xBF")) head.remove_prefix(3);
  return kind_of_text(head);
}

}  // namespace atlas_refine::io
