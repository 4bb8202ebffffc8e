// SPDX-License-Identifier: BSD-3-Clause
#include "app/campaign/stop_when_decided.h"

#include "analysis/study/results.h"

namespace scoria::app {
namespace {

std::vector<std::string> NamesOf(const std::vector<CampaignArm>& arms) {
  std::vector<std::string> names;
  for (const CampaignArm& arm : arms) names.push_back(arm.name);
  return names;
}

}  // namespace

StopWhenDecided::StopWhenDecided(const Campaign& campaign, const std::vector<CampaignJob>& jobs,
                                 const std::filesystem::path& folder)
    : jobs_(jobs), folder_(folder), stop_(*campaign.stop, NamesOf(campaign.arms)) {
  for (const CampaignJob& job : jobs) ++left_[job.seed];
}

void StopWhenDecided::Take(const CampaignJob& job) {
  if (const auto left = left_.find(job.seed); left != left_.end()) --left->second;
  while (!stop_.decided() && !left_.empty() && left_.begin()->second == 0) {
    LookAt(left_.begin()->first);
    left_.erase(left_.begin());
  }
}

bool StopWhenDecided::Needs(const CampaignJob& job) const noexcept {
  return !stop_.decided() || job.seed <= *stop_.record().last_seed;
}

void StopWhenDecided::LookAt(std::uint64_t seed) {
  std::vector<analysis::EpisodeRecord> episodes;
  for (const CampaignJob& job : jobs_) {
    if (job.seed != seed) continue;
    analysis::EpisodeRecord index;
    index.id = job.id;
    index.arm = job.arm;
    index.point = job.point;
    index.seed = seed;
    episodes.push_back(analysis::LoadEpisode(folder_ / "episodes" / job.id, std::move(index)));
  }
  stop_.AddSeed(seed, episodes);
}

}  // namespace scoria::app
