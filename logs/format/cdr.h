// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include <fastcdr/Cdr.h>
#include <fastcdr/FastBuffer.h>
#include <fastcdr/exceptions/NotEnoughMemoryException.h>
#include <fmt/format.h>

#include "logs/format/bytes.h"

/// Messages say once what they hold:
///
///     template <class Archive> void Serialize(Archive& a) { a("mass", mass); a("com", com); }
///
/// with `static constexpr const char* kTypeName = "interfaces/msg/QuadModel"`, and that drives CDR
/// encoding and decoding (ROS 2's wire format), the ros2msg schema text, and the listing of fields
/// for comparisons. ROS has no optional fields: std::optional<T> is a bounded sequence, `T[<=1]`,
/// and std::optional<std::array<T, N>> one of N items or none, `T[<=N]`.
namespace scoria::logs {

namespace cdr_detail {

template <class T>
struct IsStdArray : std::false_type {};
template <class T, std::size_t N>
struct IsStdArray<std::array<T, N>> : std::true_type {};
template <class T>
struct IsStdVector : std::false_type {};
template <class T>
struct IsStdVector<std::vector<T>> : std::true_type {};
template <class T>
struct IsOptional : std::false_type {};
template <class T>
struct IsOptional<std::optional<T>> : std::true_type {};

template <class T>
constexpr const char* PrimitiveName() {
  if constexpr (std::is_same_v<T, bool>) return "bool";
  if constexpr (std::is_same_v<T, std::uint8_t>) return "uint8";
  if constexpr (std::is_same_v<T, std::int32_t>) return "int32";
  if constexpr (std::is_same_v<T, std::uint32_t>) return "uint32";
  if constexpr (std::is_same_v<T, std::int64_t>) return "int64";
  if constexpr (std::is_same_v<T, std::uint64_t>) return "uint64";
  if constexpr (std::is_same_v<T, float>) return "float32";
  if constexpr (std::is_same_v<T, double>) return "float64";
  if constexpr (std::is_same_v<T, std::string>) return "string";
  return "";
}

/// Of the sequence that holds an optional value.
template <class T>
constexpr std::uint32_t SequenceLength() {
  if constexpr (IsStdArray<T>::value) return std::tuple_size_v<T>;
  return 1;
}

template <class T>
inline constexpr bool kIsPrimitive = std::is_arithmetic_v<T> || std::is_same_v<T, std::string>;

/// "pkg/msg/Name" as schema texts write it: "pkg/Name".
std::string ShortTypeName(const std::string& type_name);

/// ROS field names are lower case: p_WB_m is p_wb_m on the wire's schema.
std::string SchemaFieldName(std::string name);

}  // namespace cdr_detail

class CdrEncoder {
 public:
  explicit CdrEncoder(eprosima::fastcdr::Cdr& cdr) : cdr_(cdr) {}
  template <class T>
  void operator()(const char*, T& value) {
    if constexpr (cdr_detail::kIsPrimitive<T>) {
      cdr_ << value;
    } else if constexpr (cdr_detail::IsStdArray<T>::value) {
      for (auto& item : value) (*this)("", item);
    } else if constexpr (cdr_detail::IsStdVector<T>::value) {
      cdr_ << static_cast<std::uint32_t>(value.size());
      for (auto& item : value) (*this)("", item);
    } else if constexpr (cdr_detail::IsOptional<T>::value) {
      using Value = typename T::value_type;
      cdr_ << (value ? cdr_detail::SequenceLength<Value>() : 0u);
      if (value) (*this)("", *value);
    } else {
      value.Serialize(*this);
    }
  }

 private:
  eprosima::fastcdr::Cdr& cdr_;
};

class CdrDecoder {
 public:
  explicit CdrDecoder(eprosima::fastcdr::Cdr& cdr) : cdr_(cdr) {}
  template <class T>
  void operator()(const char*, T& value) {
    if constexpr (cdr_detail::kIsPrimitive<T>) {
      cdr_ >> value;
    } else if constexpr (cdr_detail::IsStdArray<T>::value) {
      for (auto& item : value) (*this)("", item);
    } else if constexpr (cdr_detail::IsStdVector<T>::value) {
      std::uint32_t size = 0;
      cdr_ >> size;
      value.clear();
      for (std::uint32_t i = 0; i < size; ++i) (*this)("", value.emplace_back());
    } else if constexpr (cdr_detail::IsOptional<T>::value) {
      constexpr std::uint32_t kLength = cdr_detail::SequenceLength<typename T::value_type>();
      std::uint32_t size = 0;
      cdr_ >> size;
      value.reset();
      if (size == 0) return;
      if (size != kLength)
        throw std::runtime_error(fmt::format("a field of {} or no values has {}", kLength, size));
      (*this)("", value.emplace());
    } else {
      value.Serialize(*this);
    }
  }

 private:
  eprosima::fastcdr::Cdr& cdr_;
};

/// Writes the ros2msg schema: own fields first, then every nested type once.
class SchemaWriter {
 public:
  template <class T>
  void operator()(const char* name, T& value) {
    text_ += FieldType(value) + " " + cdr_detail::SchemaFieldName(name) + "\n";
  }

