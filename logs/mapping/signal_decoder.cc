// SPDX-License-Identifier: BSD-3-Clause
#include "logs/mapping/signal_decoder.h"

#include <algorithm>
#include <map>

#include <fmt/format.h>

#include "core/math/so3.h"
#include "logs/mapping/vocabulary.h"
#include "logs/ros/field_path.h"

namespace scoria::logs {
namespace {

PatternNames NamesFor(const SignalSpec& spec, PatternNames names) {
  if (TraitsOf(spec.id).shape != SignalShape::kAttitude || spec.is_rpy) return names;
  names.axes = spec.order == QuaternionOrder::kWxyz ? "wxyz" : "xyzw";
  return names;
}

/// The numbers of a signal in the log.
std::size_t RawSize(const SignalSpec& spec) {
  return spec.is_rpy ? 3 : SizeOf(TraitsOf(spec.id).shape);
}

/// Where the joints are in a list of their names; nothing if not all twelve are there, once.
std::optional<std::array<std::size_t, 12>> PlacesOf(const std::vector<std::string>& names) {
  std::array<std::optional<std::size_t>, 12> found;
  const auto joints = JointsNamed(names);
  for (std::size_t i = 0; i < joints.size(); ++i) {
    if (!joints[i]) continue;
    auto& place = found[3 * static_cast<std::size_t>(joints[i]->leg) +
                        static_cast<std::size_t>(joints[i]->joint)];
    if (place) return std::nullopt;
    place = i;
  }
  std::array<std::size_t, 12> places{};
  for (std::size_t k = 0; k < 12; ++k) {
    if (!found[k]) return std::nullopt;
    places[k] = *found[k];
  }
  return places;
}

}  // namespace

SignalDecoder::SignalDecoder(const SignalSpec& spec, const PatternNames& names,
                             MessageReader& reader)
    : spec_(spec) {
  for (const std::string& field : spec.source.fields) {
    const ExpandedPattern one{{}, 1, false};
    places_.push_back(FindPlace(one, {field, 0}, reader));
  }
  if (spec.source.fields.empty()) {
    const ExpandedPattern pattern = ExpandPattern(spec.source.field, TraitsOf(spec.id).shape,
                                                  RawSize(spec), NamesFor(spec, names));
    for (const PatternPlace& place : pattern.places)
      places_.push_back(FindPlace(pattern, place, reader));
  }
  if (!spec.name_field.empty()) {
    const FoundField found = reader.Want(spec.name_field);
    if (!found.is_text) throw FieldPathError(fmt::format("{}: holds no names", spec.name_field));
    names_slot_ = found.slot;
  }
}

/// The elements of an array, or x, y, z of a struct.
SignalDecoder::Place SignalDecoder::FindPlace(const ExpandedPattern& pattern,
                                              const PatternPlace& place,
                                              MessageReader& reader) const {
  FoundField found;
  try {
    found = reader.Want(place.path);
  } catch (const FieldPathError&) {
    if (!pattern.is_vector) throw;
    const PatternNames names = NamesFor(spec_, {});
    try {
      return {reader.Want(fmt::format("{}.{}", place.path, names.axes[place.element])).slot, 0};
    } catch (const FieldPathError&) {
    }
    throw;
  }
  if (found.is_text) throw FieldPathError(fmt::format("{}: is text, not a number", place.path));
  const bool is_open = found.elements == 0;
  if (pattern.elements == 1 && found.elements != 1)
    throw FieldPathError(fmt::format("{0}: has {1} elements; one number is needed, such as {0}[0]",
                                     place.path,
                                     is_open ? "any number of" : fmt::to_string(found.elements)));
  if (!is_open && found.elements < pattern.elements)
    throw FieldPathError(fmt::format("{}: has {} element{}, {} are needed", place.path,
                                     found.elements, found.elements == 1 ? "" : "s",
                                     pattern.elements));
  return {found.slot, place.element};
}

std::optional<double> SignalDecoder::Number(const MessageReader& reader, Place place) const {
  const std::optional<double> value = reader.Number(place.slot, place.element);
  if (!value) return std::nullopt;
  for (const double none : spec_.source.absent) {
    if (static_cast<float>(*value) == static_cast<float>(none)) return std::nullopt;
  }
  return value;
}

/// Keeps up with names whose order changes. @returns false if they do not name all joints.
bool SignalDecoder::UpdateNames(const MessageReader& reader) {
  std::vector<std::string> names = reader.Texts(*names_slot_);
  if (names != joint_names_ || !from_) {
    from_ = PlacesOf(names);
    joint_names_ = std::move(names);
  }
  return from_.has_value();
}

std::optional<SignalValues> SignalDecoder::DecodeAttitude(const MessageReader& reader) const {
  std::array<double, 4> raw{};
  for (std::size_t k = 0; k < places_.size(); ++k) {
    const std::optional<double> value = Number(reader, places_[k]);
    if (!value) return std::nullopt;
    raw[k] = *value;
  }
  if (spec_.is_rpy) {
    const Mat3 R = core::RotationFromRpy(spec_.gain[0] * Vec3(raw[0], raw[1], raw[2]));
    const Quat q(R);
    return SignalValues{q.w(), q.x(), q.y(), q.z()};
  }
  if (spec_.order == QuaternionOrder::kXyzw) raw = {raw[3], raw[0], raw[1], raw[2]};
  const bool is_set = raw[0] != 0.0 || raw[1] != 0.0 || raw[2] != 0.0 || raw[3] != 0.0;
  if (!is_set) return std::nullopt;  // all zero: not filled
  return SignalValues{raw[0], raw[1], raw[2], raw[3]};
}

std::optional<SignalValues> SignalDecoder::Decode(const MessageReader& reader) {
  if (TraitsOf(spec_.id).shape == SignalShape::kAttitude) return DecodeAttitude(reader);
  if (names_slot_ && !UpdateNames(reader)) return std::nullopt;
  SignalValues values{};
  for (std::size_t k = 0; k < places_.size(); ++k) {
    // By names the places are one array's, element by element.
    const Place place = from_ ? Place{places_[0].slot, (*from_)[k]} : places_[spec_.from[k]];
    const std::optional<double> value = Number(reader, place);
    if (!value) return std::nullopt;
    values[k] = spec_.above ? (*value > *spec_.above ? 1.0 : 0.0)
                            : spec_.gain[k] * *value + spec_.offset[k];
  }
  return values;
}

}  // namespace scoria::logs
