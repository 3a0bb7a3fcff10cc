// Walks over the text of an OBJ file: tokens, lines that a backslash continues, comments, any line end.
#include "io/obj_scanner.h"

#include "atlas_refine/error.h"

namespace atlas_refine::io {

namespace {

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\v' || c == '\f'; }

}  // namespace

ObjScanner::ObjScanner(std::string_view text) : text_(text) {
  if (text_.starts_with("\xEF\xBB\xBF")) at_ = 3;
}

void ObjScanner::skip_indent() {
  while (at_ < text_.size() && is_blank(text_[at_])) ++at_;
}

ObjText::Span ObjScanner::next_token() {
  skip_blanks();
  ObjText::Span token{at_, at_};
  if (at_ < text_.size() && text_[at_] == '#') return token;
  while (at_ < text_.size() && !is_blank(text_[at_]) && text_[at_] != '\n' && text_[at_] != '\r' && !continues_at(at_)) ++at_;
  token.end = at_;
  return token;
}

void ObjScanner::skip_blanks() {
  while (at_ < text_.size()) {
    if (is_blank(text_[at_])) {
      ++at_;
    } else if (continues_at(at_)) {
      at_ += 1 + line_end_length(at_ + 1);
      ++line_;
    } else {
      return;
    }
  }
}

void ObjScanner::skip_logical_line() {
  while (at_ < text_.size() && text_[at_] != '\n' && text_[at_] != '\r') {
    if (continues_at(at_)) {
      skip_blanks();
    } else {
      ++at_;
    }
  }
  skip_physical_line();
}

void ObjScanner::skip_physical_line() {
  while (at_ < text_.size() && text_[at_] != '\n' && text_[at_] != '\r') ++at_;
  if (at_ == text_.size()) return;
  at_ += line_end_length(at_);
  ++line_;
}

std::size_t ObjScanner::line_end_length(std::size_t at) const {
  if (at >= text_.size()) return 0;
  if (text_[at] == '\n') return 1;
  if (text_[at] != '\r') return 0;
  return at + 1 < text_.size() && text_[at + 1] == '\n' ? 2 : 1;
}

// Whether a backslash here joins the next line to this one.
bool ObjScanner::continues_at(std::size_t at) const { return text_[at] == '\\' && line_end_length(at + 1) > 0; }

void ObjScanner::fail_at(int line, const std::string& what) {
  throw RefineError(ErrorCode::BadInput, "read", "line " + std::to_string(line) + ": " + what);
}

}  // namespace atlas_refine::io
