// SPDX-License-Identifier: BSD-3-Clause
#include <memory>

#include <fmt/format.h>

#include "analysis/metrics/metric_text.h"
#include "app/cli/commands.h"
#include "app/scenario/config_docs.h"
#include "app/scenario/config_kinds.h"

namespace scoria::app {

void AddSchema(CLI::App& app) {
  struct Options {
    std::string kind = "scenario";
    bool markdown = false, metrics = false;
  };
  auto o = std::make_shared<Options>();
  CLI::App* schema = app.add_subcommand("schema", "print the keys of a YAML file as a JSON Schema");
  std::vector<std::string> kinds;
  for (const ConfigKind& kind : ConfigKinds()) kinds.emplace_back(kind.name);
  schema->add_option("kind", o->kind, "kind of file (default scenario)")
      ->check(CLI::IsMember(kinds));
  schema->add_flag("--markdown", o->markdown, "all kinds as the tables of docs/CONFIG.md");
  schema->add_flag("--metrics", o->metrics, "every metric as the table of docs/METRICS.md");
  schema->callback([o] {
    fmt::print("{}", o->metrics    ? analysis::MetricsMarkdown(analysis::AllMetrics())
                     : o->markdown ? ConfigMarkdown()
                                   : ConfigJsonSchema(o->kind));
  });
}

}  // namespace scoria::app
