// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/report/json_text.h"

#include <nlohmann/json.hpp>

namespace scoria::analysis {

std::string JsonText(const nlohmann::json& json) {
  return json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

}  // namespace scoria::analysis
