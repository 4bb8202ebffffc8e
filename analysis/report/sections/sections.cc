// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/report/sections/sections.h"

namespace scoria::analysis {

std::vector<Section> FieldSections() { return {QualitySection(), FieldLogsSection()}; }

std::vector<Section> AllSections() {
  return {PointVerdictsSection(),
          RateRatiosSection(),
          EnginesSection(),
          SurvivalSection(),
          FactorsSection(),
          FailuresSection(),
          FallsSection(),
          CostOfTransportSection(),
          TrackingSection(),
          NumbersSection(),
          DifferencesSection(),
          StateEstimationSection(),
          ContactDetectionSection(),
          ModelAdaptationSection(),
          BiasBudgetSection(),
          AdaptedTrackingSection(),
          EnergySection(),
          ComputingTimeSection(),
          GroundSection(),
          CourseSection(),
          VideosSection(),
          DataSection()};
}

}  // namespace scoria::analysis
