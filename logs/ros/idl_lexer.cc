// SPDX-License-Identifier: BSD-3-Clause
#include "logs/ros/idl_lexer.h"

#include <algorithm>

#include "logs/ros/names.h"

namespace scoria::logs {
namespace {

/// Length of the text that begins with a quote, to its closing one.
std::size_t QuotedLength(std::string_view text) {
  for (std::size_t i = 1; i < text.size(); ++i) {
    if (text[i] == '\\') {
      ++i;
    } else if (text[i] == text[0]) {
      return i + 1;
    }
  }
  return text.size();
}

std::size_t NumberLength(std::string_view text) {
  std::size_t i = 1;
  while (i < text.size()) {
    const bool exponent_sign =
        (text[i] == '+' || text[i] == '-') && (text[i - 1] == 'e' || text[i - 1] == 'E');
    if (!IsLetter(text[i]) && !IsDigit(text[i]) && text[i] != '.' && !exponent_sign) break;
    ++i;
  }
  return i;
}

std::size_t NameLength(std::string_view text) {
  const auto end =
      std::find_if(text.begin(), text.end(), [](char c) { return !IsLetter(c) && !IsDigit(c); });
  return static_cast<std::size_t>(end - text.begin());
}

}  // namespace

void IdlLexer::Advance(std::size_t count) {
  count = std::min(count, rest_.size());
  line_ +=
      static_cast<int>(std::count(rest_.begin(), rest_.begin() + static_cast<long>(count), '\n'));
  rest_.remove_prefix(count);
}

void IdlLexer::SkipSpace() {
  for (;;) {
    Advance(rest_.find_first_not_of(" \t\r\f\v\n"));
    if (rest_.starts_with("//") || rest_.starts_with('#')) {
      Advance(rest_.find('\n'));
    } else if (rest_.starts_with("/*")) {
      const std::size_t end = rest_.find("*/", 2);
      Advance(end == std::string_view::npos ? end : end + 2);
    } else {
      return;
    }
  }
}

IdlToken IdlLexer::Next() {
  SkipSpace();
  IdlToken token{IdlToken::Kind::kEnd, {}, line_};
  if (rest_.empty()) return token;
  std::size_t length = 1;
  const char c = rest_[0];
  if (c == '"' || c == '\'') {
    token.kind = IdlToken::Kind::kText;
    length = QuotedLength(rest_);
  } else if (IsLetter(c)) {
    token.kind = IdlToken::Kind::kName;
    length = NameLength(rest_);
  } else if (IsDigit(c)) {
    token.kind = IdlToken::Kind::kNumber;
    length = NumberLength(rest_);
  } else {
    token.kind = IdlToken::Kind::kSymbol;
    if (rest_.starts_with("::")) length = 2;
  }
  token.text = rest_.substr(0, length);
  Advance(length);
  return token;
}

}  // namespace scoria::logs
