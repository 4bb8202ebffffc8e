// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/video/texture_colour.h"

#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

namespace scoria::analysis {

std::optional<Vec3> MeanColour(const std::filesystem::path& image) {
  if (!std::filesystem::is_regular_file(image)) return std::nullopt;
  const cv::Mat pixels = cv::imread(image.string(), cv::IMREAD_UNCHANGED);
  if (pixels.empty() || pixels.depth() != CV_8U) return std::nullopt;
  cv::Mat opaque;
  if (pixels.channels() == 4) cv::extractChannel(pixels, opaque, 3);
  const cv::Scalar mean = cv::mean(pixels, opaque) / 255.0;
  if (pixels.channels() < 3) return Vec3::Constant(mean[0]);
  return Vec3(mean[2], mean[1], mean[0]);  // OpenCV has blue first
}

}  // namespace scoria::analysis
