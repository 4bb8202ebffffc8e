// SPDX-License-Identifier: BSD-3-Clause
#include "logs/format/cdr.h"

#include <algorithm>
#include <cctype>

namespace scoria::logs::cdr_detail {

std::string ShortTypeName(const std::string& type_name) {
  const std::size_t at = type_name.find("/msg/");
  return at == std::string::npos ? type_name : type_name.substr(0, at) + type_name.substr(at + 4);
}

std::string SchemaFieldName(std::string name) {
  std::transform(name.begin(), name.end(), name.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return name;
}

}  // namespace scoria::logs::cdr_detail
