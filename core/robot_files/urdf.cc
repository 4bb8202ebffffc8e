// SPDX-License-Identifier: BSD-3-Clause
#include "core/robot_files/urdf.h"

#include <console_bridge/console.h>
#include <fmt/format.h>
#include <urdf_parser/urdf_parser.h>

#include "core/config/source.h"
#include "core/file_kind.h"
#include "core/text.h"

namespace scoria::core {
namespace {

/// Collects what urdfdom complains about while it lives; urdfdom itself goes on with zeros.
class UrdfComplaints : public console_bridge::OutputHandler {
 public:
  UrdfComplaints() { console_bridge::useOutputHandler(this); }
  ~UrdfComplaints() override { console_bridge::restorePreviousOutputHandler(); }
  void log(const std::string& text, console_bridge::LogLevel level, const char*, int) override {
    if (level >= console_bridge::CONSOLE_BRIDGE_LOG_ERROR)
      errors_ += (errors_.empty() ? "" : "; ") + text;
  }
  [[nodiscard]] const std::string& errors() const { return errors_; }

 private:
  std::string errors_;
};

}  // namespace

urdf::ModelInterfaceSharedPtr ParseUrdf(const std::string& text, const std::string& file) {
  const Origin origin{file, 0, 0};
  const FileKind kind = KindOfContent(text);
  if (!kind.name.empty() && kind.name != kUrdf)
    throw ConfigError(origin, "urdf", NotOfKind(kind, "a URDF"));
  CheckUtf8(BlankXmlComments(text), origin);
  const UrdfComplaints complaints;
  urdf::ModelInterfaceSharedPtr model = urdf::parseURDF(text);
  if (!model || !complaints.errors().empty()) {
    throw ConfigError(origin, "urdf",
                      fmt::format("not a valid URDF: {}", Shown(complaints.errors(), 300)));
  }
  return model;
}

}  // namespace scoria::core