  template <class T>
  [[nodiscard]] static std::string SchemaOf() {
    SchemaWriter writer;
    T message{};
    message.Serialize(writer);
    std::string text = writer.text_;
    for (std::size_t i = 0; i < writer.nested_.size();
         ++i) {  // grows while nested types add theirs
      const auto [type, fields] = writer.nested_[i];
      text += std::string(80, '=') + "\nMSG: " + type + "\n" + fields;
    }
    return text;
  }

 private:
  template <class T>
  std::string FieldType(T& value) {
    if constexpr (cdr_detail::kIsPrimitive<T>) {
      return cdr_detail::PrimitiveName<T>();
    } else if constexpr (cdr_detail::IsStdArray<T>::value) {
      return fmt::format("{}[{}]", FieldType(value[0]), value.size());
    } else if constexpr (cdr_detail::IsStdVector<T>::value) {
      typename T::value_type item{};
      return FieldType(item) + "[]";
    } else if constexpr (cdr_detail::IsOptional<T>::value) {
      using Value = typename T::value_type;
      constexpr std::uint32_t kLength = cdr_detail::SequenceLength<Value>();
      if constexpr (cdr_detail::IsStdArray<Value>::value) {
        typename Value::value_type item{};
        return fmt::format("{}[<={}]", FieldType(item), kLength);
      } else {
        Value item{};
        return fmt::format("{}[<={}]", FieldType(item), kLength);
      }
    } else {
      std::string type = cdr_detail::ShortTypeName(T::kTypeName);
      for (const auto& known : nested_) {
        if (known.first == type) return type;
      }
      nested_.emplace_back(type, "");
      const std::size_t at = nested_.size() - 1;
      const std::string outer = std::move(text_);
      text_.clear();
      value.Serialize(*this);
      nested_[at].second = std::exchange(text_, outer);
      return type;
    }
  }

  std::string text_;
  std::vector<std::pair<std::string, std::string>> nested_;
};

/// Lists "path = value" of every primitive, for naming the first field in which two messages
/// differ.
class FieldLister {
 public:
  template <class T>
  void operator()(const char* name, T& value) {
    const std::string path = prefix_.empty() ? name : prefix_ + "." + name;
    List(path, value);
  }
  [[nodiscard]] const std::vector<std::pair<std::string, std::string>>& fields() const {
    return fields_;
  }

 private:
  template <class T>
  void List(const std::string& path, T& value) {
    if constexpr (cdr_detail::kIsPrimitive<T>) {
      fields_.emplace_back(path, fmt::format("{}", value));
    } else if constexpr (cdr_detail::IsStdArray<T>::value || cdr_detail::IsStdVector<T>::value) {
      for (std::size_t i = 0; i < value.size(); ++i) List(fmt::format("{}[{}]", path, i), value[i]);
    } else if constexpr (cdr_detail::IsOptional<T>::value) {
      if (value) {
        List(path, *value);
      } else {
        fields_.emplace_back(path, "none");
      }
    } else {
      const std::string outer = std::exchange(prefix_, path);
      value.Serialize(*this);
      prefix_ = outer;
    }
  }

  std::string prefix_;
  std::vector<std::pair<std::string, std::string>> fields_;
};

/// CDR with its four-byte encapsulation header, little endian, as rosbag2 stores messages. Padding
/// bytes are zero, so that equal messages are equal bytes.
template <class Message>
void EncodeCdr(Message& message, Bytes& out) {
  for (std::size_t room = 4096;; room *= 2) {
    out.assign(room, std::byte{0});
    eprosima::fastcdr::FastBuffer buffer(reinterpret_cast<char*>(out.data()), out.size());
    eprosima::fastcdr::Cdr cdr(buffer, eprosima::fastcdr::Cdr::LITTLE_ENDIANNESS,
                               eprosima::fastcdr::Cdr::DDS_CDR);
    try {
      cdr.serialize_encapsulation();
      CdrEncoder encoder(cdr);
      message.Serialize(encoder);
    } catch (const eprosima::fastcdr::exception::NotEnoughMemoryException&) {
      continue;  // a message with long strings: try again with more room
    }
    out.resize(cdr.getSerializedDataLength());
    return;
  }
}

/// Errors: eprosima::fastcdr::exception::Exception if the bytes end too early; std::runtime_error
/// if a sequence is longer than its bound.
template <class Message>
[[nodiscard]] Message DecodeCdr(std::span<const std::byte> bytes) {
  auto* data = const_cast<char*>(reinterpret_cast<const char*>(bytes.data()));
  eprosima::fastcdr::FastBuffer buffer(data, bytes.size());
  eprosima::fastcdr::Cdr cdr(buffer, eprosima::fastcdr::Cdr::DEFAULT_ENDIAN,
                             eprosima::fastcdr::Cdr::DDS_CDR);
  cdr.read_encapsulation();
  Message message{};
  CdrDecoder decoder(cdr);
  message.Serialize(decoder);
  return message;
}

}  // namespace scoria::logs
