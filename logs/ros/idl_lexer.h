// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

namespace scoria::logs {

struct IdlToken {
  enum class Kind { kEnd, kName, kNumber, kText, kSymbol };
  Kind kind = Kind::kEnd;
  std::string_view text;  // as written, strings with their quotes; "::" is one symbol
  int line = 1;
};

/// Cuts an IDL text into tokens; comments and preprocessor lines are not among them.
/// Source: [IDL] 7.2.
class IdlLexer {
 public:
  /// @param text  must outlive the lexer and its tokens.
  IdlLexer(std::string_view text, int first_line) : rest_(text), line_(first_line) {}

  /// kEnd when there is no more, and from then on. A comment or string that never ends, ends with
  /// the text.
  IdlToken Next();

 private:
  void SkipSpace();
  void Advance(std::size_t count);

  std::string_view rest_;
  int line_;
};

}  // namespace scoria::logs
