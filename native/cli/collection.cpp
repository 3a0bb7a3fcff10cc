// One or several files as one atlas, and a result of it given back to the files.
#include "collection.h"

#include <algorithm>
#include <limits>
#include <map>

#include "io/input_file.h"

namespace atlas_refine::cli {

namespace {

/// Whether every face is still what it was in `atlas`.
bool divides_nothing(const CutMesh& cut, const Atlas& atlas) {
  return cut.new_vertices.empty() && cut.face_offsets == atlas.face_offsets && cut.corner_vertices == atlas.corner_vertices;
}

}  // namespace

void Collection::add(const std::filesystem::path& path) {
  std::unique_ptr<const io::MeshFile> mesh = io::read_mesh_file(path);
  if (files_.size() == 1 && atlas_.face_offsets.empty()) {
    atlas_ = atlas_of(0);
    atlas_.vertex_meshes.assign(atlas_.positions.size(), 0);
  }
  const auto vertices = static_cast<int>(atlas_.positions.size());
  const int faces = atlas_.face_count(), corners = atlas_.corner_count();
  if (!files_.empty()) {
    const Atlas& added = mesh->atlas();
    if (added.corner_vertices.size() > static_cast<std::size_t>(std::numeric_limits<int>::max() - corners))
      throw io::InputError(path, "has more face corners than this program can count");
    atlas_.positions.insert(atlas_.positions.end(), added.positions.begin(), added.positions.end());
    atlas_.vertex_meshes.resize(atlas_.positions.size(), static_cast<int>(files_.size()));
    for (int f = 1; f <= added.face_count(); ++f) atlas_.face_offsets.push_back(corners + added.face_offsets[f]);
    for (int vertex : added.corner_vertices) atlas_.corner_vertices.push_back(vertices + vertex);
    atlas_.corner_uvs.insert(atlas_.corner_uvs.end(), added.corner_uvs.begin(), added.corner_uvs.end());
  }
  files_.push_back({path, std::move(mesh), vertices, faces, corners});
}

std::string Collection::place_of_face(int face) const {
  if (face < 0 || face >= atlas().face_count()) {
    const std::string more = files_.size() > 1 ? " and " + std::to_string(files_.size() - 1) + " more" : "";
    return files_.front().path.string() + more;
  }
  const File& file = file_of_face(face);
  return file.path.string() + ": " + file.mesh->where(face - file.first_face);
}

const Collection::File& Collection::file_of_face(int face) const {
  return *std::prev(std::upper_bound(files_.begin(), files_.end(), face, [](int f, const File& x) { return f < x.first_face; }));
}

int Collection::face_count() const {
  int count = 0;
  for (const File& file : files_) count += file.mesh->face_count();
  return count;
}

std::vector<int> Collection::faces_of_atlas() const {
  std::vector<int> result;
  int first = 0;
  for (const File& file : files_) {
    for (int face = 0; face < file.mesh->atlas().face_count(); ++face) result.push_back(first + file.mesh->face_number(face));
    first += file.mesh->face_count();
  }
  return result;
}

void Collection::group_by_material(RefineOptions& options) const {
  std::map<std::string, int> numbers;
  options.groups.clear();
  options.group_names.clear();
  for (const File& file : files_) {
    const io::FaceLabels& labels = file.mesh->materials();
    for (const int label : labels.of_face) {
      const std::string& name = labels.names[label];
      const auto [at, added] = numbers.emplace(name, static_cast<int>(numbers.size()));
      if (added) options.group_names.push_back(name.empty() ? "no material" : "material " + name);
      options.groups.push_back(at->second);
    }
  }
}

void Collection::group_by_object(RefineOptions& options) const {
  options.groups.clear();
  options.group_names.clear();
  for (const File& file : files_) {
    const io::FaceLabels& labels = file.mesh->objects();
    const auto first = static_cast<int>(options.group_names.size());
    const std::string where = files_.size() > 1 ? file.path.filename().string() + ": " : "";
    for (const std::string& name : labels.names)
      options.group_names.push_back(where + (name.empty() ? "no object" : "object " + name));
    for (const int label : labels.of_face) options.groups.push_back(first + label);
  }
}

std::vector<std::string> Collection::notes() const {
  std::vector<std::string> result;
  for (const File& file : files_) {
    const std::string name = files_.size() > 1 ? file.path.string() + ": " : "";
    for (const std::string& note : file.mesh->notes()) result.push_back(name + note);
  }
  return result;
}

int Collection::number_in_file(int face) const {
  if (face < 0 || face >= atlas().face_count()) return -1;
  const File& file = file_of_face(face);
  return file.mesh->face_number(face - file.first_face);
}

std::string Collection::words_in_file(std::string words, int face) const {
  const std::string named = "face " + std::to_string(face);
  const std::size_t at = words.find(named), end = at + named.size();
  const bool ends_there = at != std::string::npos && (end == words.size() || words[end] < '0' || words[end] > '9');
  if (const int number = number_in_file(face); number >= 0 && ends_there)
    words.replace(at, named.size(), "face " + std::to_string(number));
  return words;
}

std::string Collection::words_for_face(int face) const {
  const File& file = file_of_face(face);
  const int own = face - file.first_face;
  const io::FaceLabels& objects = file.mesh->objects();
  const std::string object = objects.of_face.empty() ? "" : objects.names[objects.of_face[own]];
  return (files_.size() > 1 ? file.path.string() + ": " : "") + "face " + std::to_string(file.mesh->face_number(own)) +
         (object.empty() ? "" : " of " + io::quoted(object)) + ", " + file.mesh->where(own);
}

Collection::Output Collection::output(int k, const RefineResult& result) const {
  const File& file = files_[k];
  const Part mine = part(file, result);
  if (!mine.cut) return {file.mesh->with_uvs(mine.corner_uvs)};
  return {file.mesh->with_cut(*mine.cut, mine.corner_uvs),
          static_cast<int>(mine.cut->face_sources.size()) - file.mesh->atlas().face_count(),
          static_cast<int>(mine.cut->new_vertices.size())};
}

Collection::Part Collection::part(const File& file, const RefineResult& result) const {
  const Atlas& own = file.mesh->atlas();
  const auto uvs = [&](int first, int last) {
    return std::vector<Vec2>(result.corner_uvs.begin() + first, result.corner_uvs.begin() + last);
  };
  if (!result.cut) return {uvs(file.first_corner, file.first_corner + own.corner_count()), {}};
  const CutMesh& whole = *result.cut;
  const auto part_of = [&](int face) {
    return std::lower_bound(whole.face_sources.begin(), whole.face_sources.end(), face) - whole.face_sources.begin();
  };
  const auto first = part_of(file.first_face), last = part_of(file.first_face + own.face_count());
  Part part{uvs(whole.face_offsets[first], whole.face_offsets[last]), cut_of(file, whole, first, last)};
  if (divides_nothing(*part.cut, own)) part.cut.reset();
  return part;
}

// Faces `first` to `last` of the whole cut, in the numbers of the file. New vertices keep their order; none is of two files.
CutMesh Collection::cut_of(const File& file, const CutMesh& whole, std::size_t first, std::size_t last) const {
  const auto all_vertices = static_cast<int>(atlas().positions.size());
  const auto own_vertices = static_cast<int>(file.mesh->atlas().positions.size());
  const int begin = whole.face_offsets[first], end = whole.face_offsets[last];
  const int end_corner = file.first_corner + file.mesh->atlas().corner_count();
  CutMesh cut;
  std::vector<int> own_index(whole.new_vertices.size(), -1);
  for (std::size_t k = 0; k < own_index.size(); ++k) {
    NewVertex vertex = whole.new_vertices[k];
    if (vertex.corners[0] < file.first_corner || vertex.corners[0] >= end_corner) continue;
    for (int& corner : vertex.corners) corner -= file.first_corner;
    own_index[k] = own_vertices + static_cast<int>(cut.new_vertices.size());
    cut.new_vertices.push_back(vertex);
  }
  cut.face_offsets.push_back(0);
  for (std::size_t face = first; face < last; ++face) {
    cut.face_sources.push_back(whole.face_sources[face] - file.first_face);
    cut.face_offsets.push_back(whole.face_offsets[face + 1] - begin);
  }
  for (int c = begin; c < end; ++c) {
    const int vertex = whole.corner_vertices[c];
    cut.corner_vertices.push_back(vertex < all_vertices ? vertex - file.first_vertex : own_index[vertex - all_vertices]);
    cut.corner_sources.push_back(whole.corner_sources[c]);
    for (int& source : cut.corner_sources.back()) source -= file.first_corner;
    cut.corner_weights.push_back(whole.corner_weights[c]);
  }
  return cut;
}

}  // namespace atlas_refine::cli
