// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "logs/mapping/message_reader.h"
#include "logs/ros/field_reader.h"

namespace scoria::logs {
namespace {

class RosMessageReader final : public MessageReader {
 public:
  explicit RosMessageReader(const MessageType& type) : type_(type) {}

  FoundField Want(const std::string& path) override {
    const ResolvedField field = ResolveField(type_, path);
    paths_.push_back(path);
    reader_.reset();
    const bool is_open = field.multiplicity == Multiplicity::kSequence;
    return {paths_.size() - 1, is_open ? 0 : field.count, field.type == FieldType::kTime,
            IsText(field.type)};
  }

  void Read(const LogMessage& message) override {
    if (!reader_) reader_.emplace(type_, paths_);
    values_ = reader_->Read(message.data);
  }

  [[nodiscard]] std::optional<double> Number(std::size_t slot, std::size_t element) const override {
    const FieldView& view = values_[slot];
    if (view.IsAbsent() || element >= view.size()) return std::nullopt;
    const double value = view.Double(element);
    return std::isnan(value) ? std::nullopt : std::optional(value);
  }

  [[nodiscard]] std::optional<std::int64_t> Integer(std::size_t slot) const override {
    const FieldView& view = values_[slot];
    if (view.IsAbsent() || view.size() == 0) return std::nullopt;
    const bool is_float = view.type() == FieldType::kFloat32 || view.type() == FieldType::kFloat64;
    if (!is_float) return view.Int();
    const auto value = Number(slot, 0);
    return value && std::abs(*value) < 9e18 ? std::optional(std::llround(*value)) : std::nullopt;
  }

  [[nodiscard]] std::optional<std::int64_t> TimeNs(std::size_t slot,
                                                   std::int64_t unit_ns) const override {
    const FieldView& view = values_[slot];
    if (view.IsAbsent() || view.size() == 0) return std::nullopt;
    if (view.type() == FieldType::kTime) return view.Int();
    const bool is_float = view.type() == FieldType::kFloat32 || view.type() == FieldType::kFloat64;
    std::int64_t ns = 0;
    if (!is_float)
      return __builtin_mul_overflow(view.Int(), unit_ns, &ns) ? std::nullopt : std::optional(ns);
    const double value = view.Double() * static_cast<double>(unit_ns);
    return std::abs(value) < 9e18 ? std::optional(std::llround(value)) : std::nullopt;
  }

  [[nodiscard]] std::vector<std::string> Texts(std::size_t slot) const override {
    return values_[slot].IsAbsent() ? std::vector<std::string>() : values_[slot].Texts();
  }

 private:
  const MessageType& type_;
  std::vector<std::string> paths_;
  std::optional<FieldReader> reader_;
  std::span<const FieldView> values_;
};

}  // namespace

std::unique_ptr<MessageReader> MakeRosReader(const MessageType& type) {
  return std::make_unique<RosMessageReader>(type);
}

}  // namespace scoria::logs
