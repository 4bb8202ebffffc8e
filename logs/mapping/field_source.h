// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "core/config/field.h"
#include "logs/mapping/units.h"

namespace scoria::logs {

/// Where a log holds a signal. Written short, it is the field alone, or a list of fields:
/// `q: position`, `position: [px, py, pz]`.
struct FieldSource {
  static constexpr const char* kScalarKey = "field";
  static constexpr const char* kListKey = "fields";
  std::string topic;                // empty: the section's
  std::string field;                // a path or column, with placeholders
  std::vector<std::string> fields;  // or one for each number
  double scale = 1.0;
  std::vector<double> absent;

  template <class Archive>
  void SerializeFields(Archive& a) {
    a.Field("topic", topic, {.doc = "other than the section's: a name of topics, or of the log"});
    a.Field("field", field,
            {.doc = "path in the message, or column by name or number from 0; {leg}, {joint}, "
                    "{axis} stand for the log's names, {i} and {i+5} for the number of the value"});
    a.Field("fields", fields, {.doc = "in place of field: one for each number"});
    a.Field("scale", scale,
            {.doc = "what values are multiplied by before the unit, as 2 pi / counts"});
    a.Field("absent", absent, {.doc = "values that mean that there is none, as 2.146e9"});
  }
  [[nodiscard]] std::string Problem() const {
    if (field.empty() == fields.empty()) return "needs either field or fields";
    if (scale == 0.0) return "scale is 0";
    return "";
  }
};

/// A signal of a quantity.
template <class UnitType>
struct Source : FieldSource {
  UnitType unit{};
  template <class Archive>
  void Serialize(Archive& a) {
    SerializeFields(a);
    a.Field("unit", unit, {.doc = "of the log"});
  }
};

/// Numbers without a unit.
struct PlainSource : FieldSource {
  template <class Archive>
  void Serialize(Archive& a) {
    SerializeFields(a);
  }
};

/// A vector. `axes` says which of the log's axes are ours: [-y, x, z] takes x from the log's -y.
template <class UnitType>
struct VectorSource : FieldSource {
  UnitType unit{};
  std::array<std::string, 3> axes = {"x", "y", "z"};
  template <class Archive>
  void Serialize(Archive& a) {
    SerializeFields(a);
    a.Field("unit", unit, {.doc = "of the log"});
    a.Field("axes", axes, {.doc = "the log's axes that are our x, y, z, as [-y, x, z]"});
  }
};

/// What a vector is expressed in.
enum class VectorFrame { kWorld, kBody };
constexpr UnitNames<VectorFrame, 2> EnumNames(VectorFrame) {
  return {{{VectorFrame::kWorld, "world"}, {VectorFrame::kBody, "body"}}};
}

template <class UnitType>
struct FramedSource : FieldSource {
  UnitType unit{};
  std::array<std::string, 3> axes = {"x", "y", "z"};
  VectorFrame frame = VectorFrame::kWorld;
  template <class Archive>
  void Serialize(Archive& a) {
    SerializeFields(a);
    a.Field("unit", unit, {.doc = "of the log"});
    a.Field("axes", axes, {.doc = "the log's axes that are our x, y, z, as [-y, x, z]"});
    a.Field("frame", frame, {.doc = "what the log expresses it in"});
  }
};

/// What the forces on the feet are expressed in; metadata: world where the log's metadata have
/// contact_force_frame: W, else body, as the reference framework's estimator has it.
enum class ForceFrame { kWorld, kBody, kMetadata };
constexpr UnitNames<ForceFrame, 3> EnumNames(ForceFrame) {
  return {{{ForceFrame::kWorld, "world"},
           {ForceFrame::kBody, "body"},
           {ForceFrame::kMetadata, "metadata"}}};
}

/// Forces of the ground on the feet, N.
struct ForceSource : FieldSource {
  ForceFrame frame = ForceFrame::kWorld;
  template <class Archive>
  void Serialize(Archive& a) {
    SerializeFields(a);
    a.Field("frame", frame,
            {.doc = "metadata: world where the log's metadata have contact_force_frame: W, else "
                    "body"});
  }
};

enum class Gravity { kIncluded, kRemoved };
constexpr UnitNames<Gravity, 2> EnumNames(Gravity) {
  return {{{Gravity::kIncluded, "included"}, {Gravity::kRemoved, "removed"}}};
}

/// An accelerometer: +9.8 m/s² upwards at rest where gravity is included.
struct AccelerationSource : FieldSource {
  AccelerationUnit unit{};
  std::array<std::string, 3> axes = {"x", "y", "z"};
  Gravity gravity = Gravity::kIncluded;
  template <class Archive>
  void Serialize(Archive& a) {
    SerializeFields(a);
    a.Field("unit", unit, {.doc = "of the log"});
    a.Field("axes", axes,
            {.doc = "the log's axes that are our x, y, z; [-x, -y, -z] for one that shows -9.8 "
                    "on z at rest"});
    a.Field("gravity", gravity, {.doc = "removed: it is added again, by the attitude"});
  }
};

enum class AttitudeForm { kQuaternion, kRpy };
constexpr UnitNames<AttitudeForm, 2> EnumNames(AttitudeForm) {
  return {{{AttitudeForm::kQuaternion, "quaternion"}, {AttitudeForm::kRpy, "rpy"}}};
}
enum class QuaternionOrder { kXyzw, kWxyz };
constexpr UnitNames<QuaternionOrder, 2> EnumNames(QuaternionOrder) {
  return {{{QuaternionOrder::kXyzw, "xyzw"}, {QuaternionOrder::kWxyz, "wxyz"}}};
}

/// An attitude, body to world.
struct AttitudeSource : FieldSource {
  AttitudeForm form = AttitudeForm::kQuaternion;
  QuaternionOrder order = QuaternionOrder::kXyzw;
  AngleUnit unit{};
  template <class Archive>
  void Serialize(Archive& a) {
    SerializeFields(a);
    a.Field("form", form, {.doc = "rpy: roll, pitch, yaw, R = Rz Ry Rx"});
    a.Field("order", order, {.doc = "of a quaternion that is an array or a list of fields"});
    a.Field("unit", unit, {.doc = "of roll, pitch and yaw"});
  }
};

/// Which legs bear weight: flags, or numbers above a threshold.
struct ContactFlagSource : FieldSource {
  double above = 0.0;
  template <class Archive>
  void Serialize(Archive& a) {
    SerializeFields(a);
    a.Field("above", above, {.doc = "a number is contact from here on; flags are 0 and 1"});
  }
};

}  // namespace scoria::logs
