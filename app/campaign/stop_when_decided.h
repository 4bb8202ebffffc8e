// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <map>
#include <vector>

#include "analysis/study/stopping.h"
#include "app/campaign/campaign.h"

namespace scoria::app {

/// Looks at the seeds of a campaign in their order, each once all its episodes have ended, in
/// whichever order they do: what it decides does not depend on the number of workers.
class StopWhenDecided {
 public:
  /// @param jobs    of the whole campaign, borrowed. @pre campaign.stop.
  /// @param folder  of the campaign.
  StopWhenDecided(const Campaign& campaign, const std::vector<CampaignJob>& jobs,
                  const std::filesystem::path& folder);

  /// The result of a job stands in its folder.
  void Take(const CampaignJob& job);

  /// False for the seeds after the one that decided.
  [[nodiscard]] bool Needs(const CampaignJob& job) const noexcept;
  [[nodiscard]] const analysis::StopRecord& record() const noexcept { return stop_.record(); }

 private:
  void LookAt(std::uint64_t seed);

  const std::vector<CampaignJob>& jobs_;
  std::filesystem::path folder_;
  analysis::SequentialStop stop_;
  std::map<std::uint64_t, int> left_;  // episodes that have not ended, of seeds not looked at
};

}  // namespace scoria::app
