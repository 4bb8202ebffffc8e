// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

/// Fixed-size linear algebra shared by all folders, visible in every scoria namespace.
namespace scoria {

using Vec2 = Eigen::Vector2d;
using Vec3 = Eigen::Vector3d;
using Vec6 = Eigen::Matrix<double, 6, 1>;
using Vec12 = Eigen::Matrix<double, 12, 1>;
using Vec18 = Eigen::Matrix<double, 18, 1>;
using Mat3 = Eigen::Matrix3d;
using Mat6 = Eigen::Matrix<double, 6, 6>;
using Mat12 = Eigen::Matrix<double, 12, 12>;
using Mat18 = Eigen::Matrix<double, 18, 18>;
using Mat63 = Eigen::Matrix<double, 6, 3>;
using Quat = Eigen::Quaterniond;

}  // namespace scoria
