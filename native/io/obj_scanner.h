// Walks over the text of an OBJ file: tokens, lines that a backslash continues, comments, any line end.
#pragma once

#include <string>
#include <string_view>

#include "io/obj_text.h"

namespace atlas_refine::io {

class ObjScanner {
 public:
  /// `text` outlives the scanner. A byte order mark is skipped.
  explicit ObjScanner(std::string_view text);

  std::size_t at() const { return at_; }
  /// Where the record ends that was just skipped: backslashes that only blanks and line ends follow to the end of the
  /// text continue nothing and are no part of it.
  std::size_t record_end() const;
  bool at_end() const { return at_ >= text_.size(); }
  int line() const { return line_; }

  /// To the place where a record starts.
  void skip_indent();
  /// The next token of the logical line; empty at its end and at a comment.
  ObjText::Span next_token();
  void skip_logical_line();
  void skip_physical_line();

  /// Throws RefineError(BadInput) that names the present line.
  [[noreturn]] void fail(const std::string& what) const { fail_at(line_, what); }
  [[noreturn]] static void fail_at(int line, const std::string& what);

 private:
  void skip_blanks();
  std::size_t line_end_length(std::size_t at) const;
  std::size_t continuation_length(std::size_t at) const;

  std::string_view text_;
  std::size_t at_ = 0;
  int line_ = 1;
};

}  // namespace atlas_refine::io
