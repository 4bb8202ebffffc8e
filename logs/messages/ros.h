// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <string>

/// The standard messages of ROS 2 that those of the log are made of, field by field.
namespace scoria::logs::msg {

struct Time {
  static constexpr const char* kTypeName = "builtin_interfaces/msg/Time";
  std::int32_t sec = 0;
  std::uint32_t nanosec = 0;
  template <class Archive>
  void Serialize(Archive& a) {
    a("sec", sec);
    a("nanosec", nanosec);
  }
};

struct Header {
  static constexpr const char* kTypeName = "std_msgs/msg/Header";
  Time stamp;
  std::string frame_id;
  template <class Archive>
  void Serialize(Archive& a) {
    a("stamp", stamp);
    a("frame_id", frame_id);
  }
};

struct Vector3 {
  static constexpr const char* kTypeName = "geometry_msgs/msg/Vector3";
  double x = 0.0, y = 0.0, z = 0.0;
  template <class Archive>
  void Serialize(Archive& a) {
    a("x", x);
    a("y", y);
    a("z", z);
  }
};

struct Point : Vector3 {
  static constexpr const char* kTypeName = "geometry_msgs/msg/Point";
};

struct Quaternion {
  static constexpr const char* kTypeName = "geometry_msgs/msg/Quaternion";
  double x = 0.0, y = 0.0, z = 0.0, w = 1.0;
  template <class Archive>
  void Serialize(Archive& a) {
    a("x", x);
    a("y", y);
    a("z", z);
    a("w", w);
  }
};

struct Pose {
  static constexpr const char* kTypeName = "geometry_msgs/msg/Pose";
  Point position;
  Quaternion orientation;
  template <class Archive>
  void Serialize(Archive& a) {
    a("position", position);
    a("orientation", orientation);
  }
};

struct Twist {
  static constexpr const char* kTypeName = "geometry_msgs/msg/Twist";
  Vector3 linear, angular;
  template <class Archive>
  void Serialize(Archive& a) {
    a("linear", linear);
    a("angular", angular);
  }
};

struct Accel : Twist {
  static constexpr const char* kTypeName = "geometry_msgs/msg/Accel";
};

struct PoseWithCovariance {
  static constexpr const char* kTypeName = "geometry_msgs/msg/PoseWithCovariance";
  Pose pose;
  std::array<double, 36> covariance{};
  template <class Archive>
  void Serialize(Archive& a) {
    a("pose", pose);
    a("covariance", covariance);
  }
};

struct TwistWithCovariance {
  static constexpr const char* kTypeName = "geometry_msgs/msg/TwistWithCovariance";
  Twist twist;
  std::array<double, 36> covariance{};
  template <class Archive>
  void Serialize(Archive& a) {
    a("twist", twist);
    a("covariance", covariance);
  }
};

struct Imu {
  static constexpr const char* kTypeName = "sensor_msgs/msg/Imu";
  Header header;
  Quaternion orientation;
  std::array<double, 9> orientation_covariance{};
  Vector3 angular_velocity;
  std::array<double, 9> angular_velocity_covariance{};
  Vector3 linear_acceleration;
  std::array<double, 9> linear_acceleration_covariance{};
  template <class Archive>
  void Serialize(Archive& a) {
    a("header", header);
    a("orientation", orientation);
    a("orientation_covariance", orientation_covariance);
    a("angular_velocity", angular_velocity);
    a("angular_velocity_covariance", angular_velocity_covariance);
    a("linear_acceleration", linear_acceleration);
    a("linear_acceleration_covariance", linear_acceleration_covariance);
  }
};

}  // namespace scoria::logs::msg
