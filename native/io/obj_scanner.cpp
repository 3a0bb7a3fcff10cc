// Walks over the text of an OBJ file: tokens, lines that a backslash continues, comments, any line end.
#include "io/obj_scanner.h"

#include "atlas_refine/error.h"

namespace atlas_refine::io {

namespace {

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\v' || c == '\f'; }
bool is_digit(char c) { return c >= '0' && c <= '9'; }

}  // namespace

ObjScanner::ObjScanner(std::string_view text) : text_(text) {
  if (text_.starts_with("\xEF\xBB\xBF")) at_ = 3;
}

std::size_t ObjScanner::record_end() const {
  if (at_ < text_.size()) return at_;
  std::size_t end = at_;
  for (std::size_t before = at_; before > 0; --before) {
    const char c = text_[before - 1];
    if (c == '\\') end = before - 1;
    if (c != '\\' && c != '\n' && c != '\r' && !is_blank(c)) break;
  }
  return end;
}

void ObjScanner::skip_indent() {
  while (at_ < text_.size() && is_blank(text_[at_])) ++at_;
}

// A comment may follow a number without a blank; "1.#IND" is none of them.
ObjText::Span ObjScanner::next_token() {
  skip_blanks();
  ObjText::Span token{at_, at_};
  if (at_ < text_.size() && text_[at_] == '#') return token;
  const auto ends_here = [&](char c) {
    return is_blank(c) || c == '\n' || c == '\r' || continuation_length(at_) > 0 || (c == '#' && is_digit(text_[at_ - 1]));
  };
  while (at_ < text_.size() && !ends_here(text_[at_])) ++at_;
  token.end = at_;
  return token;
}

void ObjScanner::skip_blanks() {
  while (at_ < text_.size()) {
    if (is_blank(text_[at_])) {
      ++at_;
    } else if (const std::size_t length = continuation_length(at_); length > 0) {
      at_ += length;
      ++line_;
    } else {
      return;
    }
  }
}

void ObjScanner::skip_logical_line() {
  while (at_ < text_.size() && text_[at_] != '\n' && text_[at_] != '\r') {
    if (continuation_length(at_) > 0) {
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

// A backslash that joins the next line to this one, with the line end and blanks between the two; 0 where there is none here.
std::size_t ObjScanner::continuation_length(std::size_t at) const {
  if (text_[at] != '\\') return 0;
  std::size_t end = at + 1;
  while (end < text_.size() && is_blank(text_[end])) ++end;
  if (end == text_.size()) return end - at;
  const std::size_t line_end = line_end_length(end);
  return line_end > 0 ? end + line_end - at : 0;
}

void ObjScanner::fail_at(int line, const std::string& what) {
  throw RefineError(ErrorCode::BadInput, "read", "line " + std::to_string(line) + ": " + what);
}

}  // namespace atlas_refine::io
