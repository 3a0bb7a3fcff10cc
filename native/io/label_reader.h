// Labels of faces from records that name what follows.
#pragma once

#include <string>
#include <unordered_map>
#include <utility>

#include "io/face_labels.h"

namespace atlas_refine::io {

/// The name that holds from a record on, until the next.
class LabelReader {
 public:
  void set(std::string name) { name_ = std::move(name); }
  void label_face() {
    if (!labels_.of_face.empty() && labels_.names[labels_.of_face.back()] == name_) {
      labels_.of_face.push_back(labels_.of_face.back());
      return;
    }
    const auto [at, added] = numbers_.emplace(name_, static_cast<int>(labels_.names.size()));
    if (added) labels_.names.push_back(name_);
    labels_.of_face.push_back(at->second);
  }
  FaceLabels take() { return std::move(labels_); }

 private:
  std::string name_;
  FaceLabels labels_;
  std::unordered_map<std::string, int> numbers_;
};

}  // namespace atlas_refine::io
